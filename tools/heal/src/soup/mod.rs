//! From polygons in groups to a closed surface with solids on its sides.

mod build;
mod closure;
mod coincident;
mod gaps;
mod needles;
mod notices;
mod solids;
mod surface;
mod tables;
mod weld;

pub use build::build;
pub use closure::odd_edges;
