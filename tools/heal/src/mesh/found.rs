//! The symmetry that a file says was found in the body that it holds.

use crate::document::Imported;
use glam::DVec3;
use interchange::parsed::Finding;
use tmesh::{Document, ROUNDING, Symmetry, Template, validate};

/// Gives the document of a body the symmetry in its file, and the precision of the file that it was found in.
///
/// Other programs keep what they do not know in a file while they move, scale or cut the mesh. So the symmetry
/// is taken only where the surface reaches as far from the axis as it says.
pub fn restore(imported: &mut Imported, finding: Finding) {
    let Finding { symmetry, source } = finding;
    let document = &mut imported.document;
    let group = symmetry.group;
    let claim = Document {
        regions: document.regions.clone(),
        symmetry: Some(symmetry.clone()),
        ..Document::single(Template::default())
    };
    let off = match validate(&claim).first() {
        Some(violation) => Some(violation.to_string()),
        None if !fits(document, &symmetry) => Some(
            "the surface has been changed since: it does not reach as far from the axis as it did"
                .to_owned(),
        ),
        None => None,
    };
    if let Some(reason) = off {
        imported.notices.push(format!(
            "the symmetry {group} in the file is ignored, symdetect can find it anew: {reason}"
        ));
        return;
    }
    document.symmetry = Some(symmetry);
    if let Some((own, source)) = document.source.as_mut().zip(source)
        && source.precision.is_finite()
    {
        own.precision = own.precision.max(source.precision);
    }
}

/// Whether the radius about the axis is the one that the symmetry was found with. The axis may have been adjusted
/// since by what the body is off its symmetry.
fn fits(document: &Document, symmetry: &Symmetry) -> bool {
    let origin = DVec3::from_array(symmetry.axis.point);
    let axis = DVec3::from_array(symmetry.axis.direction);
    let vertices = document.templates.iter().flat_map(|t| &t.vertices);
    let mut size = origin.abs().max_element();
    let mut radius = 0.0_f64;
    for &p in vertices {
        size = size.max(p.abs().max_element());
        radius = radius.max((p - origin).cross(axis).length());
    }
    (radius - symmetry.radius).abs() <= ROUNDING * size + symmetry.residual * symmetry.radius
}
