//! A group found.

use crate::shape::Permutation;
use crate::verify::{Deviation, Verified};
use tmesh::{Frame, Group};

/// A frame, the group in it, and how well it holds.
#[derive(Clone)]
pub struct Found {
    /// The canonical frame of the group.
    pub frame: Frame,
    /// The frame before it was adjusted to all operations and rounded.
    pub rough: Frame,
    /// Largest distance of the surface from the axis.
    pub radius: f64,
    /// The group.
    pub group: Group,
    /// How well it holds, and what it does to regions.
    pub verified: Verified,
    /// Whether all orders hold.
    pub axisymmetric: bool,
    /// Whether the order stands out; false for a body of revolution without a facet count.
    pub distinct: bool,
}

/// A single operation found beside the rotations.
pub struct Beside {
    /// Frame in which the operation has its standard matrix.
    pub frame: Frame,
    /// Largest deviation, in the units of the shape.
    pub deviation: Deviation,
    /// What it does to regions.
    pub permutation: Permutation,
}
