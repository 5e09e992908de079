//! Flat parts of a surface.

use geom::edges::Edges;
use geom::flat::{Flatness, Flats};
use glam::DVec3;
use tmesh::Triangle;

/// Numbers connected sets of faces with equal attributes that lie within `flatness` (model units)
/// of the plane of their largest face.
pub fn flat_patches(points: &[DVec3], faces: &[Triangle], flatness: f64) -> Vec<u32> {
    let corners: Vec<[u32; 3]> = faces.iter().map(|f| f.vertices).collect();
    let across = Edges::new(&corners).across();
    let flatness = |_| {
        [Flatness {
            distance: flatness,
            // No face of a patch is turned over.
            cosine: 0.0,
        }]
    };
    let attributes = |t: u32| {
        let f = &faces[t as usize];
        (f.marker, f.front, f.back)
    };
    let alike = |seed, t| attributes(seed) == attributes(t);
    Flats::new(points, &corners, &across, flatness, alike)
        .regions
        .of
}
