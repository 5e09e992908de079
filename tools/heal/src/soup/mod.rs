//! From polygons in groups to a closed surface with solids on its sides.

mod build;
mod closure;
mod coincident;
mod imprinted;
mod mended;
mod mending;
mod needles;
mod precision;
mod shells;
mod solids;
mod stitch;
mod surface;
mod undrawn;
mod weld;

pub use build::{build, label_mended, mend};
pub use closure::odd_edges;
pub use mended::{Mended, join};
pub use mending::Mending;
pub use surface::{NONE, Surface};
pub use undrawn::Undrawn;
