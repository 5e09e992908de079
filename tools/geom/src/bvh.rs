//! Nearest triangle queries on a triangle set.
//!
//! A bounding-volume hierarchy with four children per node and single triangles, or pieces of long and thin
//! ones, as leaves, split by the surface-area heuristic over bins of centroids (Wald, "On fast construction
//! of SAH-based bounding volume hierarchies", 2007). Boxes are in single precision, about the centre of the
//! set, in units of its size and along its faces ([`crate::alignment`]); distances to them are taken a
//! margin too small, so that no rounding can hide a triangle. Distances to triangles are in double
//! precision.

use crate::alignment::alignment;
use arrayvec::ArrayVec;
use glam::{DMat3, DVec3};

/// Children of a node.
const WIDTH: usize = 4;
/// Bins per split.
const BINS: usize = 12;
/// Depth from which ranges are halved, so that the depth stays bounded.
const HALVING_DEPTH: usize = 40;
/// Entries of a traversal stack: three for each level.
const STACK: usize = 256;
/// Marks a child that is a triangle.
const LEAF: u32 = 1 << 31;
/// Bound on the rounding of a single-precision coordinate and of a difference of two, relative to
/// the largest coordinate.
const ROUNDING: f32 = 4e-7;

/// A bounding-volume hierarchy over triangles; owns a copy of their corners.
pub struct Bvh {
    nodes: Vec<Node>,
    /// Corners in leaf order, in units of `unit` about `centre`.
    corners: Vec<[DVec3; 3]>,
    /// Index of each triangle in the caller's order.
    index: Vec<u32>,
    centre: DVec3,
    /// A power of two.
    unit: f64,
    /// What `corners` are turned by, if anything.
    turn: Option<DMat3>,
}

/// Boxes of the children, coordinate by coordinate; an empty slot has an inverted box.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Node {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    /// Index of a node, or of a triangle with [`LEAF`] set.
    child: [u32; WIDTH],
}

/// Answer to a nearest-triangle query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Index of the triangle in the order it was given to [`Bvh::new`].
    pub triangle: u32,
    /// The nearest point of it.
    pub point: DVec3,
    /// Distance, model units.
    pub distance: f64,
}

impl Bvh {
    /// Builds the hierarchy over fewer than 2^31 triangles given by their corners; degenerate ones
    /// are welcome, coordinates must be finite. Time n log n.
    pub fn new(triangles: impl IntoIterator<Item = [DVec3; 3]>) -> Self {
        let mut triangles: Vec<[DVec3; 3]> = triangles.into_iter().collect();
        let bounds = triangles
            .iter()
            .flatten()
            .fold(Bounds::EMPTY, |b, &p| b.with(p));
        let (centre, extent) = if triangles.is_empty() {
            (DVec3::ZERO, 0.0)
        } else {
            // Halved before adding: the sum of two large coordinates may overflow.
            let half = 0.5 * bounds.high - 0.5 * bounds.low;
            (0.5 * bounds.low + 0.5 * bounds.high, half.max_element())
        };
        let unit = if extent.is_normal() {
            2.0_f64.powi(extent.log2().ceil().clamp(-1000.0, 1000.0) as i32)
        } else {
            1.0
        };
        for p in triangles.iter_mut().flatten() {
            *p = (*p - centre) / unit;
        }
        let turn = alignment(triangles.len(), |i| triangles[i]);
        if let Some(turn) = turn {
            for p in triangles.iter_mut().flatten() {
                *p = turn * *p;
            }
        }
        let mut items: Vec<Item> = Vec::with_capacity(triangles.len());
        let thin = Thin::new(&triangles);
        for (i, t) in triangles.iter().enumerate() {
            thin.for_each_piece(t, |bounds| {
                items.push(Item {
                    bounds,
                    middle: 0.5 * (bounds.low + bounds.high),
                    index: i as u32,
                });
            });
        }
        let nodes = build(&mut items);
        Self {
            nodes,
            corners: items.iter().map(|i| triangles[i.index as usize]).collect(),
            index: items.iter().map(|i| i.index).collect(),
            centre,
            unit,
            turn,
        }
    }

    /// Number of leaves: triangles and pieces of them.
    pub fn len(&self) -> usize {
        self.index.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.index.is_empty()
    }

    /// The triangle nearest to `point`, if one is nearer than `within` (which may be infinite).
    pub fn nearest(&self, point: DVec3, within: f64) -> Option<Nearest> {
        self.near_enough(point, within, 0.0)
    }

    /// Any triangle no farther than `enough` from `point`, else the nearest one, if that is nearer than
    /// `within`.
    pub fn near_enough(&self, point: DVec3, within: f64, enough: f64) -> Option<Nearest> {
        let p = (point - self.centre) / self.unit;
        let p = self.turn.map_or(p, |turn| turn * p);
        let single = p.as_vec3();
        let margin = ROUNDING * single.abs().max_element().max(1.0);
        let within = within / self.unit;
        let mut best = within * within;
        let mut bound = rounded_up(best);
        let mut found: Option<(u32, DVec3)> = None;
        let enough = enough / self.unit;
        let enough = enough * enough;
        let mut stack: ArrayVec<(u32, f32), STACK> = ArrayVec::new();
        if !self.nodes.is_empty() {
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
                if d < best {
                    best = d;
                    bound = rounded_up(best);
                    found = Some((i as u32, q));
                    if best <= enough {
                        break;
                    }
                }
                continue;
            }
            let node = &self.nodes[at as usize];
            let distances = node.distances_squared(single.to_array(), margin);
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
            triangle: self.index[i as usize],
            point: self.turn.map_or(q, |turn| turn.transpose() * q) * self.unit + self.centre,
            distance: best.sqrt() * self.unit,
        })
    }
}

/// A single-precision number that is not smaller, with room for the rounding of a sum of squares.
#[inline]
fn rounded_up(x: f64) -> f32 {
    ((x * 1.000_002) as f32).next_up()
}

impl Node {
    const EMPTY: Self = Self {
        low: [[f32::INFINITY; WIDTH]; 3],
        high: [[f32::NEG_INFINITY; WIDTH]; 3],
        child: [0; WIDTH],
    };

    /// Squared distances of a point from the boxes; each coordinate's gap is shortened by `margin`.
    #[inline]
    fn distances_squared(&self, p: [f32; 3], margin: f32) -> [f32; WIDTH] {
        let mut sum = [0.0_f32; WIDTH];
        for ((low, high), p) in self.low.iter().zip(&self.high).zip(p) {
            for ((s, low), high) in sum.iter_mut().zip(low).zip(high) {
                let (below, above) = (low - p, p - high);
                // Plain comparisons become single instructions, which `max` with its care for NaN
                // does not.
                let gap = if below > above { below } else { above } - margin;
                let gap = if gap > 0.0 { gap } else { 0.0 };
                *s += gap * gap;
            }
        }
        sum
    }

    fn set(&mut self, slot: usize, bounds: &Bounds, child: u32) {
        let down = |x: f64| {
            let y = x as f32;
            if f64::from(y) > x { y.next_down() } else { y }
        };
        let up = |x: f64| {
            let y = x as f32;
            if f64::from(y) < x { y.next_up() } else { y }
        };
        for k in 0..3 {
            self.low[k][slot] = down(bounds.low[k]);
            self.high[k][slot] = up(bounds.high[k]);
        }
        self.child[slot] = child;
    }
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

#[derive(Clone, Copy)]
struct Bounds {
    low: DVec3,
    high: DVec3,
}

impl Bounds {
    const EMPTY: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
    };

    fn with(self, p: DVec3) -> Self {
        Self {
            low: self.low.min(p),
            high: self.high.max(p),
        }
    }

    fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    fn half_area(&self) -> f64 {
        let e = (self.high - self.low).max(DVec3::ZERO);
        e.x * e.y + e.y * e.z + e.z * e.x
    }
}

/// What counts as long and thin. The box of such a triangle, if it is oblique, is nearly empty, and where
/// many of them meet in a point each place is in the boxes of all; boxes of pieces are smaller.
struct Thin {
    /// Pieces per unit of half a box's surface over twice the triangle's area; zero for none.
    rate: f64,
}

impl Thin {
    /// Pieces of a triangle, at most.
    const MOST: usize = 16;
    /// Half a box's surface over twice the area of a triangle that is not thin, at most.
    const COMPACT: f64 = 3.0;
    /// Shorter triangles, in units of half the set's size, are left whole.
    const SHORT: f64 = 1.0 / 32.0;
    /// Pieces there may be beyond two for each triangle.
    const SPARE: usize = 1 << 16;

    fn new(triangles: &[[DVec3; 3]]) -> Self {
        let mut thin = Self {
            rate: 1.0 / Self::COMPACT,
        };
        // Fewer for each where most triangles are thin.
        while thin.rate > 1e-6 {
            let pieces: usize = triangles.iter().map(|t| thin.pieces(t)).sum();
            if pieces <= 2 * triangles.len() + Self::SPARE {
                return thin;
            }
            thin.rate *= 0.25;
        }
        thin.rate = 0.0;
        thin
    }

    fn pieces(&self, t: &[DVec3; 3]) -> usize {
        let bounds = t.iter().fold(Bounds::EMPTY, |b, &p| b.with(p));
        let extent = (bounds.high - bounds.low).max_element();
        let area = (t[1] - t[0]).cross(t[2] - t[0]).length();
        let pieces = self.rate * bounds.half_area() / area;
        match pieces.is_finite() && extent > Self::SHORT {
            true => (pieces as usize).clamp(1, Self::MOST),
            false => 1,
        }
    }

    /// Gives the boxes of the pieces of a triangle, cut across its longest side.
    fn for_each_piece(&self, t: &[DVec3; 3], mut visit: impl FnMut(Bounds)) {
        let count = self.pieces(t);
        if count == 1 {
            return visit(t.iter().fold(Bounds::EMPTY, |b, &p| b.with(p)));
        }
        let longest = (0..3).max_by(|&i, &j| {
            let square = |i: usize| (t[(i + 1) % 3] - t[i]).length_squared();
            square(i).total_cmp(&square(j))
        });
        let i = longest.unwrap_or(0);
        let (a, b, c) = (t[i], t[(i + 1) % 3], t[(i + 2) % 3]);
        let along = b - a;
        // Where the apex is, as a part of the longest side; between 0 and 1 but for rounding.
        let apex = ((c - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let on_base = |x: f64| a + along * x;
        let on_sides = |x: f64| match x < apex {
            true => a + (c - a) * (x / apex),
            false => b + (c - b) * ((1.0 - x) / (1.0 - apex)),
        };
        for k in 0..count {
            let [low, high] = [k, k + 1].map(|k| k as f64 / count as f64);
            let mut bounds = Bounds::EMPTY;
            for x in [low, high] {
                bounds = bounds.with(on_base(x));
                let q = on_sides(x);
                bounds = bounds.with(if q.is_finite() { q } else { c });
            }
            if (low..=high).contains(&apex) {
                bounds = bounds.with(c);
            }
            visit(bounds);
        }
    }
}

#[derive(Clone, Copy)]
struct Item {
    bounds: Bounds,
    middle: DVec3,
    index: u32,
}

/// A run of items, with its box and its depth in halvings.
#[derive(Clone, Copy)]
struct Range {
    first: usize,
    count: usize,
    depth: usize,
    bounds: Bounds,
}

impl Range {
    fn new(items: &[Item], first: usize, count: usize, depth: usize) -> Self {
        let bounds = items[first..first + count]
            .iter()
            .fold(Bounds::EMPTY, |b, i| b.union(i.bounds));
        Self {
            first,
            count,
            depth,
            bounds,
        }
    }
}

/// Orders `items` by leaf and returns the nodes, the root first.
fn build(items: &mut [Item]) -> Vec<Node> {
    let mut nodes: Vec<Node> = Vec::with_capacity(items.len() / 2);
    if items.is_empty() {
        return nodes;
    }
    let all = Range::new(items, 0, items.len(), 0);
    // (range, where to note the index of its node)
    let mut work = vec![(all, None::<(usize, usize)>)];
    while let Some((range, parent)) = work.pop() {
        let at = nodes.len();
        if let Some((node, slot)) = parent {
            nodes[node].child[slot] = at as u32;
        }
        let mut parts: ArrayVec<Range, WIDTH> = ArrayVec::new();
        if range.count <= WIDTH {
            let each = range.first..range.first + range.count;
            parts.extend(each.map(|i| Range::new(items, i, 1, range.depth + 1)));
        } else {
            parts.push(range);
        }
        while parts.len() < WIDTH {
            let widest = (0..parts.len())
                .filter(|&i| parts[i].count > 1)
                .max_by(|&i, &j| {
                    let area = |i: usize| parts[i].bounds.half_area();
                    area(i).total_cmp(&area(j)).then(j.cmp(&i))
                });
            let Some(widest) = widest else { break };
            let Range {
                first,
                count,
                depth,
                ..
            } = parts[widest];
            let left = split(&mut items[first..first + count], depth);
            parts[widest] = Range::new(items, first, left, depth + 1);
            parts.insert(
                widest + 1,
                Range::new(items, first + left, count - left, depth + 1),
            );
        }
        let mut node = Node::EMPTY;
        for (slot, part) in parts.iter().enumerate() {
            if part.count == 1 {
                node.set(slot, &part.bounds, LEAF | part.first as u32);
            } else {
                node.set(slot, &part.bounds, 0);
                work.push((*part, Some((at, slot))));
            }
        }
        nodes.push(node);
    }
    nodes
}

/// Partitions a range of two or more; returns the size of its left part, neither zero nor all.
fn split(range: &mut [Item], depth: usize) -> usize {
    let middles = range.iter().fold(Bounds::EMPTY, |b, i| b.with(i.middle));
    let extent = middles.high - middles.low;
    let axis = (0..3).fold(0, |m, i| if extent[i] > extent[m] { i } else { m });
    let half = range.len() / 2;
    if extent[axis] <= 0.0 {
        return half;
    }
    let halve = |range: &mut [Item]| {
        range.select_nth_unstable_by(half, |a, b| {
            a.middle[axis]
                .total_cmp(&b.middle[axis])
                .then(a.index.cmp(&b.index))
        });
        half
    };
    if depth >= HALVING_DEPTH {
        return halve(range);
    }
    let scale = BINS as f64 / extent[axis];
    let bin = |i: &Item| (((i.middle[axis] - middles.low[axis]) * scale) as usize).min(BINS - 1);
    let mut bins = [(Bounds::EMPTY, 0_usize); BINS];
    for item in range.iter() {
        let b = &mut bins[bin(item)];
        *b = (b.0.union(item.bounds), b.1 + 1);
    }
    let mut right = [0.0; BINS];
    let (mut bounds, mut count) = (Bounds::EMPTY, 0);
    for i in (1..BINS).rev() {
        bounds = bounds.union(bins[i].0);
        count += bins[i].1;
        right[i] = bounds.half_area() * count as f64;
    }
    let (mut bounds, mut count) = (Bounds::EMPTY, 0);
    let mut best = (f64::INFINITY, 0);
    for i in 1..BINS {
        bounds = bounds.union(bins[i - 1].0);
        count += bins[i - 1].1;
        let cost = bounds.half_area() * count as f64 + right[i];
        if count > 0 && count < range.len() && cost < best.0 {
            best = (cost, i);
        }
    }
    if best.1 == 0 {
        return halve(range);
    }
    let mut left = 0;
    for i in 0..range.len() {
        if bin(&range[i]) < best.1 {
            range.swap(left, i);
            left += 1;
        }
    }
    left
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
            let bvh = Bvh::new(triangles.iter().copied());
            let mut r = Lcg(9);
            for _ in 0..200 {
                let p = 1.5 * r.point() - DVec3::splat(0.25) + offset;
                let best = triangles
                    .iter()
                    .map(|t| (p - closest_point(p, t)).length())
                    .fold(f64::INFINITY, f64::min);
                let found = bvh.nearest(p, f64::INFINITY).unwrap();
                assert!((found.distance - best).abs() <= 1e-9);
                assert!(bvh.nearest(p, 0.99 * best).is_none());
                assert!(bvh.nearest(p, 1.01 * best + 1e-12).is_some());
            }
        }
    }

    #[test]
    fn pieces_of_thin_triangles_hide_nothing() {
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
        let bvh = Bvh::new(triangles.iter().copied());
        assert!(bvh.len() > 2 * triangles.len());
        for _ in 0..2000 {
            let p = 2.0 * r.point() - DVec3::splat(0.5);
            let found = bvh.nearest(p, f64::INFINITY).unwrap();
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
        let bvh = Bvh::new(std::iter::repeat_n(point, 10_000));
        let found = bvh.nearest(DVec3::ZERO, f64::INFINITY).unwrap();
        assert_eq!(found.point, DVec3::ONE);
        let needle = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X];
        let p = closest_point(DVec3::new(1.5, 1.0, 0.0), &needle);
        assert!((p - DVec3::new(1.5, 0.0, 0.0)).length() < 1e-12);
        assert!(Bvh::new([]).nearest(DVec3::ZERO, 1.0).is_none());
    }
}
