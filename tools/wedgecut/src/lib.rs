//! Cuts one wedge out of a symmetric body.
//!
//! A wedge is a [`cell`] of cutting faces: half planes that begin at the axis, the plane across it, the wall of a
//! hub. What is cut, and where, is a list of [`candidates`]; the first that can be cut is taken. The stages
//! of a cut ([`cutting`]): into the canonical axis frame, with heights and columns made exact and what is beside
//! mirror planes moved onto them ([`surface`]); the surface clipped at each face, flat patches as whole polygons
//! ([`clip`]); detail collapsed ([`clean`]); the parts of faces that are images of each other paired and made exact
//! images ([`seam`]); the sections closed by caps that carry the region interfaces ([`section`]); what is cut off in
//! front of the hub's wall united to a template of its own ([`wedge`]).

mod along;
mod body;
mod candidates;
mod cell;
mod clean;
mod cli;
mod clip;
mod cutting;
mod error;
mod graph;
mod names;
mod params;
mod seam;
mod section;
mod surface;
#[cfg(test)]
mod tests;
mod wedge;

pub use cli::Cli;
pub use error::CutError;
pub use graph::Graph;
pub use params::{Domain, Hub, Params, Seam};

use body::Body;
use tmesh::{Document, Symmetry};

/// What the cut did, besides its result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Sentences for the history and `-v`.
    pub notes: Vec<String>,
    /// What the user should know at once: that the cut is at a bad place, and where a better one is.
    pub warning: Option<String>,
    /// What the user should know of a seam whose sides differ by more than the tolerance of the symmetry, so that one
    /// was replaced by the image of the other: how far points were moved, and what the deviation from symmetry explains.
    pub moved: Option<String>,
    /// What the user should know where copies of the wedge differ from the body by more than its symmetry explains, though by no more than what is
    /// moved when it is cut.
    pub differs: Option<String>,
}

/// Cuts the wedge out of a body.
///
/// The document needs a symmetry and one surface template in world coordinates. The result has the
/// wedge's surface as its template, in the canonical frame, with gluings, axis vertices, and one
/// instance per copy.
///
/// # Errors
/// Missing symmetry, an order or domain the body does not have, sections that are not clean or do
/// not match.
pub fn cut(mut document: Document, params: &Params) -> Result<(Document, Report), CutError> {
    let found = candidates::search(&Body::new(&document, params)?)?;
    let moved = (document.symmetry.as_ref()).and_then(|s| replaced(s, found.cut.moved));
    let mut notes = found.cut.notes;
    notes.extend(found.notes);
    // What has no thickness is no longer there to be compared with.
    if let Some(source) = &mut document.source {
        source.boundary_area = (source.boundary_area - found.cut.closed).max(0.0);
    }
    let difference = found.cut.difference;
    document.add_displacement(difference.displacement);
    document.frame = found.cut.place.frame;
    document.templates = found.cut.templates;
    document.instances = found.cut.copies.instances;
    document.region_maps = found.cut.copies.region_maps;
    let report = Report {
        notes,
        warning: found.warning,
        moved,
        differs: (document.symmetry.as_ref())
            .and_then(|symmetry| differing(symmetry, difference.displacement)),
    };
    Ok((document, report))
}

/// What is said of volumes that differ from the body's as if its surface were off by this, model units, beyond what is known of it.
fn differing(symmetry: &Symmetry, displacement: f64) -> Option<String> {
    (displacement > 0.0).then(|| {
        format!(
            "volumes of the wedge's copies differ from the body's by more than its symmetry explains, as if its surface were off by {:.1e} of the \
             radius: sectors differ from each other, or --clean took out as much",
            displacement / symmetry.radius
        )
    })
}

/// What is said of seams where points were moved by more than the tolerance of the symmetry.
fn replaced(symmetry: &Symmetry, moved: f64) -> Option<String> {
    let relative = moved / symmetry.radius;
    (relative > symmetry.tolerance).then(|| {
        format!(
            "seam made the image of its other side: points moved by {moved:.1e} at most, {relative:.1e} of the radius; \
             the body deviates from the symmetry by up to {:.1e}",
            symmetry.residual
        )
    })
}
