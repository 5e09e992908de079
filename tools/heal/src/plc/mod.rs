//! From a piecewise linear complex to regions and their boundaries.

mod build;
mod facets;
mod loose;
mod regions;
mod segments;

pub use build::build;
