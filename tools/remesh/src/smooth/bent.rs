//! Triangles of curved faces, and which of them bend alike.

use super::sheets::{Mate, Sheets};

/// Triangles between the corners of facets, of which some are flat faces.
pub struct Bent<'a> {
    /// The triangles.
    pub sheets: &'a Sheets<'a>,
    /// Of each triangle, whether it is on a flat face.
    pub is_flat: &'a [bool],
    /// Of each triangle and its edges, whether a facet of other width is beyond that begins or ends to bend there.
    pub is_step: Vec<[bool; 3]>,
}

/// Cosine of the angle up to which a fold is no step however wide the facets: a degree.
const SHALLOW: f64 = 0.999_847_695_156_391_2;

impl<'a> Bent<'a> {
    /// Finds where the curvature jumps, as between a cylinder and the rounding of its edge: where a facet of more than one
    /// triangle goes on as one less than half as wide, the wide one is straight across their edge, and its normal is that of both.
    pub fn new(sheets: &'a Sheets<'a>, is_flat: &'a [bool], facet: &[u32]) -> Self {
        let mut bent = Self {
            sheets,
            is_flat,
            is_step: vec![[false; 3]; sheets.triangles.len()],
        };
        // Triangles of a facet follow each other.
        let width = |t: u32, edge: usize| {
            let of = facet[t as usize];
            let from = facet.partition_point(|f| *f < of);
            let to = facet.partition_point(|f| *f <= of);
            let [a, b] = sheets.edges.ends[edge].map(|v| sheets.points[v as usize]);
            let along = (b - a).normalize_or_zero();
            let corners = (from..to).flat_map(|t| sheets.corners(t as u32));
            let off = corners.map(|p| (p - a).cross(along).length());
            (to - from, off.fold(0.0, f64::max))
        };
        for edge in 0..sheets.edges.len() {
            for u in sheets.edges.around(edge) {
                let (t, c) = (u.triangle, usize::from(u.corner));
                let Some(mate) = bent.beyond(t, c) else {
                    continue;
                };
                let [s, n] = [t, mate.triangle].map(|t| t as usize);
                if facet[s] == facet[n] || mate.triangle < t {
                    continue;
                }
                let ((count, wide), (other, narrow)) = (width(t, edge), width(mate.triangle, edge));
                let is_step = count > 1 && wide > 2.0 * narrow || other > 1 && narrow > 2.0 * wide;
                let cosine = sheets.normals[s].dot(sheets.normals[n]).abs();
                if is_step && cosine < SHALLOW {
                    bent.is_step[s][c] = true;
                    bent.is_step[n][mate.corner] = true;
                }
            }
        }
        bent
    }

    /// What goes on smoothly beyond the edge that begins at a corner of a triangle, both curved, and alike.
    pub fn beyond(&self, triangle: u32, corner: usize) -> Option<Mate> {
        let mate = self.sheets.mate(triangle, corner)?;
        let is_flat = self.is_flat[triangle as usize] || self.is_flat[mate.triangle as usize];
        (!is_flat && !self.is_step[triangle as usize][corner]).then_some(mate)
    }

    /// Whether an edge is just inside of a curved face.
    pub fn is_inside(&self, edge: usize) -> bool {
        match self.sheets.edges.around(edge) {
            [u, v] => {
                let mate = self.beyond(u.triangle, u.corner.into());
                mate.is_some_and(|m| m.triangle == v.triangle)
            }
            _ => false,
        }
    }
}
