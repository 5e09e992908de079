//! Air around a body: a region between its surface and a simple outer boundary that has the symmetry found.

mod air;
mod fluid;
mod outline;
mod surface;

pub use air::fill;
pub use outline::{Content, Enclosure, Impossible};
