//! Which of many equivalent frames is reported.

use crate::group::{Flip, Group};
use crate::shape::Shape;
use glam::DVec3;
use tmesh::{Frame, Isometry};

/// Angle, in radians, within which a direction may be a coordinate axis.
const ANGLE: f64 = 1e-4;

/// Whether the largest component is positive (z before x before y among equals).
pub fn points_forward(d: DVec3) -> bool {
    let mut best = d.z;
    for c in [d.x, d.y] {
        if c.abs() > best.abs() + 1e-9 {
            best = c;
        }
    }
    best > 0.0
}

/// The direction or its opposite, whichever points forward.
pub fn forward(d: DVec3) -> DVec3 {
    if points_forward(d) { d } else { -d }
}

/// The reference direction of a frame: among the directions in mirror planes (or on half-turn axes)
/// the nearest to world x, then y, then z; without any, x (or y) made orthogonal to the axis.
pub fn reference(frame: &Frame, group: &Group) -> DVec3 {
    let z = frame.rotation.z_axis;
    if !(group.mirror || group.flip == Flip::HalfTurn) {
        let hint = if z.x.abs() < 0.9 { DVec3::X } else { DVec3::Y };
        return (hint - z * hint.dot(z)).normalize_or(z.any_orthonormal_vector());
    }
    let n = group.order;
    let mut best = frame.rotation.x_axis;
    for k in 1..2 * n {
        let d = frame.rotation * Isometry::rotation(i64::from(k), 2 * n).apply(DVec3::X);
        let better = [DVec3::X, DVec3::Y, DVec3::Z]
            .iter()
            .map(|e| d.dot(*e) - best.dot(*e))
            .find(|g| g.abs() > 1e-7)
            .is_some_and(|g| g > 0.0);
        if better {
            best = d;
        }
    }
    nearest_coordinate_axis(best, 1e-12).unwrap_or(best)
}

/// The coordinate axis, either way, within `angle` of a direction.
fn nearest_coordinate_axis(d: DVec3, angle: f64) -> Option<DVec3> {
    [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .flat_map(|e| [e, -e])
        .find(|e| (d - *e).length() < angle)
}

/// The frame with directions turned into coordinate axes that they nearly are, and an origin with
/// round world coordinates, in case the body was drawn that way.
pub fn rounded(shape: &Shape, frame: &Frame) -> Frame {
    let z = frame.rotation.z_axis;
    let z = nearest_coordinate_axis(z, ANGLE).unwrap_or(z);
    let x = frame.rotation.x_axis;
    let x = nearest_coordinate_axis(x, ANGLE).unwrap_or(x);
    let origin = shape
        .to_world(frame.origin)
        .to_array()
        .map(|c| round_at(c, shape.scale * 1e-6));
    Frame::from_axis(shape.of_world(DVec3::from_array(origin)), z, x).unwrap_or(*frame)
}

/// The decimal number nearest to `x` on a grid of a power of ten near `step`.
fn round_at(x: f64, step: f64) -> f64 {
    let digits = -step.log10().floor();
    if x.abs() <= step || !(0.0..=300.0).contains(&digits.abs()) {
        return 0.0;
    }
    if digits < 0.0 {
        let unit = libm::pow(10.0, -digits);
        return (x / unit).round() * unit;
    }
    format!("{x:.*}", digits as usize).parse().unwrap_or(x)
}
