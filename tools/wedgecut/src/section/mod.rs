//! Sections of a surface with the faces of a cell: their edges, the curves these make, and the caps that close them.

mod cap;
mod chains;
mod edges;

pub use cap::Known;
pub use chains::{Chain, Place, chains, project};
pub use edges::{Piece, Section};
