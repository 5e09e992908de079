//! Surfaces without tetrahedra: whether they bound their regions.

use super::table::sorted;
use crate::check::findings::{Findings, Kind, at};
use geom::edges::Edges;
use tmesh::{Document, OUTSIDE};

/// Checks that around every edge of a template's surface the regions follow each other: each region
/// (and the outside) is entered as often as it is left. Also looks for repeated triangles.
pub fn closedness(document: &Document, index: usize, findings: &mut Findings) {
    let template = &document.templates[index];
    let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
    let edges = Edges::new(&triangles);
    let mut balance: Vec<(u32, i32)> = Vec::new();
    for edge in 0..edges.len() {
        balance.clear();
        let around = edges.around(edge);
        for used in around {
            let t = &template.triangles[used.triangle as usize];
            let sign = if used.forward { 1 } else { -1 };
            balance.extend([(t.back, sign), (t.front, -sign)]);
        }
        balance.sort_unstable_by_key(|b| b.0);
        let open = balance
            .chunk_by(|a, b| a.0 == b.0)
            .find(|side| side.iter().map(|s| s.1).sum::<i32>() != 0);
        if let Some(side) = open {
            findings.add(Kind::OpenEdge, || {
                let ends = edges.ends[edge];
                let of = match side[0].0 {
                    OUTSIDE => "the outside".to_owned(),
                    region => format!("region {region}"),
                };
                format!(
                    "edge {} {} with {} triangles leaves {of} open {}",
                    ends[0],
                    ends[1],
                    around.len(),
                    at(document, index, &ends)
                )
            });
        }
    }
    let mut faces: Vec<([u32; 3], u32)> = triangles
        .iter()
        .enumerate()
        .map(|(i, t)| (sorted(*t).0, i as u32))
        .collect();
    faces.sort_unstable();
    for pair in faces.windows(2).filter(|p| p[0].0 == p[1].0) {
        findings.add(Kind::RepeatedTriangle, || {
            let place = at(document, index, &pair[0].0);
            format!("triangles {} and {} {place}", pair[0].1, pair[1].1)
        });
    }
}
