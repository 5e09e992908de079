//! TetGen: piecewise linear complexes are read, meshes are written.

mod poly;
mod write;

pub use poly::{looks_like, read_poly, read_smesh};
pub use write::{PARTS, size_estimate, write_part};
