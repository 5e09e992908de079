//! Abaqus and CalculiX.

mod conditions;
mod cyclic;
mod names;
mod number;
mod sets;
mod write;

pub use write::{size_estimate, write};
