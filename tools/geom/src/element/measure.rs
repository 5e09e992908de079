//! Measures of single elements and of closed surfaces.

use glam::DVec3;

/// The area of several triangles, as a number and as a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Areas {
    /// Sum of their vector areas, on which their border alone decides.
    pub vector: DVec3,
    /// Sum of their areas: the length of that vector, if they are in one plane and none is folded over others.
    pub area: f64,
    /// Length of their edges, inner ones twice.
    pub edges: f64,
}

impl Areas {
    /// Adds a triangle.
    pub fn add(&mut self, [a, b, c]: [DVec3; 3]) {
        let vector = double_area_vector(a, b, c) * 0.5;
        self.vector += vector;
        self.area += vector.length();
        self.edges += a.distance(b) + b.distance(c) + c.distance(a);
    }

    /// Whether they are in one plane, none folded over others, but for what comes of edges that are off by `distance`.
    pub fn is_flat(&self, distance: f64) -> bool {
        self.area - self.vector.length() <= self.edges * distance
    }
}

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

/// Distance of a point from the segment between two others.
#[inline]
pub fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let at = (p - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    (p - a - along * at.clamp(0.0, 1.0)).length()
}

/// Corner positions of a triangle or a tetrahedron.
#[inline]
pub fn corners<const N: usize>(vertices: &[DVec3], ids: impl Into<[u32; N]>) -> [DVec3; N] {
    ids.into().map(|v| vertices[v as usize])
}

/// Volume enclosed by the triangles that bound `region`, by the divergence theorem; model units
/// cubed. `faces`: vertex ids of each triangle, and the regions on its front and on its back side.
/// Positive for a closed surface whose triangles name the region on the right sides.
pub fn volume_of_region(
    vertices: &[DVec3],
    faces: impl Iterator<Item = ([u32; 3], [u32; 2])>,
    region: u32,
) -> f64 {
    let origin = vertices.first().copied().unwrap_or_default();
    let mut volume = 0.0;
    for (ids, [front, back]) in faces {
        let sign = f64::from(i8::from(back == region) - i8::from(front == region));
        if sign != 0.0 {
            let [a, b, c] = corners(vertices, ids);
            volume += sign * tet_volume(origin, a, b, c);
        }
    }
    volume
}

/// Area of all triangles that have `region` on exactly one side, model units squared; `faces` as in
/// [`volume_of_region`].
pub fn area_of_region(
    vertices: &[DVec3],
    faces: impl Iterator<Item = ([u32; 3], [u32; 2])>,
    region: u32,
) -> f64 {
    faces
        .filter(|(_, [front, back])| (*front == region) != (*back == region))
        .map(|(ids, _)| {
            let [a, b, c] = corners(vertices, ids);
            triangle_area(a, b, c)
        })
        .sum()
}
