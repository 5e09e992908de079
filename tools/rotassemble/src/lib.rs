//! Assembles the whole mesh from instances of a wedge.
//!
//! Global vertex ids are index arithmetic on the stored walls ([`Numbering`]); the mesh is a stream
//! ([`Assembled`]) that the writers of `interchange` and [`write_expanded`] take block by block.

mod cli;
mod curved;
mod mesh;
mod numbering;
mod promise;
mod sector;
mod solver;
mod write;

pub use cli::Cli;
pub use mesh::{Assembled, Piece};
pub use numbering::{Numbering, NumberingError};
pub use sector::{sector, sort_by_region};
pub use solver::{Conditions, MirrorWish, conditions};
pub use write::{TableFormat, write_expanded, write_pairs};
