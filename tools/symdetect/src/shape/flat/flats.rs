//! Flats of a surface: what lies in one plane.

use crate::budget::SCAN;
use crate::shape::table::Table;
use crate::tolerance::SINGLE;
use geom::edges::Edges;
use geom::flat::Regions;
use glam::DVec3;

/// Cosine of the angle up to which directions count as the same, of normals in one flat and of edges in one line:
/// cosines between directions from coordinates in single precision are no better known. The angle is 0.08 degrees.
pub const SAME_DIRECTION: f64 = 1.0 - SINGLE;

/// Triangles that lie in one plane and hang together.
pub struct Flats {
    /// Flat of each triangle.
    pub of: Vec<u32>,
    /// Some vertices of each flat, by which its width is measured.
    corners: Table,
}

impl Flats {
    /// Grows flats from their first triangle, so that they cannot creep around a bend. Linear.
    pub fn new(triangles: &[[u32; 3]], normals: &[DVec3], edges: &Edges) -> Self {
        let count = triangles.len() as u32;
        let regions = Regions::grow(&edges.across(), 0..count, |seed, t| {
            normals[t as usize].dot(normals[seed as usize]) > SAME_DIRECTION
        });
        let corners = regions.of.iter().zip(triangles);
        let corners = corners.flat_map(|(&flat, corners)| corners.iter().map(move |&v| (flat, v)));
        let mut vertices = Table::new(regions.seeds.len(), corners);
        vertices.thin_out(SCAN);
        Self {
            of: regions.of,
            corners: vertices,
        }
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.corners.len()
    }

    /// Some vertices of a flat.
    pub fn corners(&self, flat: u32) -> &[u32] {
        self.corners.of(flat)
    }
}
