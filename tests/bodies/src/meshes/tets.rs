//! Single tetrahedra.

use glam::DVec3;

/// Faces of a tetrahedron, outward.
pub const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Whether the corners are in the wrong order.
pub fn is_inverted([a, b, c, d]: [DVec3; 4]) -> bool {
    (b - a).cross(c - a).dot(d - a) < 0.0
}
