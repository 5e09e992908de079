//! Tolerances of a search.

use crate::verify::Bound;

/// Share of samples that may be off in a scan, while axis and centre are still rough: one in eight.
pub const OUTLIERS: f64 = 0.125;

/// Deviations, in tolerances, that a candidate may have before axis and centre are adjusted. Both come from moments,
/// which every flaw shifts; an axis or a centre that is off by some distance displaces images by up to twice that, so
/// that this leaves room for each of them to be off by two tolerances.
const LOOSE: f64 = 8.0;
/// Bounds on that, relative to the radius. At tighter tolerances than the default one, moments know the axis no better.
/// Beyond a fifth of the radius, any order of any body passes.
pub const LOOSE_RANGE: [f64; 2] = [8e-3, 0.2];

/// Tolerances of a search, relative to the radius about the axis.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// What verified operations keep to.
    pub tolerance: f64,
    /// What candidates keep to before axis and centre are adjusted.
    pub loose: f64,
    /// Whether what the facets hide at a place is allowed on top there.
    pub facets: bool,
}

impl Limits {
    /// For a tolerance.
    pub fn new(tolerance: f64, facets: bool) -> Self {
        Self {
            tolerance,
            loose: (LOOSE * tolerance).clamp(LOOSE_RANGE[0], LOOSE_RANGE[1]),
            facets,
        }
    }

    /// How far from the surface images are taken into account when an operation that holds is adjusted: a few times
    /// what it deviates by or the tolerance, and never so little that the first sample that is off a little drops out.
    pub fn reach(&self, deviation: f64, radius: f64) -> f64 {
        let most = 0.5 * LOOSE * self.tolerance * radius;
        (4.0 * deviation).clamp(0.025 * most, most.max(4.0 * deviation))
    }

    /// The bound on deviations of verified operations for a radius.
    pub fn bound(&self, radius: f64) -> Bound {
        Bound {
            limit: self.tolerance * radius,
            facets: self.facets,
        }
    }

    /// The bound that something needs which deviates by so much: within the tolerance, the facets themselves agree.
    pub fn needed(&self, deviation: f64, radius: f64) -> Bound {
        let bound = self.bound(radius);
        Bound {
            facets: bound.facets && deviation > bound.limit,
            ..bound
        }
    }

    /// The bound on deviations of candidates for a radius.
    pub fn loosely(&self, radius: f64) -> Bound {
        Bound {
            limit: self.loose * radius,
            facets: self.facets,
        }
    }
}
