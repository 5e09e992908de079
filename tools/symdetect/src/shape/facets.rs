//! How far the smooth surface that facets stand for may be from the facets.
//!
//! Corners of a drawn surface lie on the surface that was drawn, or on a facet of it where drawings
//! were cut with each other; between them a facet is off by the sagitta of its arc. Two drawings of
//! one shape differ by no more than the larger of the two, and both are drawn about equally
//! coarsely. A feature of its own (a dent, an oval bore) moves corners without making the facets
//! coarse at the places that it should have had images at.

use crate::shape::flat::Flats;
use crate::shape::table::Table;
use geom::edges::Edges;
use glam::DVec3;

/// Cosine of the angle up to which two facets may belong to one smooth surface: 30 degrees.
const SMOOTH: f64 = 0.866;
/// What the facets of a surface may hide.
pub struct Facets {
    /// By how much the drawn surface may be off each triangle, in the units of the shape.
    bulge: Vec<f32>,
    /// The triangles at each vertex.
    around: Table,
}

impl Facets {
    /// Estimates the bulge of every facet from the angles with its neighbours. An arc that turns by
    /// `a` and `b` at the two sides of a facet of width `w` turns by at most `a + b` across it, so
    /// that its sagitta is at most `w (a + b) / 8`; both angles are taken for the larger one. A facet
    /// is all that lies in one plane, however it is divided into triangles. Where the widths of
    /// neighbours differ the narrower one counts: the wider one may be flat.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]], normals: &[DVec3]) -> Self {
        let edges = Edges::new(triangles);
        let flats = Flats::new(triangles, normals, &edges);
        let mut of_flat = vec![0.0_f32; flats.count()];
        for edge in 0..edges.len() {
            let Some((t, s, cosine)) = smooth(&edges, edge, normals) else {
                continue;
            };
            let (p, q) = (flats.of[t], flats.of[s]);
            if p == q {
                continue;
            }
            let [a, b] = edges.ends[edge].map(|v| vertices[v as usize]);
            let along = (b - a).normalize_or_zero();
            let width = |flat: u32| {
                let across = |v: &u32| (vertices[*v as usize] - a).cross(along).length();
                flats.corners(flat).iter().map(across).fold(0.0, f64::max)
            };
            let angle = libm::acos(cosine.min(1.0));
            let most = (0.25 * angle * width(p).min(width(q))) as f32;
            for flat in [p, q] {
                let bulge = &mut of_flat[flat as usize];
                *bulge = bulge.max(most);
            }
        }
        let bulge = flats.of.iter().map(|f| of_flat[*f as usize]).collect();
        let corners = triangles.iter().enumerate();
        let pairs = corners.flat_map(|(t, corners)| corners.iter().map(move |&v| (v, t as u32)));
        Self {
            bulge,
            around: Table::new(vertices.len(), pairs),
        }
    }

    /// The largest bulge of any facet.
    pub fn largest(&self) -> f64 {
        f64::from(self.bulge.iter().copied().fold(0.0, f32::max))
    }

    /// The largest bulge of the facets at the corners of a triangle: the flat end of a round bore
    /// shares that of the bore.
    pub fn around(&self, corners: [u32; 3]) -> f64 {
        let bulges = corners.iter().flat_map(|&v| {
            let at_vertex = self.around.of(v).iter();
            at_vertex.map(|&t| self.bulge[t as usize])
        });
        f64::from(bulges.fold(0.0, f32::max))
    }
}

/// The triangles on either side of an edge and the cosine between them, where the surface may be
/// smooth there.
fn smooth(edges: &Edges, edge: usize, normals: &[DVec3]) -> Option<(usize, usize, f64)> {
    let [u, v] = edges.around(edge) else {
        return None;
    };
    let (t, s) = (u.triangle as usize, v.triangle as usize);
    let side = if u.forward == v.forward { -1.0 } else { 1.0 };
    let cosine = side * normals[t].dot(normals[s]);
    (cosine >= SMOOTH).then_some((t, s, cosine))
}
