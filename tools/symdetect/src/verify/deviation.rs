//! Deviations, and what deviations are allowed.

use glam::DVec3;

/// A deviation and where it was found.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// Distance of an image from the surface, in the units of the shape.
    pub value: f64,
    /// The sample whose image is that far off.
    pub at: DVec3,
    /// Its image.
    pub image: DVec3,
    /// Whether it is the largest of the whole surface ([`crate::faces`]), not of samples.
    pub everywhere: bool,
}

impl Deviation {
    /// No deviation.
    pub const NONE: Self = Self {
        value: 0.0,
        at: DVec3::ZERO,
        image: DVec3::ZERO,
        everywhere: true,
    };

    /// Before the first test.
    pub const UNTESTED: Self = Self {
        everywhere: false,
        ..Self::NONE
    };

    /// The larger of two.
    pub fn max(self, other: Self) -> Self {
        let larger = if other.value > self.value {
            other
        } else {
            self
        };
        Self {
            everywhere: self.everywhere && other.everywhere,
            ..larger
        }
    }
}

/// How thorough a verification is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// A few thousand tests: enough to rank candidates.
    Quick,
    /// Every vertex and face sample for one step of the rotation and for one mirror, and a share of
    /// them for all other operations.
    Full,
}

/// What deviations are allowed, in the units of the shape.
#[derive(Clone, Copy, Debug)]
pub struct Bound {
    /// Anywhere.
    pub limit: f64,
    /// Whether what the facets hide at a place is allowed on top there.
    pub facets: bool,
}

impl Bound {
    /// The same everywhere.
    pub fn plain(limit: f64) -> Self {
        Self {
            limit,
            facets: false,
        }
    }
}
