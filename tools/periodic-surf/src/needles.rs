//! Needles that CAD kernels leave on curved surfaces.

use geom::edges::{Edges, apex_of};
use geom::measure::double_area_vector;
use glam::DVec3;
use tmesh::Template;

/// What a needle is.
pub struct Needle {
    /// It is narrower than this, model units.
    pub narrow: f64,
    /// Cosine of the angle from which on an edge is a feature.
    pub feature: f64,
    /// Within this of a plane, points are in it, model units.
    pub flat: f64,
}

impl Needle {
    /// Whether a surface has any: a narrow triangle beyond whose longest edge the surface bends a little. The walls of layers
    /// and strips of cylinders are divided by their longest edges, and flat.
    pub fn is_in(&self, template: &Template) -> bool {
        let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        let edges = Edges::new(&triangles);
        let at = |v: u32| template.vertices[v as usize];
        let corners = |t: u32| triangles[t as usize].map(at);
        (0..edges.len()).any(|e| {
            let [u, v] = edges.around(e) else {
                return false;
            };
            let [a, b] = edges.ends[e].map(at);
            let length = a.distance(b);
            let vectors = [u, v].map(|u| {
                let [a, b, c] = corners(u.triangle);
                double_area_vector(a, b, c)
            });
            let [m, n] = vectors.map(DVec3::normalize_or_zero);
            let is_alike = {
                let [s, t] = [u, v].map(|u| template.triangles[u.triangle as usize]);
                (s.marker, s.front, s.back) == (t.marker, t.front, t.back)
            };
            let bends = is_alike && m.dot(n) >= self.feature;
            bends
                && [(u, vectors[0], n), (v, vectors[1], m)]
                    .into_iter()
                    .any(|(u, area, beyond)| {
                        let apex = at(apex_of(&triangles[u.triangle as usize], u.corner));
                        let is_longest = apex.distance(a).max(apex.distance(b)) <= length;
                        let height = area.length() / length;
                        is_longest
                            && height < self.narrow
                            && (apex - a).dot(beyond).abs() > self.flat
                    })
        })
    }
}
