//! Nearest triangle queries on a triangle set.

use super::boxes::{Bounds, Boxes, Item, LEAF, STACK};
use super::placement::Placement;
use crate::rounding;
use crate::tree::alignment::alignment;
use arrayvec::ArrayVec;
use glam::DVec3;

/// A tree over triangles for the nearest one; owns a copy of their corners.
///
/// Boxes are along the faces of the set ([`crate::tree::alignment`]); distances to boxes are taken a margin too small, so
/// that no rounding can hide a triangle. Distances to triangles are in double precision.
pub struct Tree {
    boxes: Boxes,
    /// Corners in the order of the leaves, in the placement.
    corners: Vec<[DVec3; 3]>,
    placement: Placement,
    /// Whether there is a margin around any triangle.
    has_margins: bool,
}

/// Answer to a nearest-triangle query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Index of the triangle in the order it was given to [`Tree::new`].
    pub triangle: u32,
    /// The nearest point of it.
    pub point: DVec3,
    /// Distance, model units.
    pub distance: f64,
}

impl Tree {
    /// Builds the tree over fewer than 2^31 triangles given by their corners; degenerate ones
    /// are welcome, coordinates must be finite. Time n log n.
    pub fn new(triangles: impl IntoIterator<Item = [DVec3; 3]>) -> Self {
        Self::with_margins(triangles, |_| 0.0)
    }

    /// The same over triangles that stand for what may be as far from each of them as `margin` says: within a distance of a
    /// point are those whose boxes are no farther than the distance and their margin.
    pub fn with_margins(
        triangles: impl IntoIterator<Item = [DVec3; 3]>,
        margin: impl Fn(u32) -> f64,
    ) -> Self {
        let mut triangles: Vec<[DVec3; 3]> = triangles.into_iter().collect();
        let mut placement = Placement::of(Bounds::of(triangles.iter().flatten()));
        for p in triangles.iter_mut().flatten() {
            *p = placement.inside(*p);
        }
        if let Some(turn) = alignment(triangles.len(), |i| triangles[i]) {
            placement.turn = Some(turn);
            for p in triangles.iter_mut().flatten() {
                *p = turn * *p;
            }
        }
        let unit = placement.unit;
        let item = |(i, t)| Item::with_margin(Bounds::of(t), margin(i) / unit, i);
        let boxes = Boxes::new((0..).zip(&triangles).map(item).collect());
        Self {
            corners: boxes.index.iter().map(|&i| triangles[i as usize]).collect(),
            boxes,
            placement,
            has_margins: (0..triangles.len() as u32).any(|i| margin(i) > 0.0),
        }
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.boxes.index.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.boxes.index.is_empty()
    }

    /// The triangle nearest to `point`, if one is nearer than `within` (which may be infinite).
    pub fn nearest(&self, point: DVec3, within: f64) -> Option<Nearest> {
        self.near_enough(point, within, 0.0)
    }

    /// Any triangle no farther than `enough` from `point`, else the nearest one, if that is nearer than
    /// `within`.
    pub fn near_enough(&self, point: DVec3, within: f64, enough: f64) -> Option<Nearest> {
        self.search(point, (within, f64::INFINITY), enough, |_| true)
    }

    /// The triangle nearest to `point`, if one is nearer than `within`, where one that would do is known to be nearer than
    /// so much: then less of the tree is looked at.
    pub fn nearest_below(&self, point: DVec3, within: f64, known: f64) -> Option<Nearest> {
        self.search(point, (within, known), 0.0, |_| true)
    }

    /// The nearest of the triangles that are `wanted`, if one is nearer than `within`.
    pub fn nearest_of(
        &self,
        point: DVec3,
        within: f64,
        wanted: impl Fn(u32) -> bool,
    ) -> Option<Nearest> {
        self.search(point, (within, f64::INFINITY), 0.0, wanted)
    }

    #[inline(always)]
    fn search(
        &self,
        point: DVec3,
        limits: (f64, f64),
        enough: f64,
        wanted: impl Fn(u32) -> bool,
    ) -> Option<Nearest> {
        match self.has_margins {
            true => self.search_with::<true>(point, limits, enough, wanted),
            false => self.search_with::<false>(point, limits, enough, wanted),
        }
    }

    /// The search, with margins or without, which saves a fifth of the time.
    #[inline(always)]
    fn search_with<const MARGINS: bool>(
        &self,
        point: DVec3,
        (within, known): (f64, f64),
        enough: f64,
        wanted: impl Fn(u32) -> bool,
    ) -> Option<Nearest> {
        let unit = self.placement.unit;
        let p = self.placement.inside(point);
        let single = p.as_vec3();
        // A gap between a point and a box is rounded with the point's coordinate, with the difference, of up to two
        // coordinates, and when the margin is taken off. Coordinates of boxes, below two, are rounded outwards.
        let largest = f64::from(single.abs().max_element().max(2.0));
        let rounded = rounded_up(rounding::single(5) * largest);
        let (within, known) = (within / unit, known / unit);
        let far = rounded_up(within);
        let mut best = match MARGINS {
            true => known * known,
            false => (within * within).min(known * known),
        };
        let mut bound = squares_up_to(best);
        let mut found: Option<(u32, DVec3)> = None;
        let enough = enough / unit;
        let enough = enough * enough;
        let mut stack: ArrayVec<(u32, f32), STACK> = ArrayVec::new();
        if !self.boxes.nodes.is_empty() {
            stack.push((0, 0.0));
        }
        while let Some((at, d)) = stack.pop() {
            if d >= bound {
                continue;
            }
            if at & LEAF != 0 {
                let i = (at & !LEAF) as usize;
                let q = closest_point(p, &self.corners[i]);
                let d = (p - q).length_squared();
                if d < best && wanted(self.boxes.index[i]) {
                    best = d;
                    bound = squares_up_to(best);
                    found = Some((i as u32, q));
                    if best <= enough {
                        break;
                    }
                }
                continue;
            }
            let node = &self.boxes.nodes[at as usize];
            let mut distances = node.distances_squared(single.to_array(), rounded);
            if MARGINS {
                for (d, margin) in distances.iter_mut().zip(node.margin) {
                    let most = far + margin;
                    let is_within = *d <= most * most * SUM_SQUARED;
                    *d = if is_within { *d } else { f32::INFINITY };
                }
            }
            // The nearest child ends on top.
            let first = stack.len();
            for (d, child) in distances.into_iter().zip(node.child) {
                if d < bound {
                    let mut slot = stack.len();
                    stack.push((child, d));
                    while slot > first && stack[slot - 1].1 < d {
                        stack.swap(slot - 1, slot);
                        slot -= 1;
                    }
                }
            }
        }
        found.map(|(i, q)| Nearest {
            triangle: self.boxes.index[i as usize],
            point: self.placement.outside(q),
            distance: best.sqrt() * unit,
        })
    }
}

/// Factor that makes the square of a sum no smaller for rounding: of the sum, which is squared, of the square, and of
/// the product with this factor.
const SUM_SQUARED: f32 = 1.0 + 4.0 * f32::EPSILON;

/// A single-precision number that is not smaller.
#[inline]
fn rounded_up(x: f64) -> f32 {
    (x as f32).next_up()
}

/// A single-precision number that no sum of three squares is above that is up to `x` but for its rounding: of each square
/// and of two additions.
#[inline]
fn squares_up_to(x: f64) -> f32 {
    rounded_up(x * (1.0 + rounding::single(3)))
}

/// The point of a triangle nearest to `p`.
///
/// By Voronoi regions of the triangle's features (Ericson, "Real-Time Collision Detection", 5.1.5);
/// a degenerate triangle is treated as its edges.
#[inline]
pub fn closest_point(p: DVec3, t: &[DVec3; 3]) -> DVec3 {
    let [a, b, c] = *t;
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return b + (c - b) * w;
    }
    let sum = va + vb + vc;
    let q = a + ab * (vb / sum) + ac * (vc / sum);
    if q.is_finite() {
        q
    } else {
        [(a, b), (b, c), (c, a)]
            .map(|(s, e)| on_segment(p, s, e))
            .into_iter()
            .min_by(|u, v| {
                (p - *u)
                    .length_squared()
                    .total_cmp(&(p - *v).length_squared())
            })
            .unwrap_or(a)
    }
}

fn on_segment(p: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let d = b - a;
    let square = d.length_squared();
    if square > 0.0 {
        a + d * ((p - a).dot(d) / square).clamp(0.0, 1.0)
    } else {
        a
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Lcg(u64);

    impl Lcg {
        fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }

        fn point(&mut self) -> DVec3 {
            DVec3::new(self.next(), self.next(), self.next())
        }
    }

    fn soup(count: usize, size: f64, offset: DVec3, seed: u64) -> Vec<[DVec3; 3]> {
        let mut r = Lcg(seed);
        (0..count)
            .map(|_| {
                let p = r.point() + offset;
                [p, p + size * r.point(), p + size * r.point()]
            })
            .collect()
    }

    #[test]
    fn nearest_agrees_with_a_search_through_all() {
        for (count, size, offset) in [
            (1, 0.3, DVec3::ZERO),
            (500, 0.05, DVec3::ZERO),
            (300, 1.0, DVec3::splat(1e6)),
            (200, 0.0, DVec3::ZERO),
        ] {
            let triangles = soup(count, size, offset, 7);
            let tree = Tree::new(triangles.iter().copied());
            let mut r = Lcg(9);
            for _ in 0..200 {
                let p = 1.5 * r.point() - DVec3::splat(0.25) + offset;
                let best = triangles
                    .iter()
                    .map(|t| (p - closest_point(p, t)).length())
                    .fold(f64::INFINITY, f64::min);
                let found = tree.nearest(p, f64::INFINITY).unwrap();
                assert!((found.distance - best).abs() <= 1e-9);
                assert!(tree.nearest(p, 0.99 * best).is_none());
                assert!(tree.nearest(p, 1.01 * best + 1e-12).is_some());
                let known = 1.01 * best + 1e-12;
                assert_eq!(tree.nearest_below(p, f64::INFINITY, known), Some(found));
            }
        }
    }

    #[test]
    fn thin_triangles_hide_nothing() {
        // A fan of oblique needles, and needles anywhere.
        let mut r = Lcg(3);
        let turn = glam::DQuat::from_rotation_x(0.7) * glam::DQuat::from_rotation_y(0.5);
        let rim = |i: usize| {
            let a = std::f64::consts::TAU * i as f64 / 300.0;
            turn * DVec3::new(a.cos(), a.sin(), 0.3)
        };
        let mut triangles: Vec<[DVec3; 3]> = (0..300)
            .map(|i| [DVec3::ZERO, rim(i), rim(i + 1)])
            .collect();
        triangles.extend((0..100).map(|_| {
            let (p, q) = (r.point(), r.point());
            [q, p, p + (q - p) * r.next() + 0.01 * r.point()]
        }));
        let tree = Tree::new(triangles.iter().copied());
        assert_eq!(tree.len(), triangles.len());
        for _ in 0..2000 {
            let p = 2.0 * r.point() - DVec3::splat(0.5);
            let found = tree.nearest(p, f64::INFINITY).unwrap();
            let least = triangles
                .iter()
                .map(|t| (p - closest_point(p, t)).length())
                .fold(f64::INFINITY, f64::min);
            assert!(
                (found.distance - least).abs() <= 1e-14,
                "{p} {found:?} {least}"
            );
        }
    }

    #[test]
    fn equal_and_degenerate_triangles_do_not_trouble_it() {
        let point = [DVec3::ONE; 3];
        let tree = Tree::new(std::iter::repeat_n(point, 10_000));
        let found = tree.nearest(DVec3::ZERO, f64::INFINITY).unwrap();
        assert_eq!(found.point, DVec3::ONE);
        let needle = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X];
        let p = closest_point(DVec3::new(1.5, 1.0, 0.0), &needle);
        assert!((p - DVec3::new(1.5, 0.0, 0.0)).length() < 1e-12);
        assert!(Tree::new([]).nearest(DVec3::ZERO, 1.0).is_none());
    }
}
