//! The curves of all edges of facets: those of features from their tangents, those inside of faces from normals.

use super::bent::Bent;
use super::curves::{Bow, STRAIGHT, Tangents, arc, limited};
use super::normals::Normals;
use glam::DVec3;

impl Bent<'_> {
    /// The curves of the edges that begin at each corner of each triangle, in its direction. Those on flat faces stay in their planes;
    /// `planes` has these of each triangle.
    pub fn bows(
        &self,
        (tangents, normals): (&Tangents, &Normals),
        plane: impl Fn(u32) -> Option<DVec3>,
    ) -> Vec<[Bow; 3]> {
        let sheets = self.sheets;
        let mut bows = vec![[STRAIGHT; 3]; sheets.triangles.len()];
        for (edge, &ends) in sheets.edges.ends.iter().enumerate() {
            let around = sheets.edges.around(edge);
            let mut bow = if self.is_inside(edge) {
                let u = around[0];
                let [c, d] = [u.corner as usize, (u.corner as usize + 1) % 3];
                let [c, d] = if u.forward { [c, d] } else { [d, c] };
                let there = normals[u.triangle as usize];
                inside(
                    ends.map(|v| sheets.points[v as usize]),
                    [there[c], there[d]],
                )
            } else {
                tangents.bow(sheets, ends)
            };
            let mut planes = around.iter().filter_map(|u| plane(u.triangle));
            if let Some(normal) = planes.next() {
                // What is left of a part is rounding.
                let rounding = f64::EPSILON.sqrt();
                bow = bow.map(|b| match b - normal * b.dot(normal) {
                    rest if rest.length() > rounding * b.length() => rest,
                    _ => DVec3::ZERO,
                });
                // What is in two planes is a straight line.
                let apart = |other: DVec3| normal.cross(other).length() > rounding;
                if planes.any(apart) {
                    bow = STRAIGHT;
                }
            }
            for u in around {
                let [low, high] = bow;
                let own = if u.forward { [low, high] } else { [high, low] };
                bows[u.triangle as usize][u.corner as usize] = own;
            }
        }
        bows
    }
}

/// The curve of an edge inside of a curved face, from the normals at its ends.
fn inside([p, q]: [DVec3; 2], normals: [Option<DVec3>; 2]) -> Bow {
    let along = (q - p).normalize_or_zero();
    let mirrored = |n: DVec3| n - along * (2.0 * n.dot(along));
    let (m, n) = match normals {
        [Some(m), Some(n)] => (m, n),
        [Some(m), None] => (m, mirrored(m)),
        [None, Some(n)] => (mirrored(n), n),
        [None, None] => return STRAIGHT,
    };
    let mean = m + n;
    let up = (mean - along * mean.dot(along)).normalize_or_zero();
    let length = p.distance(q) / arc(m.dot(n));
    let (low, high) = (-along.dot(m) * length, along.dot(n) * length);
    limited([up * low, up * high])
}
