//! Legacy VTK, and what the XML form has in common with it.

pub mod cells;
pub mod fields;
mod read;
mod write;

pub use read::{looks_like, read, read_points};
pub use write::{size_estimate, write};
