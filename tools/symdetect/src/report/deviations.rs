//! What of the residual is the facets', and what remains.

use crate::group::Found;
use crate::rotation::Query;
use crate::tolerance::EXACT;
use crate::verify::{Bound, Share};

/// The parts of the residual. Where a body is off, its facets stand off the shape behind them, or that shape is off its
/// image; either may be largest at another place.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Deviations {
    /// The most that facets explain at a place; `None` where they explain nothing.
    pub facets: Option<LargestDeviation>,
    /// The most that is left at a place; `None` for a body without symmetry.
    pub remaining: Option<LargestDeviation>,
}

/// A deviation, and where it is.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct LargestDeviation {
    /// How much, relative to the radius.
    pub largest: f64,
    /// Where, model units.
    pub at: [f64; 3],
}

impl Query<'_> {
    /// The parts of the residual of a group found.
    pub fn deviations(&self, found: &Found) -> Deviations {
        let is_off = found.verified.deviation.value > self.shape.precision.max(EXACT);
        let bound = Bound {
            facets: is_off && self.params.facets && self.facets_hide_something(),
            ..self.limits.bound(found.radius)
        };
        let shares = (found.verified).shares(self.shape, &found.frame, found.group, bound);
        let largest = |share: Share| LargestDeviation {
            largest: share.value / found.radius,
            at: self.shape.to_world(share.at).to_array(),
        };
        Deviations {
            facets: (shares.facets.value > self.shape.precision).then(|| largest(shares.facets)),
            remaining: Some(largest(shares.remaining)),
        }
    }
}
