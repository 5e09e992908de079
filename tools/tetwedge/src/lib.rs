//! Fills the templates of a document with tetrahedra, by TetGen.
//!
//! The surface's triangles say by their two sides where which region is, so no seeds are asked of
//! anybody. Mirror walls are refined freely: both neighbours of such a wall are images of the same
//! face. Seams get a surface that the elements need, by `surface`, unless that was done before;
//! then they and faces shared with another template are preserved. Afterwards every wall, volume and orientation is
//! checked again.

mod cli;
mod document;
mod done;
mod draws;
mod failing;
mod fill;
mod filling;
mod follow;
mod forecast;
mod kept;
mod leads;
mod memory;
mod score;
mod settle;
mod status;
mod surfaces;
mod template;

pub use cli::Cli;
pub use document::{Meshed, tetrahedralize};
pub use memory::MemoryArgs;
pub use status::watched;
pub use surfaces::surfaces;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod turned;
