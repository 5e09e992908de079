//! Measures of single elements and of closed surfaces.

use glam::DVec3;
use tmesh::{OUTSIDE, Template, Triangle};

/// Twice the area of a triangle as a vector along its normal (right-hand rule).
#[inline]
pub fn double_area_vector(a: DVec3, b: DVec3, c: DVec3) -> DVec3 {
    (b - a).cross(c - a)
}

/// Area of a triangle, model units squared.
#[inline]
pub fn triangle_area(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    0.5 * double_area_vector(a, b, c).length()
}

/// Signed volume of a tetrahedron, positive when `(b - a) x (c - a) . (d - a) > 0`.
#[inline]
pub fn tet_volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    double_area_vector(a, b, c).dot(d - a) / 6.0
}

/// Corner positions of a triangle.
#[inline]
pub fn corners(vertices: &[DVec3], t: &Triangle) -> [DVec3; 3] {
    t.vertices.map(|v| vertices[v as usize])
}

/// Volume enclosed by the triangles that bound `region`, by the divergence theorem; model units
/// cubed. Positive for a closed surface whose triangles name the region on the right sides.
pub fn region_volume(template: &Template, region: u32) -> f64 {
    let origin = template.vertices.first().copied().unwrap_or_default();
    let mut volume = 0.0;
    for t in &template.triangles {
        let sign = f64::from(i8::from(t.back == region) - i8::from(t.front == region));
        if sign != 0.0 {
            let [a, b, c] = corners(&template.vertices, t);
            volume += sign * tet_volume(origin, a, b, c);
        }
    }
    volume
}

/// Area of all triangles with [`OUTSIDE`] on exactly one side, model units squared.
pub fn boundary_area(template: &Template) -> f64 {
    template
        .triangles
        .iter()
        .filter(|t| (t.front == OUTSIDE) != (t.back == OUTSIDE))
        .map(|t| {
            let [a, b, c] = corners(&template.vertices, t);
            triangle_area(a, b, c)
        })
        .sum()
}
