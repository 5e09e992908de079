//! Quality measures of a tetrahedron.

use crate::element::measure::tet_volume;
use crate::rounding::power_of_two;
use glam::DVec3;

/// Radius-edge ratio of the regular tetrahedron, the smallest there is.
pub const REGULAR_RADIUS_EDGE: f64 = 0.612_372_435_695_794_5;

/// Corners of the edges, in the order of [`TetMeasures::edges`].
pub const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Corners of the faces, face `i` opposite to corner `i`, counter-clockwise seen from outside of a
/// positively oriented tetrahedron.
pub const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Measures of one tetrahedron. All but `volume` are the same for both orientations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetMeasures {
    /// Signed volume, model units cubed.
    pub volume: f64,
    /// Edge lengths in the order of [`EDGES`], model units.
    pub edges: [f64; 6],
    /// Radius of the circumscribed sphere over the shortest edge; sqrt(6)/4 when regular, infinite
    /// when flat.
    pub radius_edge_ratio: f64,
    /// The least and the greatest cotangent of an angle between two faces, both times `sine`.
    cosines: [f64; 2],
    /// What the cotangents are over: six times the volume of the tetrahedron in a unit of its size.
    sine: f64,
    /// Longest edge over 2 sqrt(6) times the radius of the inscribed sphere; 1 when regular,
    /// infinite when flat.
    pub aspect_ratio: f64,
}

impl TetMeasures {
    /// Measures a tetrahedron given by its corners.
    ///
    /// Angles come from their cotangents: with outward double-area vectors `N_k`, `N_l` of the faces
    /// that meet at an edge of length `L`, `|N_k x N_l| = 6 V L`, so `cot = -N_k . N_l / (6 V L)`,
    /// which stays accurate near 0 and 180 degrees where an arc cosine does not.
    pub fn of(corners: [DVec3; 4]) -> Self {
        let [a, b, c, d] = corners;
        let volume = tet_volume(a, b, c, d);
        let edges = EDGES.map(|[i, j]| (corners[j] - corners[i]).length());
        let longest = edges.iter().fold(0.0_f64, |m, &e| m.max(e));
        let shortest = edges.iter().fold(f64::INFINITY, |m, &e| m.min(e));
        // Fourth powers of lengths must neither overflow nor vanish.
        let unit = power_of_two(longest);
        let (u, v, w) = ((b - a) / unit, (c - a) / unit, (d - a) / unit);
        let (uv, vw, wu) = (u.cross(v), v.cross(w), w.cross(u));
        let six_volume = uv.dot(w).abs();

        let centre = u.length_squared() * vw + v.length_squared() * wu + w.length_squared() * uv;
        let circumradius = centre.length() / (2.0 * six_volume) * unit;

        // Outward normals of the faces opposite to a, b, c, d, twice the area long.
        let normals = [(v - u).cross(w - u), -vw, -wu, -uv];
        // Edge i of EDGES lies in the faces opposite to the corners of edge 5 - i.
        let mut low = f64::INFINITY;
        let mut high = f64::NEG_INFINITY;
        for (i, length) in edges.iter().enumerate() {
            let [k, l] = EDGES[5 - i];
            let cotangent = -normals[k].dot(normals[l]) / (length / unit);
            low = low.min(cotangent);
            high = high.max(cotangent);
        }
        let surface: f64 = normals.iter().map(|n| n.length()).sum();
        let inradius = six_volume / surface * unit;
        Self {
            volume,
            edges,
            radius_edge_ratio: or_infinite(circumradius / shortest),
            cosines: [low, high],
            sine: six_volume,
            aspect_ratio: or_infinite(longest / (2.0 * 6.0_f64.sqrt() * inradius)),
        }
    }

    /// Smallest angle between two faces, radians; acos(1/3) when regular, 0 when flat.
    pub fn min_dihedral(&self) -> f64 {
        libm::atan2(self.sine, self.cosines[1])
    }

    /// Largest angle between two faces, radians; pi when flat (unless it is a needle).
    pub fn max_dihedral(&self) -> f64 {
        libm::atan2(self.sine, self.cosines[0])
    }

    /// Whether an angle between two faces is below the one of this cotangent, without computing the angle.
    pub fn has_dihedral_below(&self, cotangent: f64) -> bool {
        self.cosines[1] > cotangent * self.sine
    }
}

/// 0/0 arises only from corners that coincide or lie on a line: as bad as can be.
fn or_infinite(x: f64) -> f64 {
    if x.is_nan() { f64::INFINITY } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(x: f64, y: f64) {
        assert!((x - y).abs() <= 4e-15 * y.abs().max(1.0), "{x} is not {y}");
    }

    fn regular(size: f64) -> [DVec3; 4] {
        [
            DVec3::new(1.0, 1.0, 1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
        ]
        .map(|p| p * size)
    }

    #[test]
    fn the_regular_tetrahedron() {
        for size in [1.0, 1e-6, 1e6, 1e-100, 1e90] {
            let m = TetMeasures::of(regular(size));
            let edge = 8.0_f64.sqrt();
            close(
                m.volume / size / size / size,
                edge.powi(3) / 72.0_f64.sqrt(),
            );
            close(m.edges[3] / size, edge);
            close(m.radius_edge_ratio, 6.0_f64.sqrt() / 4.0);
            close(m.min_dihedral(), (1.0_f64 / 3.0).acos());
            close(m.max_dihedral(), (1.0_f64 / 3.0).acos());
            close(m.aspect_ratio, 1.0);
        }
    }

    #[test]
    fn the_corner_of_a_cube() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let m = TetMeasures::of(corners);
        close(m.volume, 1.0 / 6.0);
        close(m.radius_edge_ratio, 0.75_f64.sqrt());
        close(m.min_dihedral(), (1.0 / 3.0_f64.sqrt()).acos());
        close(m.max_dihedral(), std::f64::consts::FRAC_PI_2);
        // Inradius 1 / (3 + sqrt 3).
        close(
            m.aspect_ratio,
            2.0_f64.sqrt() * (3.0 + 3.0_f64.sqrt()) / 24.0_f64.sqrt(),
        );
        let [a, b, c, d] = corners;
        let turned = TetMeasures::of([b, a, c, d]);
        close(turned.volume, -1.0 / 6.0);
        close(turned.min_dihedral(), m.min_dihedral());
        close(turned.radius_edge_ratio, m.radius_edge_ratio);
    }

    #[test]
    fn slivers_keep_their_small_angles() {
        // Two crossing diagonals of a square at heights 0 and h: dihedral angles at the diagonals'
        // ends follow from the cotangent.
        let h = 1e-9;
        let m = TetMeasures::of([
            DVec3::new(1.0, 0.0, 0.0),
            DVec3::new(-1.0, 0.0, 0.0),
            DVec3::new(0.0, -1.0, h),
            DVec3::new(0.0, 1.0, h),
        ]);
        assert!(m.volume > 0.0);
        close(m.max_dihedral(), std::f64::consts::PI - 2.0 * h);
        // Both faces at a side of the square rise by about h over a distance 1/sqrt 2.
        let expected = 2.0_f64.sqrt() * h;
        assert!((m.min_dihedral() / expected - 1.0).abs() < 1e-9);
    }

    #[test]
    fn flat_and_collapsed_ones_are_infinitely_bad() {
        let flat = TetMeasures::of([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y]);
        assert_eq!(flat.volume, 0.0);
        assert_eq!(flat.min_dihedral(), 0.0);
        close(flat.max_dihedral(), std::f64::consts::PI);
        assert!(flat.radius_edge_ratio.is_infinite() && flat.aspect_ratio.is_infinite());
        let point = TetMeasures::of([DVec3::ONE; 4]);
        assert!(point.radius_edge_ratio.is_infinite() && point.aspect_ratio.is_infinite());
        assert!(!point.min_dihedral().is_nan() && !point.max_dihedral().is_nan());
    }

    #[test]
    fn faces_point_outwards() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        for (opposite, face) in FACES.iter().enumerate() {
            let [a, b, c] = face.map(|i| corners[i]);
            assert!((b - a).cross(c - a).dot(corners[opposite] - a) < 0.0);
        }
    }
}
