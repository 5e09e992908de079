//! What counts as equal in a document.

use geom::tolerance::{Extent, Tolerance};
use glam::DVec3;
use tmesh::Document;

/// The tolerances of a document in its canonical frame: by its size, the precision of its coordinates, and how far it is off its
/// symmetry. Linear.
pub fn tolerance(document: &Document) -> Tolerance {
    let points = document.templates.iter().flat_map(|t| &t.vertices);
    let points: Vec<DVec3> = points.copied().collect();
    let extent = Extent::about(&points, DVec3::ZERO, DVec3::Z);
    let precision = document.source.as_ref().map_or(0.0, |s| s.precision);
    let residual = document.symmetry.as_ref().map_or(0.0, |s| s.residual);
    Tolerance::new(extent, precision, residual)
}
