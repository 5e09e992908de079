//! Nastran bulk data.

mod cards;
mod number;
mod read;
mod write;

pub use read::{looks_like, read};
pub use write::{size_estimate, write};
