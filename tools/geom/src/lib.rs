//! Geometry shared by the tools: measures of triangles and tetrahedra, edge adjacency, the order of
//! triangles around an edge, and the cells a triangle complex divides space into.

pub mod edges;
pub mod measure;
pub mod sides;
pub mod tet;
