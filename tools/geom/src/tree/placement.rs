//! Where the boxes of a hierarchy are.

use super::boxes::Bounds;
use crate::rounding::power_of_two;
use glam::{DMat3, DVec3};

/// A frame in which coordinates are below two, whatever the model's unit and place.
pub struct Placement {
    /// Centre of the set.
    pub centre: DVec3,
    /// Half the size of the set, rounded down to a power of two.
    pub unit: f64,
    /// By what it is turned, if anything.
    pub turn: Option<DMat3>,
}

impl Placement {
    /// About a box that contains all, not turned. The order of coordinates is kept: what is not larger is
    /// not larger in the placement.
    pub fn of(bounds: Bounds) -> Self {
        let (centre, extent) = if bounds.low.cmple(bounds.high).all() {
            // Halved before adding: the sum of two large coordinates may overflow.
            let half = 0.5 * bounds.high - 0.5 * bounds.low;
            (0.5 * bounds.low + 0.5 * bounds.high, half.max_element())
        } else {
            (DVec3::ZERO, 0.0)
        };
        Self {
            centre,
            unit: power_of_two(extent),
            turn: None,
        }
    }

    /// A position of the model in the placement.
    #[inline]
    pub fn inside(&self, p: DVec3) -> DVec3 {
        let p = (p - self.centre) / self.unit;
        self.turn.map_or(p, |turn| turn * p)
    }

    /// A position in the placement in the model.
    #[inline]
    pub fn outside(&self, p: DVec3) -> DVec3 {
        self.turn.map_or(p, |turn| turn.transpose() * p) * self.unit + self.centre
    }
}
