//! Gmsh: both versions are read alike, and written each for itself.

mod file;
mod node_data;
mod read;
mod scan;
mod write;
mod write2;

pub use read::{looks_like, read, read_points};
pub use write::{size_estimate, write};
pub use write2::{size_estimate as size_estimate2, write as write2};
