//! The points that an isometry leaves where they are.

use crate::Isometry;
use glam::DVec3;

/// The set of points that an isometry leaves where they are, canonical frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FixedSet {
    /// All of space, for the identity.
    All,
    /// The plane through the z axis at the angle with this cosine and sine, for a vertical reflection.
    Vertical {
        /// Cosine.
        cos: f64,
        /// Sine.
        sin: f64,
    },
    /// The plane z = 0, for the horizontal reflection.
    Horizontal,
    /// The z axis, for a rotation.
    Axis,
    /// The line through the origin, in the plane z = 0, at the angle with this cosine and sine: for a half turn that
    /// turns the axis over.
    Radial {
        /// Cosine.
        cos: f64,
        /// Sine.
        sin: f64,
    },
    /// The origin, for a rotary reflection.
    Origin,
}

impl FixedSet {
    /// What an isometry leaves where it is.
    pub fn of(isometry: Isometry) -> Self {
        // A mirrored isometry turns by k / n of a turn what was reflected in the x axis: it keeps the direction at half that
        // angle.
        let (cos, sin) = isometry.half_angle();
        match (isometry.mirrored(), isometry.flipped(), isometry.k()) {
            (false, false, 0) => Self::All,
            (false, false, _) => Self::Axis,
            (false, true, 0) => Self::Horizontal,
            (false, true, _) => Self::Origin,
            (true, false, _) => Self::Vertical { cos, sin },
            (true, true, _) => Self::Radial { cos, sin },
        }
    }

    /// The plane that contains the master face of a gluing with this step, where that is flat: by convention at angle 0 for
    /// steps that turn about the z axis, through the axis of a half turn, and the mirror plane itself.
    pub fn of_master(step: Isometry) -> Self {
        match Self::of(step) {
            Self::Radial { cos, sin } => Self::Vertical { cos, sin },
            Self::Axis | Self::Origin => Self::Vertical { cos: 1.0, sin: 0.0 },
            other => other,
        }
    }

    /// The nearest point of the set. Coordinates that are zero on it are exactly zero, none of them negative.
    pub fn nearest(self, p: DVec3) -> DVec3 {
        let along = |cos: f64, sin: f64| {
            let r = p.x * cos + p.y * sin;
            // Adding zero turns a negative zero into zero.
            (r * cos + 0.0, r * sin + 0.0)
        };
        match self {
            Self::All => p,
            Self::Vertical { cos, sin } => {
                let (x, y) = along(cos, sin);
                DVec3::new(x, y, p.z)
            }
            Self::Horizontal => DVec3::new(p.x, p.y, 0.0),
            Self::Axis => DVec3::new(0.0, 0.0, p.z),
            Self::Radial { cos, sin } => {
                let (x, y) = along(cos, sin);
                DVec3::new(x, y, 0.0)
            }
            Self::Origin => DVec3::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MAX_TURN_DENOMINATOR;

    #[test]
    fn nearest_points_are_exact_where_they_can_be() {
        let low = FixedSet::of(Isometry::reflection(0, 1));
        let p = low.nearest(DVec3::new(-1.25, -1e-17, 0.5));
        assert_eq!(p, DVec3::new(-1.25, 0.0, 0.5));
        assert!(p.y.is_sign_positive());
        let (cos, sin) = Isometry::rotation(1, 10).cos_sin();
        let high = FixedSet::of(Isometry::reflection(1, 5));
        let p = high.nearest(DVec3::new(2.0 * cos, 2.0 * sin + 1e-16, 0.1));
        assert!((p - DVec3::new(2.0 * cos, 2.0 * sin, 0.1)).length() < 1e-15);
        assert_eq!(
            high.nearest(DVec3::new(0.0, 0.0, 3.0)),
            DVec3::new(0.0, 0.0, 3.0)
        );
        let across = FixedSet::of(Isometry::new(0, 1, false, true));
        assert_eq!(
            across.nearest(DVec3::new(1.0, 2.0, 1e-18)),
            DVec3::new(1.0, 2.0, 0.0)
        );
        // The largest denominator there is.
        let _ = FixedSet::of(Isometry::reflection(1, MAX_TURN_DENOMINATOR));
    }

    #[test]
    fn isometries_leave_their_sets_where_they_are() {
        for n in [1, 2, 3, 5, 8] {
            for k in 0..n {
                for (mirrored, flipped) in
                    [(false, false), (false, true), (true, false), (true, true)]
                {
                    let isometry = Isometry::new(i64::from(k), n, mirrored, flipped);
                    let set = FixedSet::of(isometry);
                    let p = set.nearest(DVec3::new(0.7, -1.3, 0.4));
                    assert!((isometry.apply(p) - p).length() < 1e-15, "{isometry}");
                    assert!((set.nearest(p) - p).length() < 1e-15, "{isometry}");
                }
            }
        }
    }
}
