//! Joining of points that are the same, exactly or up to rounding.

mod exact;
mod near;

pub use exact::Welder;
pub use near::near_points;
