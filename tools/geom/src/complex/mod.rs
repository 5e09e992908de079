//! Complexes of triangles: edges and neighbours, the two sides of each triangle and the cells of space that
//! they bound, flat regions, and where triangles meet that should not.

pub mod cells;
pub mod contacts;
pub mod edges;
pub mod flat;
pub mod sides;
