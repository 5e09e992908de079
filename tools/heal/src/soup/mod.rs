//! From polygons in groups to a closed surface with solids on its sides.

mod build;
mod closure;
mod coincident;
mod imprinted;
mod mending;
mod needles;
mod notices;
mod solids;
mod stitch;
mod surface;
mod tables;
mod weld;

pub use build::build;
pub use closure::odd_edges;
