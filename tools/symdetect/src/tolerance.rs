//! What counts as equal: of coordinates, of directions, of numbers that should agree.

use glam::DVec3;

/// Error of double precision in the coordinates of the unit ball, after centring, scaling and the product of a motion:
/// each of some dozen operations contributes half an epsilon, sums over the triangles (centre, moments) some hundred;
/// the next power of two that is safe for both.
pub const ARITHMETIC: f64 = 4096.0 * f64::EPSILON;

/// Roundings of input coordinates that add up in one deviation: those of the three coordinates of a point and of the
/// corners that it lands between, and those of the axis and the centre, which come from the same coordinates.
pub const ROUNDINGS: f64 = 8.0;

/// Relative accuracy of what was computed from coordinates in single precision, the coarsest that solids are
/// exchanged in. Choices between equals (which of two axes comes first, which way a direction points) must not depend
/// on smaller differences.
pub const SINGLE: f64 = ROUNDINGS * f32::EPSILON as f64;

/// Half of the binary digits of double precision: a sum that is smaller than this share of its terms is mostly rounding,
/// and so is an eigenvalue that is smaller than this share of the largest one. What is left of it are the digits that
/// coordinates in single precision have. With a larger share, directions in which a nearly round body is hardly
/// curved are taken for flat, and arbitrary points along them for candidate axes.
pub const VANISHING: f64 = 1.0 / (1_u64 << (f64::MANTISSA_DIGITS / 2)) as f64;

/// Compares two directions by their components along three axes in turn, leaving out differences that rounding may
/// have made: positive if the first has the larger component, zero for equals.
pub fn compare_along_axes(a: DVec3, b: DVec3, axes: [DVec3; 3]) -> f64 {
    let differences = axes.map(|e| a.dot(e) - b.dot(e));
    let first = differences.into_iter().find(|d| d.abs() > SINGLE);
    first.unwrap_or(0.0)
}

/// Deviation, in the units of the shape, up to which a body in double precision is exactly symmetric.
pub const EXACT: f64 = ROUNDINGS * ARITHMETIC;
