//! Assembles the whole mesh from instances of a wedge.
//!
//! Global vertex ids are index arithmetic on the stored walls ([`Numbering`]); the mesh is a stream
//! ([`Assembled`]) that the writers of `interchange` and [`write_expanded`] take block by block.

mod assembled;
mod cli;
mod expand;
mod numbering;
mod orbit;
mod pairs;
mod piece;
mod promise;
mod sector;
mod solver;

pub use assembled::Assembled;
pub use cli::Cli;
pub use expand::write_expanded;
pub use numbering::{Numbering, NumberingError};
pub use pairs::{TableFormat, write_pairs};
pub use piece::Piece;
pub use sector::{sector, sort_by_region};
pub use solver::{Conditions, MirrorWish, conditions};
