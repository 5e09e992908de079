//! All tetrahedra are positively oriented.

use crate::check::findings::{Findings, Kind, at};
use geom::predicate::orientation;
use tmesh::Document;

/// Indices of the tetrahedra of a template that are flat or inside out, increasing.
pub fn inverted(document: &Document, index: usize, findings: &mut Findings) -> Vec<u32> {
    let template = &document.templates[index];
    let mut inverted = Vec::new();
    for (i, tet) in template.tets.iter().enumerate() {
        let [a, b, c, d] = tet.vertices.map(|v| template.vertices[v as usize]);
        let sign = orientation(a, b, c, d);
        if sign <= 0.0 || sign.is_nan() {
            inverted.push(i as u32);
            findings.add(Kind::Inverted, || {
                let what = if sign == 0.0 { "flat" } else { "inside out" };
                let place = at(document, index, &tet.vertices);
                format!("tetrahedron {i} is {what} {place}")
            });
        }
    }
    inverted
}
