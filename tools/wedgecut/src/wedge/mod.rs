//! The templates that are made of the cut surface: the wedge and the hub.

mod assemble;
mod closed;
mod fan;
mod hub;

pub use assemble::{Caps, Parts, assemble, whole};
pub use hub::{Inner, unite};
