//! What rays meet.

use super::boxes::{Bounds, Boxes, Item, LEAF, WIDTH};
use super::placement::Placement;
use crate::element::predicate::orientation;
use crate::rounding;
use crate::tolerance::ROUNDING;
use glam::DVec3;
use robust::{Coord, orient2d};

/// Triangles to be met by rays.
pub struct Rays<'a> {
    vertices: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    boxes: Boxes,
    placement: Placement,
    /// By how much boxes are to be larger, in the placement.
    margin: f64,
}

/// One of the six directions along the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Direction {
    /// 0, 1, 2 for x, y, z.
    pub axis: usize,
    /// Whether it points to smaller coordinates.
    pub backward: bool,
}

impl Direction {
    /// All six, x first.
    pub const ALL: [Self; 6] = [
        Self::new(0, false),
        Self::new(0, true),
        Self::new(1, false),
        Self::new(1, true),
        Self::new(2, false),
        Self::new(2, true),
    ];

    const fn new(axis: usize, backward: bool) -> Self {
        Self { axis, backward }
    }

    /// The unit vector.
    pub fn vector(self) -> DVec3 {
        DVec3::AXES[self.axis] * if self.backward { -1.0 } else { 1.0 }
    }

    /// Coordinates in which this direction is +x; exact. Mirrors space when `backward`.
    #[inline]
    pub fn view(self, p: DVec3) -> DVec3 {
        let [x, y, z] = p.to_array();
        let (a, b, c) = match self.axis {
            0 => (x, y, z),
            1 => (y, z, x),
            _ => (z, x, y),
        };
        DVec3::new(if self.backward { -a } else { a }, b, c)
    }
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Triangle index.
    pub triangle: u32,
    /// Whether the ray comes from the side the normal points to.
    pub front: bool,
    /// Distance from the ray's origin; rounded.
    pub distance: f64,
}

/// What a ray finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Met {
    /// Nothing.
    Nothing,
    /// This first.
    Hit(Hit),
    /// The ray's origin lies on this triangle.
    Touches(u32),
}

impl<'a> Rays<'a> {
    /// Builds the hierarchy in n log n.
    pub fn new(vertices: &'a [DVec3], triangles: &'a [[u32; 3]]) -> Self {
        let corners = |t: &[u32; 3]| t.map(|v| vertices[v as usize]);
        let bounds: Vec<Bounds> = triangles.iter().map(|t| Bounds::of(&corners(t))).collect();
        let all = Bounds::of(bounds.iter().flat_map(|b| [&b.low, &b.high]));
        let placement = Placement::of(all);
        let placed = |b: &Bounds| Bounds {
            low: placement.inside(b.low),
            high: placement.inside(b.high),
        };
        let items = (0..).zip(&bounds).map(|(i, b)| Item::new(placed(b), i));
        let boxes = Boxes::new(items.collect());
        // Coordinates in the placement are below two, sides of triangles below the diagonal of a cube of four;
        // then the rounding of what is far from the origin.
        let largest = all.low.abs().max(all.high.abs()).max_element() / placement.unit;
        let far = if largest.is_finite() {
            rounding::double(8) * largest
        } else {
            0.0
        };
        Self {
            vertices,
            triangles,
            boxes,
            placement,
            margin: 2.0 * 4.0 * 3.0_f64.sqrt() * ROUNDING + far,
        }
    }

    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.vertices[v as usize])
    }

    /// The nearest triangle in a direction, among those that `wanted` accepts.
    ///
    /// Sides and crossings are exact; where the ray meets an edge or a vertex the origin counts as
    /// moved by an infinitesimal amount across the ray, the same for all triangles, so that a closed
    /// surface is crossed exactly once there. Only distances are rounded.
    pub fn nearest(&self, from: DVec3, along: Direction, wanted: impl Fn(u32) -> bool) -> Met {
        let mut nearest: Option<Hit> = None;
        let mut touched = None;
        self.each_hit(from, along, wanted, |met| match met {
            Met::Hit(hit) => {
                if nearest.is_none_or(|n| self.is_nearer(from, along, &hit, &n)) {
                    nearest = Some(hit);
                }
                nearest.map_or(f64::INFINITY, |n| n.distance)
            }
            Met::Touches(t) => {
                touched = Some(touched.map_or(t, |u: u32| u.min(t)));
                f64::INFINITY
            }
            Met::Nothing => f64::INFINITY,
        });
        match (touched, nearest) {
            (Some(t), _) => Met::Touches(t),
            (None, Some(hit)) => Met::Hit(hit),
            (None, None) => Met::Nothing,
        }
    }

    /// All triangles in a direction, nearest first. See [`Rays::nearest`].
    pub fn all(&self, from: DVec3, along: Direction, wanted: impl Fn(u32) -> bool) -> Vec<Hit> {
        let mut hits = Vec::new();
        self.each_hit(from, along, wanted, |met| {
            if let Met::Hit(hit) = met {
                hits.push(hit);
            }
            f64::INFINITY
        });
        hits.sort_by(|a, b| {
            a.distance
                .total_cmp(&b.distance)
                .then(a.triangle.cmp(&b.triangle))
        });
        hits
    }

    /// Whether the ray meets `hit` before `other`. Where both lie at the same distance, as at a common
    /// vertex or edge, the moved ray of [`meet`] tells them apart.
    fn is_nearer(&self, from: DVec3, along: Direction, hit: &Hit, other: &Hit) -> bool {
        let slack = lost(from, hit.distance);
        if (hit.distance - other.distance).abs() > slack {
            return hit.distance < other.distance;
        }
        let [s, t] = [hit, other].map(|h| self.corners(h.triangle).map(|c| along.view(c)));
        let p = along.view(from);
        // All of one triangle on the ray's side of the other's plane, or all beyond it.
        let side = |[a, b, c]: [DVec3; 3], of: [DVec3; 3]| {
            let mine = orientation(a, b, c, p);
            let theirs = of.map(|x| orientation(a, b, c, x) * mine.signum());
            let near = theirs.iter().all(|&x| x >= 0.0);
            let far = theirs.iter().all(|&x| x <= 0.0);
            (near != far).then_some(near)
        };
        if let Some(nearer) = side(t, s).or_else(|| side(s, t).map(|other_nearer| !other_nearer)) {
            return nearer;
        }
        let slopes = |[a, b, c]: [DVec3; 3]| {
            let n = (b - a).cross(c - a);
            [-n.y / n.x, -n.z / n.x]
        };
        (slopes(s), hit.triangle) < (slopes(t), other.triangle)
    }

    /// Distance along `direction` (in units of its length) from `origin` to the nearest triangle
    /// that is neither `except` nor parallel to the ray; `None` when there is none.
    pub fn first(&self, origin: DVec3, direction: DVec3, except: u32) -> Option<f64> {
        self.met(origin, direction, except).map(|met| met.0)
    }

    /// The same with that triangle; of those that are as far, the one of the lowest number.
    pub fn met(&self, origin: DVec3, direction: DVec3, except: u32) -> Option<(f64, u32)> {
        let mut best = (f64::INFINITY, u32::MAX);
        self.each_near(origin, direction, |t| {
            if t != except
                && let Some(distance) = self.crossing(t, origin, direction)
                && (distance, t) < best
            {
                best = (distance, t);
            }
            best.0
        });
        best.0.is_finite().then_some(best)
    }

    /// Möller and Trumbore's intersection. Barycentric coordinates may be outside by what computing may lose, so that no
    /// ray slips through an edge; a hit reported a little too near does no harm.
    fn crossing(&self, triangle: u32, origin: DVec3, direction: DVec3) -> Option<f64> {
        let [a, b, c] = self.triangles[triangle as usize].map(|v| self.vertices[v as usize]);
        let (u, v) = (b - a, c - a);
        let p = direction.cross(v);
        let determinant = u.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let s = origin - a;
        let q = s.cross(u);
        let first = s.dot(p) / determinant;
        let second = direction.dot(q) / determinant;
        let inside = first.min(second) >= -ROUNDING && first + second <= 1.0 + ROUNDING;
        let distance = v.dot(q) / determinant;
        (inside && distance > 0.0).then_some(distance)
    }

    /// Calls `found` for every triangle the ray meets; it returns the distance beyond which hits are
    /// of no interest.
    fn each_hit(
        &self,
        from: DVec3,
        along: Direction,
        wanted: impl Fn(u32) -> bool,
        mut found: impl FnMut(Met) -> f64,
    ) {
        let p = along.view(from);
        let mut limit = f64::INFINITY;
        self.each_near(from, along.vector(), |t| {
            if wanted(t) {
                match meet(p, self.corners(t).map(|c| along.view(c)), along.backward) {
                    Ray::Misses => {}
                    Ray::Touches => limit = found(Met::Touches(t)),
                    Ray::Hits { front, distance } => {
                        limit = found(Met::Hit(Hit {
                            triangle: t,
                            front,
                            distance,
                        }));
                    }
                }
            }
            limit + lost(p, limit)
        });
    }

    /// Calls `visit` for every triangle whose box the ray comes near to, nearer ones mostly first; it returns the
    /// distance, in units of the direction's length, beyond which triangles are of no interest.
    fn each_near(&self, origin: DVec3, direction: DVec3, mut visit: impl FnMut(u32) -> f64) {
        let origin = self.placement.inside(origin);
        let inverse = (direction / self.placement.unit).recip();
        let mut limit = f64::INFINITY;
        let mut open = vec![(0.0, 0_u32)];
        if self.boxes.nodes.is_empty() {
            open.clear();
        }
        while let Some((from, child)) = open.pop() {
            if from > limit {
                continue;
            }
            if child & LEAF != 0 {
                limit = visit(self.boxes.index[(child & !LEAF) as usize]);
                continue;
            }
            let node = &self.boxes.nodes[child as usize];
            let first = open.len();
            for slot in 0..WIDTH {
                let [low, high] = [&node.low, &node.high]
                    .map(|x| DVec3::from_array([0, 1, 2].map(|k| f64::from(x[k][slot]))));
                let (low, high) = (low - self.margin - origin, high + self.margin - origin);
                if let Some(from) = entry(low, high, inverse, limit) {
                    open.push((from, node.child[slot]));
                }
            }
            // The nearest child ends on top.
            open[first..].sort_by(|a, b| b.0.total_cmp(&a.0));
        }
    }
}

/// Where a ray enters a box, given relative to its origin, before `limit`.
fn entry(low: DVec3, high: DVec3, inverse: DVec3, limit: f64) -> Option<f64> {
    let (mut from, mut to) = (0.0_f64, limit);
    for axis in 0..3 {
        if low[axis] > high[axis] {
            return None;
        }
        let (a, b) = (low[axis] * inverse[axis], high[axis] * inverse[axis]);
        // A ray in the plane of a box's side: it is between the two sides all along.
        if a.is_nan() || b.is_nan() {
            continue;
        }
        from = from.max(a.min(b));
        to = to.min(a.max(b));
    }
    // Both are products with a rounded reciprocal.
    (from <= to * (1.0 + rounding::double(4)) + f64::MIN_POSITIVE).then_some(from)
}

/// What is to be expected that computing loses of a distance from `p` along a ray. Distances that differ by less are
/// compared exactly, which takes longer and is right as well.
fn lost(p: DVec3, distance: f64) -> f64 {
    ROUNDING * (p.abs().max_element() + distance)
}

enum Ray {
    Misses,
    Touches,
    Hits { front: bool, distance: f64 },
}

/// A ray from `p` towards +x against a triangle, both in a [`Direction`]'s view.
fn meet(p: DVec3, [a, b, c]: [DVec3; 3], mirrored: bool) -> Ray {
    let flat = |v: DVec3| Coord { x: v.y, y: v.z };
    // Crossings of the half line from p towards +y in the plane x = const. A point at the height of
    // p counts as below it, an edge through p as behind it: p is moved a little in y and much less
    // in z.
    let crosses = |u: DVec3, v: DVec3| {
        (u.z > p.z) != (v.z > p.z) && {
            let side = orient2d(flat(u), flat(v), flat(p));
            if v.z > u.z { side > 0.0 } else { side < 0.0 }
        }
    };
    if !(crosses(a, b) ^ crosses(b, c) ^ crosses(c, a)) {
        return Ray::Misses;
    }
    // The moved p projects into the triangle, so this is not zero.
    let forward = orient2d(flat(a), flat(b), flat(c)) > 0.0;
    let side = orientation(a, b, c, p);
    if side == 0.0 {
        return Ray::Touches;
    }
    // The normal points along +x when `forward`: the triangle is ahead of a point behind it.
    if forward == (side > 0.0) {
        return Ray::Misses;
    }
    let normal = (b - a).cross(c - a);
    let distance = normal.dot(a - p) / normal.x;
    Ray::Hits {
        front: forward == mirrored,
        distance: if distance.is_finite() {
            distance.max(0.0)
        } else {
            0.0
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of unit octahedra, with their centres at multiples of 4.
    fn octahedra(n: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..n * n * n {
            let centre =
                DVec3::new(f64::from(i % n), f64::from(i / n % n), f64::from(i / n / n)) * 4.0;
            let base = vertices.len() as u32;
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                vertices.extend([centre + axis, centre - axis]);
            }
            for octant in 0..8_u32 {
                let [x, y, z] = [octant & 1, octant >> 1 & 1, octant >> 2];
                let t = [base + x, base + 2 + y, base + 4 + z];
                let odd = (x + y + z) % 2 == 1;
                triangles.push(if odd { [t[0], t[2], t[1]] } else { t });
            }
        }
        (vertices, triangles)
    }

    #[test]
    fn rays_through_vertices_and_edges_cross_once() {
        let (vertices, triangles) = octahedra(3);
        let rays = Rays::new(&vertices, &triangles);
        for along in Direction::ALL {
            for from in [
                DVec3::splat(4.0),
                DVec3::new(4.0, 4.25, 4.0),
                DVec3::new(4.125, 4.25, 4.0),
            ] {
                // Inside the middle one: seen from the back, then one more octahedron.
                let Met::Hit(hit) = rays.nearest(from, along, |_| true) else {
                    panic!("no hit from {from} along {along:?}");
                };
                assert!(!hit.front);
                assert_eq!(hit.triangle / 8, 13);
                let fronts: Vec<bool> = rays
                    .all(from, along, |_| true)
                    .iter()
                    .map(|h| h.front)
                    .collect();
                assert_eq!(fronts, [false, true, false]);
            }
        }
        let outside = DVec3::new(-4.0, 4.0, 4.0);
        let count = |along| rays.all(outside, along, |_| true).len();
        assert_eq!(count(Direction::ALL[0]), 6);
        assert_eq!(count(Direction::ALL[1]), 0);
        let on = DVec3::new(0.5, 0.25, 0.25);
        assert!(matches!(
            rays.nearest(on, Direction::ALL[0], |_| true),
            Met::Touches(_)
        ));
    }

    #[test]
    fn agrees_with_trying_all() {
        // A deterministic cloud of triangles.
        let mut state = 7_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..300_u32 {
            let centre = DVec3::new(next(), next(), next());
            for _ in 0..3 {
                vertices.push(centre + 0.1 * DVec3::new(next(), next(), next()));
            }
            triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let rays = Rays::new(&vertices, &triangles);
        for except in 0..100 {
            let origin = DVec3::new(next(), next(), next());
            let direction = DVec3::new(next() - 0.5, next() - 0.5, next() - 0.5);
            let all = (0..300)
                .filter(|&t| t != except)
                .filter_map(|t| rays.crossing(t, origin, direction))
                .min_by(f64::total_cmp);
            assert_eq!(rays.first(origin, direction, except), all);
        }
    }

    #[test]
    fn rays_along_the_side_of_a_box_do_not_miss_it_by_rounding() {
        let vertices = [
            DVec3::new(4.0, 1.0, 0.0),
            DVec3::new(5.0, 1.0, 0.0),
            DVec3::new(4.0, 1.0, 1.0),
        ];
        let triangles = [[0, 1, 2]];
        let rays = Rays::new(&vertices, &triangles);
        for x in [4.0_f64.next_down(), 4.0, 4.0_f64.next_up()] {
            let origin = DVec3::new(x, 0.0, 0.25);
            assert_eq!(rays.first(origin, DVec3::Y, u32::MAX), Some(1.0));
        }
    }

    #[test]
    fn axis_parallel_rays_meet_flat_triangles() {
        let vertices = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.2, 0.2, -1.0)];
        let triangles = [[0, 1, 2]];
        let rays = Rays::new(&vertices, &triangles);
        assert_eq!(rays.first(vertices[3], DVec3::Z, u32::MAX), Some(1.0));
        assert_eq!(rays.first(vertices[3], -DVec3::Z, u32::MAX), None);
    }

    #[test]
    fn rays_along_the_side_of_a_box_enter_it() {
        // A row of triangles above z = 0.
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        for i in 0..8_u32 {
            let x = f64::from(i);
            let corners = [[x, 1.0, 0.0], [x + 1.0, 1.0, 0.0], [x + 0.5, 1.0, 1.0]];
            vertices.extend(corners.map(DVec3::from_array));
            triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let rays = Rays::new(&vertices, &triangles);
        for x in [0.25, 3.5, 7.75] {
            let origin = DVec3::new(x, 0.0, 0.0);
            assert_eq!(rays.first(origin, DVec3::Y, u32::MAX), Some(1.0), "{x}");
        }
    }
}
