//! What surfaces are made of, without any template: divisions of edges, frames in planes, triangulated patches.

mod division;
mod frame;
mod patch;

pub use division::{merged, reversed, same, symmetric};
pub use frame::Frame;
pub use patch::Patch;
