//! Verification of operations: how far the image of the surface is from the surface.

mod behind;
mod deviation;
mod faces;
mod family;
mod group;
mod measured;
mod one;
mod operation;
mod regions;
mod revolution;
mod shares;
mod worst;

pub use deviation::{Bound, Depth, Deviation};
pub use group::{Check, Verified};
pub use operation::{Operation, golden_rotations, golden_turns, some_powers, turn_matrix};
pub use shares::Share;
