//! The whole group about an axis: mirrors and what turns the axis over beside a rotation, the frame adjusted to all of
//! them, and the whole verified.

mod certify;
mod complete;
mod found;
mod meant;
mod placement;
mod plane;
mod slid;
mod turned;

pub use found::Found;
pub use placement::{forward, reference};
