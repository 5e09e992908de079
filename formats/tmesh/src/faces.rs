//! Triangles and tetrahedra as arrays of vertex ids, as geometry wants them.

use crate::{Template, Tet, Triangle};

impl From<&Triangle> for [u32; 3] {
    fn from(triangle: &Triangle) -> Self {
        triangle.vertices
    }
}

impl From<Triangle> for [u32; 3] {
    fn from(triangle: Triangle) -> Self {
        triangle.vertices
    }
}

impl From<&Tet> for [u32; 4] {
    fn from(tet: &Tet) -> Self {
        tet.vertices
    }
}

impl From<Tet> for [u32; 4] {
    fn from(tet: Tet) -> Self {
        tet.vertices
    }
}

impl Template {
    /// The corners of each triangle with the regions on its front and on its back side.
    pub fn faces(&self) -> impl Iterator<Item = ([u32; 3], [u32; 2])> + Clone {
        self.triangles
            .iter()
            .map(|t| (t.vertices, [t.front, t.back]))
    }
}
