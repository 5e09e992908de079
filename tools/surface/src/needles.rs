//! Needles that CAD kernels leave on curved surfaces.

use crate::joined::on_faces;
use geom::edges::{EdgeUse, Edges, apex_of};
use geom::measure::double_area_vector;
use glam::DVec3;
use tmesh::{Document, Template};

/// What a needle is: a narrow triangle in no plane with another one, beyond whose longest edge the surface goes on smoothly.
/// The walls of layers and strips of cylinders are divided by their longest edges, and flat.
pub struct Needle {
    /// It is narrower than this, model units.
    pub narrow: f64,
    /// Cosine of the angle from which on an edge is a feature.
    pub feature: f64,
    /// Within this of a plane, points are in it, model units.
    pub flat: f64,
}

impl Needle {
    /// Whether the surface of a template has any that are not pieces which a cut left. Linear.
    pub fn is_in(&self, document: &Document, index: usize) -> bool {
        let template = &document.templates[index];
        let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        let surface = Facets {
            template,
            edges: Edges::new(&triangles),
        };
        let is_cut = on_faces(document, index, |_| true);
        let at_walls = |t: &[u32; 3]| t.iter().any(|&v| is_cut[v as usize]);
        let mut left_out: Vec<bool> = triangles.iter().map(at_walls).collect();
        let mut may_be = vec![false; triangles.len()];
        for e in 0..surface.edges.len() {
            let [u, v] = surface.edges.around(e) else {
                continue;
            };
            for (u, beyond) in [(u, v), (v, u)] {
                let t = u.triangle as usize;
                left_out[t] |= surface.height(u, beyond) <= self.flat;
                may_be[t] |=
                    surface.is_narrow(u, self.narrow) && surface.goes_on(u, beyond, self.feature);
            }
        }
        may_be
            .iter()
            .zip(&left_out)
            .any(|(may_be, out)| *may_be && !out)
    }
}

/// The triangles of a template, and their edges.
struct Facets<'a> {
    template: &'a Template,
    edges: Edges,
}

impl Facets<'_> {
    fn corners(&self, t: u32) -> [DVec3; 3] {
        let corners = self.template.triangles[t as usize].vertices;
        corners.map(|v| self.template.vertices[v as usize])
    }

    fn normal(&self, t: u32) -> DVec3 {
        let [a, b, c] = self.corners(t);
        double_area_vector(a, b, c).normalize_or_zero()
    }

    /// How far the corner across from an edge is off the plane of the triangle beyond.
    fn height(&self, u: &EdgeUse, beyond: &EdgeUse) -> f64 {
        let corners = self.template.triangles[u.triangle as usize].vertices;
        let apex = self.template.vertices[apex_of(&corners, u.corner) as usize];
        let [on, ..] = self.corners(beyond.triangle);
        (apex - on).dot(self.normal(beyond.triangle)).abs()
    }

    /// Whether an edge is the longest of a triangle that is narrower than this.
    fn is_narrow(&self, u: &EdgeUse, narrow: f64) -> bool {
        let corners = self.corners(u.triangle);
        let [a, b, c] = [0, 1, 2].map(|i| corners[(u.corner as usize + i) % 3]);
        let length = a.distance(b);
        let is_longest = c.distance(a).max(c.distance(b)) <= length;
        is_longest && double_area_vector(a, b, c).length() < narrow * length
    }

    /// Whether the same surface goes on beyond an edge, and without a feature there.
    fn goes_on(&self, u: &EdgeUse, beyond: &EdgeUse, feature: f64) -> bool {
        let [s, t] = [u, beyond].map(|u| &self.template.triangles[u.triangle as usize]);
        let is_alike = (s.marker, s.front, s.back) == (t.marker, t.front, t.back);
        let [m, n] = [u, beyond].map(|u| self.normal(u.triangle));
        is_alike && m.dot(n) >= feature
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{OUTSIDE, Triangle};

    const NEEDLE: Needle = Needle {
        narrow: 1e-3,
        feature: 0.866,
        flat: 1e-9,
    };

    fn has_needles(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> bool {
        let triangle = |&vertices: &[u32; 3]| Triangle {
            vertices,
            marker: 1,
            front: OUTSIDE,
            back: 1,
        };
        let template = Template {
            vertices: vertices.iter().map(|&p| p.into()).collect(),
            triangles: triangles.iter().map(triangle).collect(),
            ..Template::default()
        };
        NEEDLE.is_in(&Document::single(template), 0)
    }

    /// Two facets that meet at an angle, and a vertex beside their edge.
    fn beside_an_edge(slope: f64, at: [f64; 3]) -> bool {
        let vertices = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.5, 1.0, 0.0],
            [0.5, -1.0, slope],
            at,
        ];
        has_needles(&vertices, &[[0, 1, 4], [1, 2, 4], [2, 0, 4], [1, 0, 3]])
    }

    #[test]
    fn needles_are_in_no_plane_with_others() {
        assert!(beside_an_edge(0.2, [0.5, 1e-5, 1e-6]));
        // A part of a flat face.
        assert!(!beside_an_edge(0.2, [0.5, 1e-5, 0.0]));
        assert!(!beside_an_edge(0.0, [0.5, 1e-5, 0.0]));
        // Not narrow.
        assert!(!beside_an_edge(0.2, [0.5, 2e-3, 1e-6]));
        // Beside a feature.
        assert!(!beside_an_edge(2.0, [0.5, 1e-5, 1e-6]));
    }

    #[test]
    fn walls_of_layers_are_no_needles() {
        let vertices = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 0.0, 1e-5],
            [0.0, 0.0, 1e-5],
            [2.0, 0.3, 0.0],
            [2.0, 0.3, 1e-5],
        ];
        let walls = [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]];
        assert!(!has_needles(&vertices, &walls));
    }
}
