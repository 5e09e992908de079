//! What is asked of the elements, and what becomes of it: options, the bounds that a mesh is held against, and where it
//! is short of them.

mod args;
mod bound;
mod place;
mod sharp;
mod shortfall;
mod size_field;
mod strict;

pub use args::WishArgs;
pub use sharp::{Sharp, sharp_edges};
pub use shortfall::shortfalls;
pub use strict::StrictArgs;
