//! Polygons and planar facets, broken into triangles.

mod enclosed;
mod plane;
mod polygon;

pub use enclosed::enclosed;
pub use plane::{Projection, area_vector};
pub use polygon::triangles_of;
