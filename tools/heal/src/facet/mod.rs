//! Polygons and planar facets, broken into triangles.

mod plane;
mod polygon;
mod triangulate;

pub use plane::{Projection, area_vector};
pub use polygon::triangles_of;
pub use triangulate::{FacetError, triangulate};
