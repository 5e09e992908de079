//! No two vertices in one place.

use crate::check::findings::{Findings, Kind, at};
use geom::grid::coincident;
use geom::tolerance::PROMISE;
use tmesh::Document;

/// Looks for vertices of a template that coincide with an earlier one.
pub fn coincident_vertices(document: &Document, size: f64, findings: &mut Findings) {
    for (index, template) in document.templates.iter().enumerate() {
        let vertices = template.vertices.iter().copied();
        coincident(vertices, PROMISE * size, |later, earlier| {
            findings.add(Kind::Coincident, || {
                let [p, q] = [later, earlier].map(|v| template.vertices[v as usize]);
                format!(
                    "vertices {earlier} and {later} are {:e} apart {}",
                    p.distance(q),
                    at(document, index, &[later])
                )
            });
        });
    }
}
