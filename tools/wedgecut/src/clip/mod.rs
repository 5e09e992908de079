//! Cutting a surface at the faces of a cell.

mod cutter;
mod divide;
mod local;
mod shared;

pub use divide::{clip, divide_at_hub};
