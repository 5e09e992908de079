//! Polygons and planar facets, broken into triangles.

mod plane;
mod polygon;

pub use plane::{Projection, area_vector};
pub use polygon::triangles_of;
