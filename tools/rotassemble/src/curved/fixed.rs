//! What several isometries leave where it is.

use glam::DVec3;
use tmesh::{FixedSet, Isometry};

/// The nearest point that all of these isometries leave where it is.
pub fn fixed(isometries: &[Isometry], p: DVec3) -> DVec3 {
    let sets = || isometries.iter().map(|g| FixedSet::of(*g));
    let direction = |set: FixedSet| match set {
        FixedSet::Vertical { cos, sin } | FixedSet::Radial { cos, sin } => Some([cos, sin]),
        _ => None,
    };
    let mut directions = sets().filter_map(direction);
    let first = directions.next();
    // Planes and lines at one angle, the level plane and the axis are at right angles or in one another, so that one
    // projection after the other leads to what they share. What is at two angles shares the axis or less.
    let at_axis = directions.any(|d| Some(d) != first);
    let p = sets().fold(p, |p, set| set.nearest(p));
    if at_axis {
        FixedSet::Axis.nearest(p)
    } else {
        p
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrors_at_two_angles_share_the_axis() {
        let p = DVec3::new(0.3, 0.2, 0.7);
        let [a, b] = [0, 1].map(|k| Isometry::reflection(k, 16));
        assert_eq!(fixed(&[], p), p);
        assert_eq!(fixed(&[a], p), DVec3::new(0.3, 0.0, 0.7));
        assert_eq!(fixed(&[a, b], p), DVec3::new(0.0, 0.0, 0.7));
        assert_eq!(fixed(&[a, Isometry::FLIP], p), DVec3::new(0.3, 0.0, 0.0));
        assert_eq!(fixed(&[Isometry::half_turn(0, 3), b], p), DVec3::ZERO);
    }
}
