//! Where triangles meet in any other way than in common vertices and edges.

use crate::element::measure::double_area_vector;
use crate::element::predicate::orientation;
use crate::rounding;
pub use crate::tree::Search;
use crate::tree::alignment::alignment;
use crate::tree::pairs;
use glam::DVec3;
use robust::{Coord, orient2d};

/// Two triangles that cross, overlap or touch away from their common vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Triangle indices, lower one first.
    pub triangles: [u32; 2],
    /// A point of the contact; rounded.
    pub point: DVec3,
}

/// Finds contacts between triangles of different groups, and hands them to `found` until it returns
/// false. Two triangles with the same three vertices are no contact; neither is one without area.
///
/// Tests are exact. O(n log n) where few boxes overlap; the number of pairs looked at is bounded by
/// a multiple of the number of triangles.
pub fn contacts(
    vertices: &[DVec3],
    triangles: &[[u32; 3]],
    group: impl Fn(u32) -> u32,
    mut found: impl FnMut(Contact) -> bool,
) -> Search {
    let corners = |t: usize| triangles[t].map(|v| vertices[v as usize]);
    // Boxes only sort out pairs: they may be those of another frame, if a little larger.
    let frame = alignment(triangles.len(), corners);
    let used = triangles.iter().flatten().map(|&v| vertices[v as usize]);
    let extent = used.fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
    // A turned coordinate is a sum of three products, of up to `sqrt(3)` times the largest coordinate together; then the
    // margin is added.
    let margin = frame.map_or(0.0, |_| rounding::double(4) * 3.0_f64.sqrt() * extent);
    let boxes = (0..triangles.len()).map(|t| {
        let [a, b, c] = corners(t).map(|p| frame.map_or(p, |frame| frame * p));
        [a.min(b).min(c) - margin, a.max(b).max(c) + margin]
    });
    pairs(boxes, &group, |s, t| {
        let (s, t) = (s.min(t), s.max(t));
        match contact(vertices, &triangles[s as usize], &triangles[t as usize]) {
            Some(point) => found(Contact {
                triangles: [s, t],
                point,
            }),
            None => true,
        }
    })
}

/// A point in which two triangles meet away from their common vertices and edge, if there is one.
pub fn contact(vertices: &[DVec3], s: &[u32; 3], t: &[u32; 3]) -> Option<DVec3> {
    let at = |v: u32| vertices[v as usize];
    let (p, q) = (s.map(at), t.map(at));
    let mut shared = [(0, 0); 3];
    let mut count = 0;
    for (i, v) in s.iter().enumerate() {
        if let Some(j) = t.iter().position(|w| w == v) {
            shared[count] = (i, j);
            count += 1;
        }
    }
    let shared = &shared[..count];
    if count == 3 || clearly_apart(p, q, shared) || apart_in_projection(p, q, shared) {
        return None;
    }
    let separated = match *shared {
        [] => separated(p, q),
        [(i, j)] => separated_at(p[i], others(p, i), others(q, j)),
        _ => false,
    };
    if separated {
        return None;
    }
    meeting(p, q, shared)
}

/// The corners other than one.
fn others(v: [DVec3; 3], i: usize) -> [DVec3; 2] {
    [v[(i + 1) % 3], v[(i + 2) % 3]]
}

/// What [`contact`] finds, exactly and without short cuts.
fn meeting(p: [DVec3; 3], q: [DVec3; 3], shared: &[(usize, usize)]) -> Option<DVec3> {
    let one_side = |[a, b, c]: [DVec3; 3], v: &[DVec3]| {
        let mut signs = v.iter().map(|&x| orientation(a, b, c, x));
        let first = signs.next().unwrap_or(0.0);
        first != 0.0 && signs.all(|x| x * first.signum() > 0.0)
    };
    match *shared {
        [] => {
            if one_side(q, &p) || one_side(p, &q) || is_flat(p) || is_flat(q) {
                return None;
            }
            (0..3)
                .find_map(|i| segment_meets(p[i], p[(i + 1) % 3], q))
                .or_else(|| (0..3).find_map(|i| segment_meets(q[i], q[(i + 1) % 3], p)))
        }
        [(i, j)] => {
            let (pi, qj) = (others(p, i), others(q, j));
            if one_side(q, &pi) || one_side(p, &qj) || is_flat(p) || is_flat(q) {
                return None;
            }
            segment_meets(pi[0], pi[1], q).or_else(|| segment_meets(qj[0], qj[1], p))
        }
        [(i, j), (k, l)] => {
            let (apex, other) = (p[3 - i - k], q[3 - j - l]);
            let (a, b) = (p[i], p[k]);
            if orientation(a, b, apex, other) != 0.0 || is_flat(p) || is_flat(q) {
                return None;
            }
            let plane = Plane2::of(p)?;
            let side = |x| plane.turn(a, b, x) > 0.0;
            (side(apex) == side(other)).then(|| (a + b + apex) / 3.0)
        }
        _ => None,
    }
}

/// The determinant of two vectors with a third, which is rounded.
struct Determinant {
    normal: DVec3,
    /// Sizes of the terms of `normal`.
    size: DVec3,
}

impl Determinant {
    /// Of differences of points.
    #[inline]
    fn of(u: DVec3, v: DVec3) -> Self {
        let (x, y) = (u.abs(), v.abs());
        Self {
            normal: u.cross(v),
            size: DVec3::new(
                x.y * y.z + x.z * y.y,
                x.z * y.x + x.x * y.z,
                x.x * y.y + x.y * y.x,
            ),
        }
    }

    /// The value with a third difference of points, and a bound on its error: seven operations (Shewchuk, "Adaptive
    /// Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 4.3), and one for the rounding of
    /// the bound.
    #[inline]
    fn with(&self, w: DVec3) -> (f64, f64) {
        let error = rounding::double(8) * self.size.dot(w.abs());
        (self.normal.dot(w), error)
    }

    /// The sign of the value, or 0 where it is too close to zero to tell.
    #[inline]
    fn sign(&self, w: DVec3) -> i32 {
        let (value, error) = self.with(w);
        i32::from(value > error) - i32::from(value < -error)
    }
}

/// Whether all of one triangle but for common vertices lies on one side of the other's plane, and not near
/// to it: that settles most pairs.
fn clearly_apart(p: [DVec3; 3], q: [DVec3; 3], shared: &[(usize, usize)]) -> bool {
    let beside = |[a, b, c]: [DVec3; 3], x: [DVec3; 3], on: [bool; 3]| {
        let plane = Determinant::of(b - a, c - a);
        let (mut above, mut below) = (true, true);
        for (x, on) in x.into_iter().zip(on) {
            let sign = plane.sign(x - a);
            above &= on || sign > 0;
            below &= on || sign < 0;
        }
        above || below
    };
    let mut on = [[false; 3]; 2];
    for &(i, j) in shared {
        on[0][i] = true;
        on[1][j] = true;
    }
    beside(p, q, on[1]) || beside(q, p, on[0])
}

/// Whether a plane along an edge of each of two triangles separates them, and not closely.
fn separated(p: [DVec3; 3], q: [DVec3; 3]) -> bool {
    (0..3).any(|i| {
        let [a, b, c] = [p[i], p[(i + 1) % 3], p[(i + 2) % 3]];
        (0..3).any(|j| {
            let [u, v, w] = [q[j], q[(j + 1) % 3], q[(j + 2) % 3]];
            // Heights above the plane through the second edge: both ends of the first edge have one.
            let height = Determinant::of(b - a, v - u);
            let (edge, corner, own) = (height.with(a - u), height.with(c - u), height.with(w - u));
            let error = 2.0 * (edge.1 + corner.1 + own.1);
            edge.0.min(corner.0) > own.0.max(0.0) + error
                || edge.0.max(corner.0) < own.0.min(0.0) - error
        })
    })
}

/// Whether a plane along an edge of each of two triangles separates them but for their common vertex, and
/// not closely; given that and the other corners of both.
fn separated_at(common: DVec3, p: [DVec3; 2], q: [DVec3; 2]) -> bool {
    let (p, q) = (p.map(|x| x - common), q.map(|x| x - common));
    (0..2).any(|i| {
        (0..2).any(|j| {
            let plane = Determinant::of(p[i], q[j]);
            plane.sign(p[1 - i]) * plane.sign(q[1 - j]) < 0
        })
    })
}

/// Whether an edge line of one of two triangles separates them in a coordinate plane but for their common vertices: then
/// they have nothing else in common in space either. What separates is decided exactly; that it is false says nothing.
///
/// This settles the neighbours on a flat fan, for which it takes a tenth of the time that exact predicates in space
/// take.
fn apart_in_projection(p: [DVec3; 3], q: [DVec3; 3], shared: &[(usize, usize)]) -> bool {
    let normal = double_area_vector(p[0], p[1], p[2]);
    let most = normal.abs().max_element();
    let plane = Plane2((0..3).find(|&k| normal[k].abs() == most).unwrap_or(2));
    let one_common = |a: [DVec3; 3], b: [DVec3; 3], pairs: &[(usize, usize)]| {
        (0..3).any(|i| {
            let (u, v) = (a[i], a[(i + 1) % 3]);
            // A line that leaves out a common vertex cannot have it on both sides.
            let off = (i + 2) % 3;
            if pairs.iter().any(|&(k, _)| k == off) {
                return false;
            }
            let inside = plane.turn(u, v, a[off]);
            let beyond = |j: usize| {
                pairs.iter().any(|&(_, l)| l == j) || plane.turn(u, v, b[j]) * inside < 0.0
            };
            inside != 0.0 && (0..3).all(beyond)
        })
    };
    let mut swapped = [(0, 0); 3];
    for (s, &(i, j)) in swapped.iter_mut().zip(shared) {
        *s = (j, i);
    }
    one_common(p, q, shared) || one_common(q, p, &swapped[..shared.len()])
}

/// A coordinate plane onto which a triangle projects without losing its area.
#[derive(Clone, Copy)]
struct Plane2(usize);

impl Plane2 {
    fn of([a, b, c]: [DVec3; 3]) -> Option<Self> {
        (0..3).map(Self).find(|p| p.turn(a, b, c) != 0.0)
    }

    fn turn(self, a: DVec3, b: DVec3, c: DVec3) -> f64 {
        let flat = |v: DVec3| {
            let v = v.to_array();
            Coord {
                x: v[(self.0 + 1) % 3],
                y: v[(self.0 + 2) % 3],
            }
        };
        orient2d(flat(a), flat(b), flat(c))
    }
}

/// Whether three points are on a line, exactly.
pub fn is_flat(triangle: [DVec3; 3]) -> bool {
    Plane2::of(triangle).is_none()
}

/// A common point of a segment and a triangle with area, both closed; exact but for the point.
fn segment_meets(p: DVec3, q: DVec3, t: [DVec3; 3]) -> Option<DVec3> {
    let [a, b, c] = t;
    let (sp, sq) = (orientation(a, b, c, p), orientation(a, b, c, q));
    if (sp > 0.0 && sq > 0.0) || (sp < 0.0 && sq < 0.0) {
        return None;
    }
    if sp == 0.0 && sq == 0.0 {
        return coplanar_segment_meets(p, q, t);
    }
    let (mut above, mut below) = (false, false);
    for (u, v) in [(a, b), (b, c), (c, a)] {
        let side = orientation(p, q, u, v);
        above |= side > 0.0;
        below |= side < 0.0;
        if above && below {
            return None;
        }
    }
    let f = sp / (sp - sq);
    Some(p + (q - p) * if f.is_finite() { f } else { 0.5 })
}

fn coplanar_segment_meets(p: DVec3, q: DVec3, t: [DVec3; 3]) -> Option<DVec3> {
    let plane = Plane2::of(t)?;
    let inside = |x: DVec3| {
        let d: [f64; 3] = std::array::from_fn(|i| plane.turn(t[i], t[(i + 1) % 3], x));
        !(d.iter().any(|&x| x > 0.0) && d.iter().any(|&x| x < 0.0))
    };
    if inside(p) {
        return Some(p);
    }
    if inside(q) {
        return Some(q);
    }
    // Neither end is inside: the segment meets the triangle when it crosses an edge.
    (0..3).find_map(|i| {
        let (u, v) = (t[i], t[(i + 1) % 3]);
        let (du, dv) = (plane.turn(p, q, u), plane.turn(p, q, v));
        let (dp, dq) = (plane.turn(u, v, p), plane.turn(u, v, q));
        let across = |x: f64, y: f64| !((x > 0.0 && y > 0.0) || (x < 0.0 && y < 0.0));
        let on_one_line = du == 0.0 && dv == 0.0;
        (across(du, dv) && across(dp, dq) && !on_one_line).then(|| {
            let f = dp / (dp - dq);
            p + (q - p) * if f.is_finite() { f } else { 0.5 }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[[f64; 3]]) -> Vec<DVec3> {
        list.iter().map(|&p| DVec3::from(p)).collect()
    }

    #[test]
    fn crossing_and_touching_triangles_are_found() {
        let v = points(&[
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.0, 2.0, 0.0],
            // Crosses the first one.
            [0.5, 0.5, -1.0],
            [0.5, 0.5, 1.0],
            [5.0, 5.0, 0.0],
            // Stands on its edge.
            [1.0, 0.0, 0.0],
            [1.0, -1.0, 1.0],
            [1.0, -1.0, 2.0],
            // In the plane: inside, and across.
            [0.5, 0.5, 0.0],
            [0.6, 0.5, 0.0],
            [0.5, 0.6, 0.0],
            [-1.0, 1.0, 0.0],
            [3.0, 1.0, 0.0],
            [3.0, 1.5, 0.0],
            // Away.
            [0.5, 0.5, 1e-12],
            [0.6, 0.5, 1e-12],
            [0.5, 0.6, 1e-12],
        ]);
        let base = [0, 1, 2];
        let met = |t: [u32; 3]| {
            let (one, two) = (contact(&v, &base, &t), contact(&v, &t, &base));
            assert_eq!(one.is_some(), two.is_some());
            one.is_some()
        };
        assert!(met([3, 4, 5]));
        assert!(met([6, 7, 8]));
        assert!(met([9, 10, 11]));
        assert!(met([12, 13, 14]));
        assert!(!met([15, 16, 17]));
        assert!(!met([2, 1, 0]));
    }

    #[test]
    fn common_vertices_and_edges_are_no_contact() {
        let v = points(&[
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.0, 2.0, 0.0],
            [2.0, 2.0, 0.0],
            [0.5, 0.5, 0.0],
            [0.5, 0.5, 1.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.5, 0.5, -1.0],
            [0.6, 0.5, 0.0],
        ]);
        let met = |s: [u32; 3], t: [u32; 3]| contact(&v, &s, &t).is_some();
        // Neighbours in the plane, and folded over each other.
        assert!(!met([0, 1, 2], [3, 2, 1]));
        assert!(met([0, 1, 2], [1, 2, 4]));
        assert!(!met([0, 1, 2], [0, 1, 5]));
        // One common vertex: beside, in the plane, and through.
        assert!(!met([0, 1, 2], [0, 6, 7]));
        assert!(met([0, 1, 2], [0, 3, 9]));
        assert!(met([0, 1, 2], [0, 5, 8]));
        assert!(!met([0, 1, 2], [0, 6, 5]));
    }

    #[test]
    fn short_cuts_change_nothing() {
        let mut state = 1_u64;
        let mut random = |below: u64| {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            (state >> 33) % below
        };
        // Corners on a coarse grid, which is turned in space in every other round: many are nearly in one
        // plane, on one line or the same.
        let turn = glam::DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
        let mut met = [[0; 2]; 3];
        for round in 0..60_000 {
            let flat = if random(2) == 0 { 1 } else { 4 };
            let mut point = || DVec3::from([4, 4, flat].map(|n| random(n) as f64));
            let corners: [DVec3; 6] = std::array::from_fn(|_| point());
            let v = corners.map(|p| if round % 2 == 0 { p } else { turn * p });
            let count = random(3) as usize;
            let (s, mut t) = ([0, 1, 2], [3, 4, 5]);
            let shared = [(0, 1), (2, 0)];
            for &(i, j) in &shared[..count] {
                t[j] = s[i];
            }
            let at = |v_of: [u32; 3]| v_of.map(|i| v[i as usize]);
            let exact = meeting(at(s), at(t), &shared[..count]);
            assert_eq!(contact(&v, &s, &t), exact, "{s:?} {t:?} {v:?}");
            met[count][usize::from(exact.is_some())] += 1;
        }
        assert!(met.as_flattened().iter().all(|&n| n > 1000), "{met:?}");
    }
}
