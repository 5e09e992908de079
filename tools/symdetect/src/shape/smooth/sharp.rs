//! Where smooth surfaces end.

use crate::shape::smooth::facets::Facets;
use crate::shape::smooth::heights::barycentric;
use crate::tolerance::VANISHING;
use glam::DVec3;

/// The sharp edges of a surface.
pub struct SharpEdges {
    /// Whether each edge of each triangle is one.
    of: Vec<[bool; 3]>,
    /// Whether one ends at each vertex.
    at: Vec<bool>,
}

impl SharpEdges {
    /// These edges of the facets.
    pub fn new(facets: &Facets<'_>, edges: impl Iterator<Item = usize>) -> Self {
        let mut sharp = Self {
            of: vec![[false; 3]; facets.triangles.len()],
            at: vec![false; facets.vertices.len()],
        };
        for e in edges {
            for u in facets.edges.around(e) {
                sharp.of[u.triangle as usize][u.corner as usize] = true;
            }
            for v in facets.edges.ends[e] {
                sharp.at[v as usize] = true;
            }
        }
        sharp
    }

    /// Whether one passes a point of a triangle.
    pub fn pass(
        &self,
        (vertices, triangles): (&[DVec3], &[[u32; 3]]),
        (triangle, point): (u32, DVec3),
    ) -> bool {
        let corners = triangles[triangle as usize];
        let parts = barycentric(corners.map(|v| vertices[v as usize]), point);
        let is_off = |c: usize| parts[c % 3] <= VANISHING;
        (0..3).any(|c| {
            let on_edge = is_off(c + 2) && self.of[triangle as usize][c];
            let on_vertex = is_off(c + 1) && is_off(c + 2);
            on_edge || on_vertex && self.at[corners[c] as usize]
        })
    }
}
