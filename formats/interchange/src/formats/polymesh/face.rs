//! One face of the mesh.

/// A face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Three point ids; the normal points out of the owner.
    pub vertices: [u32; 3],
    /// The tetrahedron behind it, of two the lower one.
    pub owner: u32,
    /// The other one; the owner for a face of the boundary.
    pub neighbour: u32,
}
