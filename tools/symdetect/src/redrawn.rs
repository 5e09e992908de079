//! Solids that touch along curved faces and do not share the symmetry of the body: the facets of one stand for both.

use crate::detect::precision_of;
use crate::params::Params;
use crate::report::Detection;
use crate::shape::Shape;
use crate::verify::{Bound, Check, Depth};
use heal::{Imported, Undrawn};
use tmesh::{Document, Frame, Symmetry};

/// How much farther than the solids in the file their body may be off the symmetry: deviations of facets are measured at some places,
/// and other facets are off at others. Those of a drawing that shares the symmetry are off by rounding, and what is joined
/// without regard to it by as much as facets are off the shape.
const AS_FAR: f64 = 2.0;

/// The body with interfaces of curved faces drawn once, and how far it is off the symmetry found, if it is as symmetric as the solids in the file are. Where
/// facets are alike all around, and explain nothing of what a body is off, they stay as they are; of a body without symmetry there is nothing to lose.
pub fn redrawn(
    document: &Document,
    undrawn: &Undrawn,
    found: &Detection,
    params: &Params,
) -> Option<(Imported, f64)> {
    let is_asymmetric = found.asymmetric.is_some();
    if !is_asymmetric && found.deviations.facets.is_none() {
        return None;
    }
    let once = undrawn.draw_once(document)?;
    let residual = found.symmetry.residual;
    if is_asymmetric {
        return Some((once, residual));
    }
    let off = residual_of(&once.document, &found.symmetry, AS_FAR * residual, params)?;
    Some((once, residual.max(off)))
}

/// How far a body is off a group, relative to the radius; `None` beyond `most`.
fn residual_of(
    document: &Document,
    symmetry: &Symmetry,
    most: f64,
    params: &Params,
) -> Option<f64> {
    let mut shape = Shape::new(&document.templates[0], precision_of(document))?;
    shape.may_exchange = params.exchange;
    let world = symmetry.frame()?;
    let frame = Frame {
        origin: shape.of_world(world.origin),
        ..world
    };
    let radius = symmetry.radius / shape.scale;
    let check = Check {
        shape: &shape,
        frame: &frame,
        bound: Bound::plain(most * radius),
        depth: Depth::Full,
    };
    let verified = check.group(&symmetry.group).ok()?;
    Some(verified.deviation.value / radius)
}
