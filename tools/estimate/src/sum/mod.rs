//! Sums over the section and the volume of a wedge, by distance from the axis.

pub mod classes;
pub mod integral;
pub mod piece;
pub mod samples;
pub mod section;
