//! Writing the mesh and what goes with it.

mod expand;
mod files;
mod pairs;
mod pieces;

pub use expand::write_expanded;
pub use files::{write_mesh, write_stream};
pub use pairs::{TableFormat, write_pairs};
pub use pieces::write_pvtu;
