//! The Jacobian of elements of second order.

use glam::DVec3;

/// Edges of a tetrahedron in the order of its points on edges.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];

/// The least coefficient of the determinant of the Jacobian of a tetrahedron with ten nodes (corners, then points on edges in
/// the order of [`interchange::TetBlock::middles`]) as a Bernstein polynomial of degree 3: nowhere in the element is the
/// determinant less. Of a straight element all are six times the volume. (Johnen, Remacle and Geuzaine, "Geometrical validity
/// of curvilinear finite elements", 2013.)
pub fn least(nodes: &[DVec3; 10]) -> f64 {
    // Control points of the map as a Bernstein polynomial of degree 2.
    let mut control = [[DVec3::ZERO; 4]; 4];
    for (i, row) in control.iter_mut().enumerate() {
        row[i] = nodes[i];
    }
    for (e, &[i, j]) in EDGES.iter().enumerate() {
        let c = 2.0 * nodes[4 + e] - 0.5 * (nodes[i] + nodes[j]);
        (control[i][j], control[j][i]) = (c, c);
    }
    // Derivatives along the edges from corner 0, each of degree 1: a vector for each corner.
    let slope = |k: usize, corner: usize| 2.0 * (control[corner][k] - control[corner][0]);
    let slopes: [[DVec3; 4]; 4] =
        std::array::from_fn(|k| std::array::from_fn(|corner| slope(k, corner)));
    let mut coefficients = [0.0; 64];
    for i in 0..4 {
        for j in 0..4 {
            let cross = slopes[1][i].cross(slopes[2][j]);
            for (k, last) in slopes[3].iter().enumerate() {
                let mut power = [i, j, k];
                power.sort_unstable();
                let [a, b, c] = power;
                // The mean over the products that have this power: of 1, 3 or 6 orders.
                let orders = match (a == b, b == c) {
                    (true, true) => 1.0,
                    (false, false) => 6.0,
                    _ => 3.0,
                };
                coefficients[16 * a + 4 * b + c] += cross.dot(*last) / orders;
            }
        }
    }
    let mut least = f64::INFINITY;
    for a in 0..4 {
        for b in a..4 {
            for c in b..4 {
                least = least.min(coefficients[16 * a + 4 * b + c]);
            }
        }
    }
    least
}
