//! VTK XML unstructured grids, in one file and in pieces.

mod arrays;
mod read;
mod spool;
mod write;

pub use read::{looks_like, read, read_points};
pub use write::{size_estimate, write, write_pieces};
