//! Isometries of the canonical frame, what they leave in place, the groups that they form, and the frame itself.

mod fixed;
mod frame;
mod group;
mod isometry;

pub use fixed::FixedSet;
pub use frame::Frame;
pub use group::{Group, Kind, NotAGroup};
pub(crate) use isometry::lcm;
pub use isometry::{Isometry, MAX_TURN_DENOMINATOR, Placed, ROUNDING};
