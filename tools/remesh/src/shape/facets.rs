//! What is beside facets: whether they are some of many that stand for something curved.

use geom::edges::{EdgeUse, Edges};
use glam::DVec3;

/// A degree, in radians: what is bent by less may be the same face, however wide.
const SHALLOW: f64 = std::f64::consts::PI / 180.0;

/// Sets of triangles in one plane each.
pub struct Facets<'a> {
    /// Positions, model units.
    pub points: &'a [DVec3],
    /// Vertex ids.
    pub triangles: &'a [[u32; 3]],
    /// Unit normals of the triangles.
    pub normals: &'a [DVec3],
    /// Edges of the triangles.
    pub edges: &'a Edges,
    /// Facet of each triangle.
    pub of: &'a [u32],
    /// How far something curved may rise above its chords, model units, that goes on beside a wider facet: the facet would turn on
    /// both sides as it does at the edge between. Of what rises more the facet is no part: it is flat, and a fine drawing of a
    /// rounding begins beside it.
    pub rise: f64,
}

/// What is beside a facet. Lengths are in model units.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// Number of its triangles.
    pub triangles: u32,
    /// Length of its outline.
    pub border: f64,
    /// Length of the part beside which the surface goes on smoothly.
    pub smooth: f64,
    /// Length of the part of it beside which it goes on with a facet of half its width at least, across the edge, or is bent
    /// by less than a degree and does not rise far.
    pub like: f64,
    /// The first of the facets beyond that part.
    pub first: Option<u32>,
    /// Whether there are others.
    pub more: bool,
}

impl Facets<'_> {
    /// What is beside each of so many facets; `mate` has the triangle that goes on smoothly beyond an edge.
    pub fn beside(
        &self,
        count: usize,
        mate: impl Fn(usize, &EdgeUse) -> Option<EdgeUse>,
    ) -> Vec<Beside> {
        let mut members = vec![Vec::new(); count];
        let mut beside = vec![Beside::default(); count];
        for (t, &facet) in self.of.iter().enumerate() {
            members[facet as usize].extend(self.triangles[t]);
            beside[facet as usize].triangles += 1;
        }
        for edge in 0..self.edges.len() {
            let [a, b] = self.edges.ends[edge].map(|v| self.points[v as usize]);
            let length = a.distance(b);
            let along = (b - a).normalize_or_zero();
            let width = |facet: u32| {
                let points = members[facet as usize].iter();
                let off = points.map(|&v: &u32| (self.points[v as usize] - a).cross(along));
                off.map(DVec3::length).fold(0.0, f64::max)
            };
            for u in self.edges.around(edge) {
                let f = self.of[u.triangle as usize];
                let Some(v) = mate(edge, u) else {
                    beside[f as usize].border += length;
                    continue;
                };
                let g = self.of[v.triangle as usize];
                // Once for both.
                if f == g || (v.triangle, v.corner) < (u.triangle, u.corner) {
                    continue;
                }
                let (w, x) = (width(f), width(g));
                let [m, n] = [u, &v].map(|u| self.normals[u.triangle as usize]);
                let turn = libm::atan2(m.cross(n).length(), m.dot(n).abs());
                let is_like = |w: f64, x: f64| {
                    w <= 2.0 * x || turn <= SHALLOW && 0.25 * turn * w <= self.rise
                };
                for (facet, beyond, like_it) in [(f, g, is_like(w, x)), (g, f, is_like(x, w))] {
                    let facet = &mut beside[facet as usize];
                    facet.border += length;
                    facet.smooth += length;
                    if like_it {
                        facet.like += length;
                        facet.more |= facet.first.is_some_and(|first| first != beyond);
                        facet.first.get_or_insert(beyond);
                    }
                }
            }
        }
        beside
    }
}
