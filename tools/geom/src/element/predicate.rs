//! Exact predicates.

use glam::DVec3;
use robust::{Coord3D, orient3d};

/// Exact sign of the orientation of four points: positive when `d` lies on the side of the plane
/// `a b c` that the normal `(b - a) x (c - a)` points to.
///
/// Shewchuk's adaptive predicate (crate `robust`), with the sign of [`crate::element::measure::tet_volume`].
pub fn orientation(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    let p = |v: DVec3| Coord3D {
        x: v.x,
        y: v.y,
        z: v.z,
    };
    -orient3d(p(a), p(b), p(c), p(d))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orientation_has_the_sign_of_the_volume() {
        let (a, b, c, d) = (DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z);
        assert!(orientation(a, b, c, d) > 0.0);
        assert!(crate::element::measure::tet_volume(a, b, c, d) > 0.0);
    }
}
