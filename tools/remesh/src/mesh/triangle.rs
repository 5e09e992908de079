//! The shape of a triangle.

use geom::measure::double_area_vector;
use glam::DVec3;

/// Area over the sum of the squares of the sides, relative to the equilateral triangle: 1 for that, 0 for no area.
pub fn quality([a, b, c]: [DVec3; 3]) -> f64 {
    let sides = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    if sides > 0.0 {
        2.0 * 3.0_f64.sqrt() * double_area_vector(a, b, c).length() / sides
    } else {
        0.0
    }
}
