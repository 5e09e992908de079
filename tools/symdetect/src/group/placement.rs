//! Which of many equivalent frames is reported.

use crate::shape::Shape;
use crate::tolerance::{ARITHMETIC, SINGLE, compare_along_axes};
use glam::DVec3;
use tmesh::{Frame, Group, Isometry};

/// The direction or its opposite, whichever has the largest component positive (z before x before y among equals).
pub fn forward(d: DVec3) -> DVec3 {
    if points_forward(d) { d } else { -d }
}

/// Whether the largest component is positive (z before x before y among equals).
pub fn points_forward(d: DVec3) -> bool {
    let mut best = d.z;
    for c in [d.x, d.y] {
        if c.abs() > best.abs() + SINGLE {
            best = c;
        }
    }
    best > 0.0
}

/// The reference direction of a frame: among the directions in mirror planes (or on half-turn axes)
/// the nearest to world x, then y, then z; without any, x (or y) made orthogonal to the axis.
pub fn reference(frame: &Frame, group: Group) -> DVec3 {
    let z = frame.rotation.z_axis;
    if !group.has_vertical_mirrors() && !group.has_half_turns() {
        // Not the one that the axis is nearer to than to a plane across it.
        let hint = if z.x * z.x < 0.5 { DVec3::X } else { DVec3::Y };
        return (hint - z * hint.dot(z)).normalize_or(z.any_orthonormal_vector());
    }
    let n = group.order;
    let mut best = frame.rotation.x_axis;
    for k in 1..2 * n {
        let d = frame.rotation * Isometry::rotation(i64::from(k), 2 * n).apply(DVec3::X);
        if compare_along_axes(d, best, [DVec3::X, DVec3::Y, DVec3::Z]) > 0.0 {
            best = d;
        }
    }
    nearest_coordinate_axis(best, ARITHMETIC).unwrap_or(best)
}

/// The coordinate axis, either way, within `angle` of a direction.
fn nearest_coordinate_axis(d: DVec3, angle: f64) -> Option<DVec3> {
    [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .flat_map(|e| [e, -e])
        .find(|e| (d - *e).length() < angle)
}

/// The frame with directions turned into coordinate axes that they are within `angle` of, and an origin with
/// round world coordinates, in case the body was drawn that way: rounded to what single precision tells of a body of
/// that size, some six digits, as most programs write at least.
pub fn rounded(shape: &Shape, frame: &Frame, angle: f64) -> Frame {
    let z = frame.rotation.z_axis;
    let z = nearest_coordinate_axis(z, angle).unwrap_or(z);
    let x = frame.rotation.x_axis;
    let x = nearest_coordinate_axis(x, angle).unwrap_or(x);
    let origin = shape
        .to_world(frame.origin)
        .to_array()
        .map(|c| round_at(c, shape.scale * SINGLE));
    Frame::from_axis(shape.of_world(DVec3::from_array(origin)), z, x).unwrap_or(*frame)
}

/// The decimal number nearest to `x` on a grid of the power of ten at or below `step`, but for digits that double
/// precision does not have.
fn round_at(x: f64, step: f64) -> f64 {
    if x.abs() <= step {
        return 0.0;
    }
    let place = |x: f64| libm::floor(libm::log10(x.abs()));
    let digits = (place(x) - place(step)).min(f64::from(f64::DIGITS));
    format!("{x:.*e}", digits as usize).parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_rounded_to_decimals_at_any_scale() {
        assert_eq!(round_at(12.300_000_4, 3e-6), 12.3);
        assert_eq!(round_at(-12.300_004, 3e-6), -12.300_004);
        assert_eq!(round_at(1e-6, 3e-6), 0.0);
        assert_eq!(round_at(123_456.0, 250.0), 123_500.0);
        assert_eq!(round_at(1.25e300, 3e290), 1.25e300);
        assert_eq!(round_at(3.000_000_1e-310, 1e-315), 3.0e-310);
    }
}
