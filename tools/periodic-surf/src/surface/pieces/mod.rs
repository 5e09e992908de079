//! What surfaces are made of, without any template: divisions of edges, frames in planes.

mod division;
mod frame;

pub use division::{merged, reversed, same, symmetric};
pub use frame::Frame;
