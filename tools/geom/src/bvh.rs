//! Nearest triangle and box queries on a triangle set.
//!
//! A binary bounding-volume hierarchy, split by the surface-area heuristic over twelve bins of
//! centroids (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007). Boxes
//! are single precision, rounded outwards, about the centre of the set, so that a set far from the
//! origin keeps its resolution.

use glam::DVec3;

/// Triangles per leaf at most, unless their centroids coincide.
const LEAF: usize = 4;
/// Bins per split.
const BINS: usize = 12;
/// Depth from which ranges are halved, so that the depth stays bounded.
const HALVING_DEPTH: usize = 40;
/// Entries of a traversal stack: one per level.
const STACK: usize = 96;

/// A bounding-volume hierarchy over triangles; owns a copy of their corners.
pub struct Bvh {
    nodes: Vec<Node>,
    /// Corners in leaf order, relative to `centre`.
    corners: Vec<[DVec3; 3]>,
    /// Index of each triangle in the caller's order.
    index: Vec<u32>,
    centre: DVec3,
}

/// Leaf: `count` triangles from `next`. Inner node (`count` 0): the children follow directly and at
/// `next`.
#[derive(Clone, Copy)]
struct Node {
    low: [f32; 3],
    next: u32,
    high: [f32; 3],
    count: u32,
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
    /// Builds the hierarchy over triangles given by their corners; degenerate ones are welcome,
    /// coordinates must be finite. Time n log n.
    pub fn new(triangles: impl IntoIterator<Item = [DVec3; 3]>) -> Self {
        let mut triangles: Vec<[DVec3; 3]> = triangles.into_iter().collect();
        let bounds = triangles
            .iter()
            .flatten()
            .fold(Bounds::EMPTY, |b, &p| b.with(p));
        let centre = if triangles.is_empty() {
            DVec3::ZERO
        } else {
            0.5 * (bounds.low + bounds.high)
        };
        for p in triangles.iter_mut().flatten() {
            *p -= centre;
        }
        let mut items: Vec<Item> = triangles
            .iter()
            .enumerate()
            .map(|(i, t)| {
                let bounds = t.iter().fold(Bounds::EMPTY, |b, &p| b.with(p));
                Item {
                    bounds,
                    middle: 0.5 * (bounds.low + bounds.high),
                    index: i as u32,
                }
            })
            .collect();
        let mut nodes = Vec::with_capacity(items.len());
        if !items.is_empty() {
            build(&mut items, &mut nodes);
        }
        Self {
            nodes,
            corners: items.iter().map(|i| triangles[i.index as usize]).collect(),
            index: items.iter().map(|i| i.index).collect(),
            centre,
        }
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.index.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.index.is_empty()
    }

    /// The triangle nearest to `point`, if one is nearer than `within` (which may be infinite).
    pub fn nearest(&self, point: DVec3, within: f64) -> Option<Nearest> {
        let p = point - self.centre;
        let mut best = within * within;
        let mut found: Option<(u32, DVec3)> = None;
        if self.nodes.is_empty() || self.nodes[0].distance_squared(p) >= best {
            return None;
        }
        let mut stack = [(0_u32, 0.0_f64); STACK];
        let mut depth = 0;
        let mut at = 0_usize;
        loop {
            let node = &self.nodes[at];
            if node.count > 0 {
                let first = node.next as usize;
                for i in first..first + node.count as usize {
                    let q = closest_point(p, &self.corners[i]);
                    let d = (p - q).length_squared();
                    if d < best {
                        best = d;
                        found = Some((self.index[i], q));
                    }
                }
            } else {
                let (a, b) = (at + 1, node.next as usize);
                let da = self.nodes[a].distance_squared(p);
                let db = self.nodes[b].distance_squared(p);
                let ((near, dn), (far, df)) = if da <= db {
                    ((a, da), (b, db))
                } else {
                    ((b, db), (a, da))
                };
                if df < best {
                    stack[depth] = (far as u32, df);
                    depth += 1;
                }
                if dn < best {
                    at = near;
                    continue;
                }
            }
            loop {
                if depth == 0 {
                    return found.map(|(triangle, q)| Nearest {
                        triangle,
                        point: q + self.centre,
                        distance: best.sqrt(),
                    });
                }
                depth -= 1;
                let (next, d) = stack[depth];
                if d < best {
                    at = next as usize;
                    break;
                }
            }
        }
    }

    /// Calls `visit` with every triangle whose bounding box (single precision, so a little larger)
    /// meets the box from `low` to `high`, in a fixed order.
    pub fn for_each_in_box(&self, low: DVec3, high: DVec3, mut visit: impl FnMut(u32)) {
        if self.nodes.is_empty() {
            return;
        }
        let (low, high) = (low - self.centre, high - self.centre);
        let mut stack = vec![0_u32];
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at as usize];
            if !node.meets(low, high) {
                continue;
            }
            if node.count == 0 {
                stack.push(node.next);
                stack.push(at + 1);
                continue;
            }
            let first = node.next as usize;
            for i in first..first + node.count as usize {
                let t = &self.corners[i];
                let (l, h) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
                if l.cmple(high).all() && h.cmpge(low).all() {
                    visit(self.index[i]);
                }
            }
        }
    }
}

impl Node {
    #[inline]
    fn distance_squared(&self, p: DVec3) -> f64 {
        let gap = |axis: usize, x: f64| {
            (f64::from(self.low[axis]) - x)
                .max(x - f64::from(self.high[axis]))
                .max(0.0)
        };
        let (x, y, z) = (gap(0, p.x), gap(1, p.y), gap(2, p.z));
        x * x + y * y + z * z
    }

    fn meets(&self, low: DVec3, high: DVec3) -> bool {
        (0..3).all(|i| f64::from(self.low[i]) <= high[i] && f64::from(self.high[i]) >= low[i])
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

    fn node(&self, next: u32, count: u32) -> Node {
        let down = |x: f64| {
            let y = x as f32;
            if f64::from(y) > x { y.next_down() } else { y }
        };
        let up = |x: f64| {
            let y = x as f32;
            if f64::from(y) < x { y.next_up() } else { y }
        };
        Node {
            low: self.low.to_array().map(down),
            high: self.high.to_array().map(up),
            next,
            count,
        }
    }
}

#[derive(Clone, Copy)]
struct Item {
    bounds: Bounds,
    middle: DVec3,
    index: u32,
}

/// Orders `items` by leaf and appends the nodes, a left child directly after its parent.
fn build(items: &mut [Item], nodes: &mut Vec<Node>) {
    // (first item, count, depth, parent whose right child this is)
    let mut work = vec![(0_usize, items.len(), 0_usize, None::<usize>)];
    while let Some((first, count, depth, parent)) = work.pop() {
        let range = &mut items[first..first + count];
        let bounds = range.iter().fold(Bounds::EMPTY, |b, i| b.union(i.bounds));
        if let Some(parent) = parent {
            nodes[parent].next = nodes.len() as u32;
        }
        let split = if count <= LEAF {
            None
        } else {
            split(range, depth)
        };
        let at = nodes.len();
        match split {
            None => nodes.push(bounds.node(first as u32, count as u32)),
            Some(left) => {
                nodes.push(bounds.node(0, 0));
                work.push((first + left, count - left, depth + 1, Some(at)));
                work.push((first, left, depth + 1, None));
            }
        }
    }
}

/// Partitions a range; returns the size of its left part, or `None` when it cannot be divided.
fn split(range: &mut [Item], depth: usize) -> Option<usize> {
    let middles = range.iter().fold(Bounds::EMPTY, |b, i| b.with(i.middle));
    let extent = middles.high - middles.low;
    let axis = (0..3).fold(0, |m, i| if extent[i] > extent[m] { i } else { m });
    let half = range.len() / 2;
    if extent[axis] <= 0.0 {
        return (range.len() > 64 * LEAF).then_some(half);
    }
    let halve = |range: &mut [Item]| {
        range.select_nth_unstable_by(half, |a, b| {
            a.middle[axis]
                .total_cmp(&b.middle[axis])
                .then(a.index.cmp(&b.index))
        });
        Some(half)
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
    Some(left)
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
    fn boxes_find_exactly_the_triangles_that_meet_them() {
        let triangles = soup(400, 0.1, DVec3::ZERO, 3);
        let bvh = Bvh::new(triangles.iter().copied());
        let mut r = Lcg(4);
        for _ in 0..50 {
            let low = r.point();
            let high = low + 0.2 * r.point();
            let mut found = Vec::new();
            bvh.for_each_in_box(low, high, |t| found.push(t));
            found.sort_unstable();
            let expected: Vec<u32> = (0..400)
                .filter(|&i| {
                    let t = &triangles[i as usize];
                    let (l, h) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
                    l.cmple(high).all() && h.cmpge(low).all()
                })
                .collect();
            assert_eq!(found, expected);
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
