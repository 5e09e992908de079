//! How much a cut through the axis harms a body whose faces it slices.
//!
//! Where a cut plane meets a face at a small angle, both sides get a sharp edge, and where it cuts a corner
//! off a face, a short one. Elements there are as small as that, in every copy of the wedge. Nothing of
//! the kind happens at a plane that passes between the blades of a wheel.

use crate::model::CostModel;
use geom::measure::double_area_vector;
use glam::DVec3;
use tmesh::{OUTSIDE, Triangle};

/// What a unit of [`crate::needles`], one element of the estimate, is in units of harm.
const NEEDLE: f64 = 1.0 / CostModel::CALIBRATED.sliced;

/// How much a cut harms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Harm {
    /// By what it slices: a unit costs [`CostModel::sliced`] elements of the estimate in each copy.
    pub sliced: f64,
    /// By what it passes closely, in the same unit, less certain; good enough to choose among places.
    pub near: f64,
    /// The same by what does not stay, between features of a surface that is remeshed: that may be made anew.
    pub crumbs: f64,
}

impl Harm {
    /// All together.
    pub fn total(self) -> f64 {
        self.kept() + self.crumbs
    }

    /// Without what may be made anew.
    pub fn kept(self) -> f64 {
        self.sliced + self.near
    }
}

/// The harm of the half plane at `angle` (radians) that begins at the axis, which is z, with the size of elements and whether
/// vertices stay; see [`harm_of`].
pub fn harm(
    vertices: &[DVec3],
    triangles: &[Triangle],
    angle: f64,
    tolerance: f64,
    (size, stays): (impl Fn(&Triangle) -> f64, impl Fn(u32) -> bool),
) -> Harm {
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let normal = DVec3::new(-sin, cos, 0.0);
    let outward = DVec3::new(cos, sin, 0.0);
    let cut = Surface {
        heights: vertices.iter().map(|p| p.dot(normal)).collect(),
        normal: |p: DVec3| (p.dot(outward) > 0.0).then_some(normal),
        tolerance,
        stays,
    };
    harm_of(vertices, triangles, cut, size)
}

/// A surface that cuts a body.
pub struct Surface<N, S> {
    /// How far each vertex is from it, model units, of either sign.
    pub heights: Vec<f64>,
    /// Its unit normal near a point; `None` where it does not reach.
    pub normal: N,
    /// Points within this are in it, and what is shorter will be collapsed, model units.
    pub tolerance: f64,
    /// Whether a vertex stays where it is; triangles at others may be made anew.
    pub stays: S,
}

/// The harm of a surface. Sliced: the sum, over
/// the segments in which it meets the triangles, of how far the inverse sine of the angle between them is
/// above one, times the segment's length in elements, and of the logarithm of how much shorter than
/// element and triangle the segment is. Near, or crumbs where a vertex does not stay: the same for corners and sides of
/// triangles beside the surface.
/// `size` is that of elements beside a triangle, model units.
pub fn harm_of(
    vertices: &[DVec3],
    triangles: &[Triangle],
    cut: Surface<impl Fn(DVec3) -> Option<DVec3>, impl Fn(u32) -> bool>,
    size: impl Fn(&Triangle) -> f64,
) -> Harm {
    let tolerance = cut.tolerance;
    let snapped = |height: f64| {
        if height.abs() <= tolerance {
            0.0
        } else {
            height
        }
    };
    let heights: Vec<f64> = cut.heights.into_iter().map(snapped).collect();
    let mut harm = Harm::default();
    for triangle in triangles {
        let height = triangle.vertices.map(|v| heights[v as usize]);
        let corners = triangle.vertices.map(|v| vertices[v as usize]);
        // Points of the plane on the three sides; a corner in the plane ends no segment by itself.
        let crossing = |i: usize| {
            let j = (i + 1) % 3;
            let (a, b) = (height[i], height[j]);
            (a.min(b) < 0.0 && a.max(b) >= 0.0)
                .then(|| corners[i] + (corners[j] - corners[i]) * (a / (a - b)))
        };
        let beside = beside(height);
        let mut points = (0..3).filter_map(crossing);
        let ends = match beside {
            Some((i, _)) => Some((corners[(i + 1) % 3], corners[(i + 2) % 3])),
            None => points.next().zip(points.next()),
        };
        let Some((p, q)) = ends else { continue };
        let Some(normal) = (cut.normal)(p.midpoint(q)) else {
            continue;
        };
        let size = size(triangle);
        let length = p.distance(q);
        if length <= tolerance {
            continue;
        }
        let face = double_area_vector(corners[0], corners[1], corners[2]).normalize_or(normal);
        // Faces in the plane have no corner off it. What is left of zero is rounding.
        let sine = face.cross(normal).length().max(f64::EPSILON);
        let side = (0..3)
            .map(|i| corners[i].distance(corners[(i + 1) % 3]))
            .fold(size, f64::min);
        let shorter = |than: f64| libm::log((side / than).max(1.0));
        let sharp = match beside {
            Some((i, above)) => {
                let into = (corners[i] - p).reject_from(q - p);
                sharp_beside(triangle, face, [into, normal * above.signum()])
            }
            None => 1.0,
        };
        harm.sliced += sharp * (length / size).max(1.0) * (1.0 / sine - 1.0) + shorter(length);
        // One corner is alone on its side of the plane.
        let alone = (0..3).find(|&i| {
            let is_below = |k: usize| height[k] < 0.0;
            is_below(i) != is_below((i + 1) % 3) && is_below(i) != is_below((i + 2) % 3)
        });
        let Some(i) = alone else { continue };
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let mut add = |vertices: &[usize], near: f64| {
            let mut stay = vertices.iter().map(|&i| (cut.stays)(triangle.vertices[i]));
            match stay.all(|stays| stays) {
                true => harm.near += near,
                false => harm.crumbs += near,
            }
        };
        add(&[i], shorter(height[i].abs()));
        // A side in the plane leaves no strip.
        let strip = height[j].abs().max(height[k].abs());
        if strip > 0.0 && strip < size {
            let needles = corners[j].distance(corners[k]) / strip - 1.0;
            add(&[j, k], NEEDLE * needles.max(0.0));
        }
    }
    harm
}

/// The corner that is off the surface alone, and how far, where the other two are in it.
fn beside(height: [f64; 3]) -> Option<(usize, f64)> {
    let off = (0..3).find(|&i| height[i] != 0.0)?;
    let others = [height[(off + 1) % 3], height[(off + 2) % 3]];
    (others == [0.0; 2]).then_some((off, height[off]))
}

/// The part of the materials beside a triangle to which the cut gives a sharp edge where a side of the triangle lies in it. Where it slices a flat face
/// along sides of triangles, that is all of one of both triangles at each for a boundary, and half of either for an interface.
/// `face`: the triangle's normal; `into`: where it runs from that side, across it; `off`: the normal of the cut towards it.
fn sharp_beside(triangle: &Triangle, face: DVec3, [into, off]: [DVec3; 2]) -> f64 {
    // Along the cut, in the direction of the triangle: what is between both is sharp.
    let along = into.reject_from_normalized(off);
    let sides = [(triangle.front, 1.0), (triangle.back, -1.0)];
    let there = sides.iter().filter(|(region, _)| *region != OUTSIDE);
    let sharp = there.clone().filter(|(_, s)| s * face.dot(along) > 0.0);
    sharp.count() as f64 / there.count().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle across the plane y = 0, which it meets at an angle (degrees) in a segment 1 long, moved
    /// along y.
    fn triangle(degrees: f64, shift: f64) -> impl Fn(f64) -> f64 {
        let (s, c) = degrees.to_radians().sin_cos();
        let vertices = [
            DVec3::new(2.0, -s, -c),
            DVec3::new(4.0, -s, -c),
            DVec3::new(3.0, s, c),
        ]
        .map(|p| p + DVec3::Y * shift);
        let triangle = Triangle {
            vertices: [0, 1, 2],
            marker: 1,
            front: tmesh::OUTSIDE,
            back: 1,
        };
        move |angle| harm(&vertices, &[triangle], angle, 1e-9, (|_| 0.4, |_| true)).total()
    }

    /// A wall that leaves the plane y = 0 along z at an angle to the way outward (degrees), of a body on one side of it or on both.
    fn wall(degrees: f64, [front, back]: [u32; 2]) -> f64 {
        let (s, c) = degrees.to_radians().sin_cos();
        let vertices = [
            DVec3::new(3.0, 0.0, 0.0),
            DVec3::new(3.0 + c, s, 0.5),
            DVec3::new(3.0, 0.0, 1.0),
        ];
        let triangle = Triangle {
            vertices: [0, 1, 2],
            marker: 1,
            front,
            back,
        };
        let whole = harm(&vertices, &[triangle], 0.0, 1e-9, (|_| 0.4, |_| true));
        // What is near is another matter.
        whole.sliced
    }

    #[test]
    fn sharp_angles_beside_a_plane_through_an_edge_count_on_either_side_of_it() {
        for degrees in [30.0, 150.0, -30.0, -150.0] {
            let [front, back, both, none] = [[1, OUTSIDE], [OUTSIDE, 1], [1, 2], [OUTSIDE; 2]]
                .map(|sides| wall(degrees, sides));
            // Two and a half elements long; of a body, what is between the wall and the plane is sharp, and what is beyond the wall is not.
            let sharp_in_front = degrees.to_radians().sin() * degrees.to_radians().cos() > 0.0;
            let expected = if sharp_in_front {
                [2.5, 0.0]
            } else {
                [0.0, 2.5]
            };
            for (found, expected) in
                [front, back, both, none]
                    .into_iter()
                    .zip([expected[0], expected[1], 1.25, 0.0])
            {
                assert!(
                    (found - expected).abs() < 1e-9,
                    "{degrees}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn sharp_angles_and_what_is_near_the_plane_count() {
        assert!(triangle(90.0, 0.0)(0.0).abs() < 1e-12);
        // Two and a half elements long.
        assert!((triangle(30.0, 0.0)(0.0) - 2.5).abs() < 1e-9);
        // The tip is a hundredth beyond the plane, then the base.
        let tip = triangle(90.0, -0.99)(0.0);
        assert!((tip - 2.0 * 40_f64.ln()).abs() < 1e-9, "{tip}");
        let base = triangle(90.0, 0.99)(0.0);
        assert!((base - NEEDLE * 199.0).abs() < 1e-9, "{base}");
        // In the plane, with all that rounding makes of it, it is no strip.
        let side = triangle(90.0, 1.0 - 1e-12)(0.0);
        assert!(side.abs() < 1e-9, "{side}");
        // The half plane ends at the axis, and elsewhere there is nothing.
        assert_eq!(triangle(30.0, 0.0)(std::f64::consts::PI), 0.0);
        assert_eq!(triangle(30.0, 0.0)(1.5), 0.0);
    }
}
