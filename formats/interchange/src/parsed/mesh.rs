//! A mesh whose elements carry their regions and markers.

use glam::DVec3;
use std::collections::BTreeMap;
use tmesh::{Promise, Source, Symmetry, Tet, Triangle};

/// Tetrahedra with regions, and triangles with markers. All ids are within bounds, no element names a
/// vertex twice, and no tetrahedron is in [`tmesh::OUTSIDE`].
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Vertices in world coordinates. All finite.
    pub points: Vec<DVec3>,
    /// Tetrahedra in the order of the file; orientation as in the file.
    pub tets: Vec<Tet>,
    /// Triangles in the order of the file.
    pub triangles: MeshTriangles,
    /// Names of regions by id.
    pub regions: BTreeMap<u32, String>,
    /// Names of markers by id.
    pub markers: BTreeMap<u32, String>,
    /// The symmetry that the title of the file promises.
    pub promise: Option<Promise>,
    /// How many instances the whole has, where the title of the file says that it holds one sector.
    pub sector_of: Option<u32>,
    /// What was known of the body when it was written to the file.
    pub finding: Option<Box<Finding>>,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
    /// What the user should know about the file.
    pub notices: Vec<String>,
}

/// What the file says of the surface of a [`Mesh`].
#[derive(Clone, Debug)]
pub enum MeshTriangles {
    /// All of it, with the regions on both sides.
    Sided(Vec<Triangle>),
    /// Some of it: three vertices and a marker each.
    Marked(Vec<([u32; 3], u32)>),
}

/// What a file says of the symmetry of its body. Nothing of it has been checked.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The symmetry found in the body.
    pub symmetry: Symmetry,
    /// What the body was read from.
    pub source: Option<Source>,
}
