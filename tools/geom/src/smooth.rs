//! What counts as smooth.

use std::f64::consts::TAU;

/// Angle between facets up to which they may stand for one smooth surface, radians: 31.3 degrees, half way between
/// prisms of twelve and of eleven sides. A choice: CAD programs turn by up to 0.5 radians, 28.6 degrees, from facet to
/// facet unless told otherwise, and people draw circles of twelve sides, whose 30 degrees rounding must not decide. With a
/// larger angle the edges of prisms count as arcs, and with a smaller one coarse exports as prisms.
pub const SMOOTH: f64 = TAU / 11.5;

/// Its cosine.
pub const SMOOTH_COSINE: f64 = 0.854_419_404_546_488_6;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cosine_is_that_of_the_angle() {
        assert!((libm::cos(SMOOTH) - SMOOTH_COSINE).abs() <= f64::EPSILON);
    }
}
