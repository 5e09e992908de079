//! Fills the templates of a document with tetrahedra, by TetGen.
//!
//! The surface's triangles say by their two sides where which region is, so no seeds are asked of
//! anybody. Mirror walls are refined freely: both neighbours of such a wall are images of the same
//! face. Seams and faces shared with another template are preserved. Afterwards every wall, volume
//! and orientation is checked again.

mod bound;
mod cells;
mod check;
mod cli;
mod diagnose;
mod elements;
mod error;
mod facets;
mod fill;
mod flat;
mod improve;
mod mesher;
mod params;
mod plc;
mod seeds;
mod surface;
mod walls;

pub use cli::Cli;
pub use elements::ElementArgs;
pub use error::{Error, Place, RegionName};
pub use mesher::{Meshed, tetrahedralize};
pub use params::{DEFAULT_OPTIMIZE, Params, RegionSize, Sizes, volume_of_edge};
pub use surface::{Made, Other, SurfaceError, impose, make};

#[cfg(test)]
mod bodies;
#[cfg(test)]
mod tests;
