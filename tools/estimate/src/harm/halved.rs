//! How much a mirror plane harms the edges of the body that lie in it.
//!
//! A mirror plane through the corner of a square leaves the wedge an angle of 45 degrees there, one
//! through the middle of a side none below 90. Sharp angles of the surface cost elements and quality.

use geom::edges::Edges;
use geom::measure::double_area_vector;
use glam::DVec3;
use std::f64::consts::TAU;
use tmesh::{OUTSIDE, Triangle};

/// Angles of the wedge from here on do no harm, radians: a triangle with equal sides fits in.
const HARMLESS: f64 = std::f64::consts::FRAC_PI_3;

/// Sum, over the edges of the body's boundary in the plane through the axis at `angle` (radians), of the
/// length times how far half of the angle of material there is below [`HARMLESS`], degrees. Positions
/// are in a frame with the axis on z; those within `tolerance` of the plane are in it (model units).
pub fn harm(vertices: &[DVec3], triangles: &[Triangle], angle: f64, tolerance: f64) -> f64 {
    let normal = DVec3::new(-libm::sin(angle), libm::cos(angle), 0.0);
    let inside: Vec<bool> = vertices
        .iter()
        .map(|p| p.dot(normal).abs() <= tolerance)
        .collect();
    let near: Vec<&Triangle> = triangles
        .iter()
        .filter(|t| (t.front == OUTSIDE) != (t.back == OUTSIDE))
        .filter(|t| t.vertices.iter().filter(|&&v| inside[v as usize]).count() == 2)
        .collect();
    let corners: Vec<[u32; 3]> = near.iter().map(|t| t.vertices).collect();
    let edges = Edges::new(&corners);
    let mut sum = 0.0;
    for (e, ends) in edges.ends.iter().enumerate() {
        let ([s, t], true) = (edges.around(e), ends.iter().all(|&v| inside[v as usize])) else {
            continue;
        };
        let [a, b] = ends.map(|v| vertices[v as usize]);
        let along = b - a;
        // Directions from the edge into the two faces.
        let [(into, outward), (other, _)] = [s, t].map(|u| {
            let triangle = near[u.triangle as usize];
            let [p, q, r] = triangle.vertices.map(|v| vertices[v as usize]);
            let normal = double_area_vector(p, q, r);
            let sign = if triangle.front == OUTSIDE { 1.0 } else { -1.0 };
            let apex = triangle.vertices.iter().find(|v| !ends.contains(v));
            let apex = apex.map_or(a, |&v| vertices[v as usize]) - a;
            let away = apex - along * (apex.dot(along) / along.length_squared());
            (away, normal * sign)
        });
        let between = into.angle_between(other);
        let convex = outward.dot(other) < 0.0;
        let material = if convex { between } else { TAU - between };
        sum += along.length() * (HARMLESS - 0.5 * material).max(0.0).to_degrees();
    }
    sum
}

/// How many triangles the plane through the axis at `angle` (radians) cuts in two; the other arguments as
/// for [`harm`].
pub fn crossed(vertices: &[DVec3], triangles: &[Triangle], angle: f64, tolerance: f64) -> usize {
    let normal = DVec3::new(-libm::sin(angle), libm::cos(angle), 0.0);
    let heights: Vec<f64> = vertices.iter().map(|p| p.dot(normal)).collect();
    let is_cut = |t: &&Triangle| {
        let height = t.vertices.map(|v| heights[v as usize]);
        height.iter().any(|h| *h < -tolerance) && height.iter().any(|h| *h > tolerance)
    };
    triangles.iter().filter(is_cut).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sides of an upright prism over a polygon, two triangles each.
    fn sides(polygon: &[[f64; 2]]) -> (Vec<DVec3>, Vec<Triangle>) {
        let n = polygon.len() as u32;
        let level = |z| polygon.iter().map(move |p| DVec3::new(p[0], p[1], z));
        let vertices = level(0.0).chain(level(2.0)).collect();
        let triangle = |vertices| Triangle {
            vertices,
            marker: 1,
            front: OUTSIDE,
            back: 1,
        };
        let triangles = (0..n).flat_map(|i| {
            let j = (i + 1) % n;
            [triangle([i, j, j + n]), triangle([i, j + n, i + n])]
        });
        (vertices, triangles.collect())
    }

    #[test]
    fn corners_that_a_plane_halves_count() {
        let (vertices, triangles) = sides(&[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]);
        // Two upright edges, 2 long, with 45 degrees left.
        let through = harm(&vertices, &triangles, 0.0, 1e-9);
        assert!((through - 2.0 * 2.0 * 15.0).abs() < 1e-9, "{through}");
        let between = std::f64::consts::FRAC_PI_4;
        assert_eq!(harm(&vertices, &triangles, between, 1e-9), 0.0);
        // All four triangles of two opposite sides.
        assert_eq!(crossed(&vertices, &triangles, between, 1e-9), 4);
        assert_eq!(crossed(&vertices, &triangles, 0.0, 1e-9), 0);
        // The same from inside: a square hole has 270 degrees of material at its corners.
        let swapped: Vec<Triangle> = triangles
            .iter()
            .map(|t| Triangle {
                front: t.back,
                back: t.front,
                ..*t
            })
            .collect();
        assert_eq!(harm(&vertices, &swapped, 0.0, 1e-9), 0.0);
        // An octagon's corners leave 67.5 degrees.
        let at = |i: i32| {
            let (sin, cos) = (f64::from(i) * between).sin_cos();
            [cos, sin]
        };
        let octagon: Vec<_> = (0..8).map(at).collect();
        let (vertices, triangles) = sides(&octagon);
        assert_eq!(harm(&vertices, &triangles, 0.0, 1e-9), 0.0);
    }
}
