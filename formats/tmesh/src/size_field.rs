//! Lengths of edges wanted that change from place to place, as a mesh with a length at each point.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

/// A point at which a length of edges is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SizePoint {
    /// World coordinates, model units; finite.
    pub position: DVec3,
    /// Length of edges wanted there, model units; finite, above zero.
    pub size: f64,
}

/// The length of edges wanted in a body as a whole, linear in each element of a mesh of its own. It has tetrahedra or triangles, or
/// both. It belongs to the assembled body and knows nothing of templates and instances: whoever asks for the length in a template
/// takes the least of those at the images of the place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SizeField {
    /// Points.
    pub points: Vec<SizePoint>,
    /// Tetrahedra by their points, oriented either way; flat ones say nothing.
    pub tets: Vec<[u32; 4]>,
    /// Triangles by their points.
    pub triangles: Vec<[u32; 3]>,
}
