//! Geometry shared by the tools: measures of triangles and tetrahedra, edge adjacency, the order of
//! triangles around an edge, the cells a triangle complex divides space into, and where triangles
//! meet that should not; and parts of what is joined two at a time.

pub mod alignment;
pub mod cdt;
pub mod cells;
pub mod contacts;
pub mod edges;
pub mod eigen;
pub mod fan;
pub mod flat;
pub mod grid;
pub mod measure;
pub mod predicate;
pub mod sets;
pub mod sides;
pub mod tet;
pub mod tolerance;
pub mod tree;
pub mod weld;

/// The former name of [`tree`].
pub mod bvh {
    pub use crate::tree::{Nearest, Tree as Bvh, closest_point};
}
