//! A tree of bounding boxes over triangles, for rays along an axis and for pairs that may meet.

use crate::edges::orientation;
use glam::DVec3;
use robust::{Coord, orient2d};

/// Triangles in a leaf, at most.
const LEAF: usize = 8;

/// Marks a node whose triangles belong to more than one group.
const MIXED: u32 = u32::MAX;

/// Axis-aligned bounding boxes over a triangle list, split at medians: depth is logarithmic whatever
/// the input. Building takes O(n log n).
pub struct Tree<'a> {
    vertices: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    items: Vec<u32>,
    nodes: Vec<Node>,
    /// Boxes this near to each other count as meeting.
    margin: DVec3,
}

#[derive(Clone, Copy)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// Range in `items`.
    begin: u32,
    end: u32,
    /// Left child, the right one follows it; 0 for a leaf.
    children: u32,
    group: u32,
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

impl<'a> Tree<'a> {
    /// Builds the tree. `group` labels triangles for [`Tree::pairs`].
    pub fn new(
        vertices: &'a [DVec3],
        triangles: &'a [[u32; 3]],
        group: impl Fn(u32) -> u32,
    ) -> Self {
        let mut tree = Self {
            vertices,
            triangles,
            items: (0..triangles.len() as u32).collect(),
            nodes: Vec::with_capacity(triangles.len() / LEAF * 4 + 1),
            margin: DVec3::ZERO,
        };
        let centres: Vec<DVec3> = (0..triangles.len())
            .map(|t| {
                let [a, b, c] = tree.corners(t as u32);
                a.min(b).min(c) + a.max(b).max(c)
            })
            .collect();
        let root = tree.node(0, triangles.len());
        tree.nodes.push(root);
        let mut next = 0;
        while next < tree.nodes.len() {
            let Node { begin, end, .. } = tree.nodes[next];
            let range = begin as usize..end as usize;
            if range.len() > LEAF {
                let items = &mut tree.items[range.clone()];
                let (low, high) =
                    items
                        .iter()
                        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &t| {
                            let c = centres[t as usize];
                            (low.min(c), high.max(c))
                        });
                let axis = longest_axis(high - low);
                let half = items.len() / 2;
                items.select_nth_unstable_by(half, |&s, &t| {
                    let (p, q) = (centres[s as usize][axis], centres[t as usize][axis]);
                    p.total_cmp(&q).then(s.cmp(&t))
                });
                tree.nodes[next].children = tree.nodes.len() as u32;
                let middle = range.start + half;
                let (left, right) = (tree.node(range.start, middle), tree.node(middle, range.end));
                tree.nodes.extend([left, right]);
            }
            next += 1;
        }
        // Children come after their parents.
        for i in (0..tree.nodes.len()).rev() {
            let node = tree.nodes[i];
            tree.nodes[i].group = if node.children == 0 {
                let mut groups = tree.items[node.begin as usize..node.end as usize]
                    .iter()
                    .map(|&t| group(t));
                let first = groups.next().unwrap_or(MIXED);
                if groups.all(|g| g == first) {
                    first
                } else {
                    MIXED
                }
            } else {
                let [l, r] = [0, 1].map(|k| tree.nodes[(node.children + k) as usize].group);
                if l == r { l } else { MIXED }
            };
        }
        tree
    }

    /// The same tree where boxes count as meeting that are up to `margin` apart.
    pub fn with_margin(mut self, margin: f64) -> Self {
        self.margin = DVec3::splat(margin);
        self
    }

    fn node(&self, begin: usize, end: usize) -> Node {
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for &t in &self.items[begin..end] {
            for p in self.corners(t) {
                low = low.min(p);
                high = high.max(p);
            }
        }
        Node {
            low,
            high,
            begin: begin as u32,
            end: end as u32,
            children: 0,
            group: MIXED,
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

    /// All triangles in a direction, nearest first. See [`Tree::nearest`].
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
        let slack = rounding(from, hit.distance);
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

    /// Calls `found` for every triangle the ray meets; it returns the distance beyond which hits are
    /// of no interest.
    fn each_hit(
        &self,
        from: DVec3,
        along: Direction,
        wanted: impl Fn(u32) -> bool,
        mut found: impl FnMut(Met) -> f64,
    ) {
        if self.triangles.is_empty() {
            return;
        }
        let p = along.view(from);
        let mut limit = f64::INFINITY;
        let mut stack = vec![0_u32];
        while let Some(i) = stack.pop() {
            let node = &self.nodes[i as usize];
            let (u, v) = (along.view(node.low), along.view(node.high));
            let (low, high) = (u.min(v), u.max(v));
            let beside = p.y < low.y || p.y > high.y || p.z < low.z || p.z > high.z;
            if beside || high.x < p.x || low.x - p.x > limit + rounding(p, limit) {
                continue;
            }
            if node.children != 0 {
                // The child that begins nearer is looked at first.
                let near = |k: u32| {
                    let n = &self.nodes[(node.children + k) as usize];
                    along.view(n.low).x.min(along.view(n.high).x)
                };
                let (first, second) = if near(0) <= near(1) { (0, 1) } else { (1, 0) };
                stack.extend([node.children + second, node.children + first]);
                continue;
            }
            for &t in &self.items[node.begin as usize..node.end as usize] {
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
            }
        }
    }

    /// Calls `visit` for all pairs of triangles of different groups whose boxes meet, until it
    /// returns false.
    pub fn pairs(&self, group: impl Fn(u32) -> u32, mut visit: impl FnMut(u32, u32) -> bool) {
        if self.triangles.is_empty() {
            return;
        }
        let boxes = self.leaf_boxes();
        let mut stack = vec![(0_u32, 0_u32)];
        while let Some((i, j)) = stack.pop() {
            let (m, n) = (&self.nodes[i as usize], &self.nodes[j as usize]);
            let apart =
                m.low.cmpgt(n.high + self.margin).any() || n.low.cmpgt(m.high + self.margin).any();
            if apart || (m.group == n.group && m.group != MIXED) {
                continue;
            }
            let (l, r) = (m.children, m.children + 1);
            if i == j && m.children != 0 {
                stack.extend([(l, r), (r, r), (l, l)]);
                continue;
            }
            let larger = m.end - m.begin >= n.end - n.begin;
            if m.children != 0 && (larger || n.children == 0) {
                stack.extend([(r, j), (l, j)]);
            } else if n.children != 0 {
                stack.extend([(i, n.children + 1), (i, n.children)]);
            } else {
                let (mine, theirs) = (boxes.of(i), boxes.of(j));
                let mut some = mine.near(&self.span(n.low, n.high));
                while some != 0 {
                    let at = some.trailing_zeros();
                    some &= some - 1;
                    let s = self.items[(m.begin + at) as usize];
                    let mut near = theirs.near(&mine.span(at as usize));
                    if i == j {
                        near &= !1 << at;
                    }
                    while near != 0 {
                        let t = self.items[(n.begin + near.trailing_zeros()) as usize];
                        near &= near - 1;
                        if group(s) != group(t) && self.boxes_meet(s, t) && !visit(s, t) {
                            return;
                        }
                    }
                }
            }
        }
    }

    /// The boxes of the triangles in each leaf.
    fn leaf_boxes(&self) -> LeafBoxes {
        let mut boxes = LeafBoxes {
            of_node: vec![0; self.nodes.len()],
            blocks: Vec::with_capacity(self.nodes.len() / 2 + 1),
        };
        for (i, node) in self.nodes.iter().enumerate() {
            if node.children != 0 {
                continue;
            }
            boxes.of_node[i] = boxes.blocks.len() as u32;
            let mut block = Block::default();
            for at in node.begin..node.end {
                let [a, b, c] = self.corners(self.items[at as usize]);
                let span = self.span(a.min(b).min(c), a.max(b).max(c));
                block.set((at - node.begin) as usize, &span);
            }
            boxes.blocks.push(block);
        }
        boxes
    }

    /// A box in single precision, no smaller than it is, with the margin.
    fn span(&self, low: DVec3, high: DVec3) -> Span {
        let high = high + self.margin;
        Span {
            low: low.to_array().map(|x| {
                let y = x as f32;
                if f64::from(y) > x { y.next_down() } else { y }
            }),
            high: high.to_array().map(|x| {
                let y = x as f32;
                if f64::from(y) < x { y.next_up() } else { y }
            }),
        }
    }

    fn boxes_meet(&self, s: u32, t: u32) -> bool {
        let bounds = |[a, b, c]: [DVec3; 3]| (a.min(b).min(c), a.max(b).max(c));
        let ((a, b), (c, d)) = (bounds(self.corners(s)), bounds(self.corners(t)));
        !(a.cmpgt(d + self.margin).any() || c.cmpgt(b + self.margin).any())
    }
}

/// A box in single precision; its upper end has the margin in it.
struct Span {
    low: [f32; 3],
    high: [f32; 3],
}

/// The boxes of a leaf's triangles, to be compared with another box all at once.
struct Block {
    low: [[f32; LEAF]; 3],
    high: [[f32; LEAF]; 3],
}

impl Default for Block {
    /// No boxes: what is no number is near to nothing.
    fn default() -> Self {
        Self {
            low: [[f32::NAN; LEAF]; 3],
            high: [[f32::NAN; LEAF]; 3],
        }
    }
}

impl Block {
    fn set(&mut self, at: usize, span: &Span) {
        for k in 0..3 {
            self.low[k][at] = span.low[k];
            self.high[k][at] = span.high[k];
        }
    }

    fn span(&self, at: usize) -> Span {
        Span {
            low: self.low.map(|x| x[at]),
            high: self.high.map(|x| x[at]),
        }
    }

    /// Which of the boxes may meet this one, a bit each.
    fn near(&self, span: &Span) -> u32 {
        let mut near = [u32::MAX; LEAF];
        for k in 0..3 {
            for (i, near) in near.iter_mut().enumerate() {
                let meets = (self.low[k][i] <= span.high[k]) & (self.high[k][i] >= span.low[k]);
                *near &= u32::from(meets).wrapping_neg();
            }
        }
        (near.iter().enumerate()).fold(0, |bits, (i, near)| bits | (near & (1 << i)))
    }
}

/// The blocks of a tree's leaves.
struct LeafBoxes {
    /// Block of each node; 0 where it is no leaf.
    of_node: Vec<u32>,
    blocks: Vec<Block>,
}

impl LeafBoxes {
    fn of(&self, node: u32) -> &Block {
        &self.blocks[self.of_node[node as usize] as usize]
    }
}

fn longest_axis(d: DVec3) -> usize {
    if d.x >= d.y && d.x >= d.z {
        0
    } else if d.y >= d.z {
        1
    } else {
        2
    }
}

/// Rounding to expect of a distance from `p`.
fn rounding(p: DVec3, distance: f64) -> f64 {
    1e-12 * (p.abs().max_element() + distance)
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
        let tree = Tree::new(&vertices, &triangles, |_| 0);
        for along in Direction::ALL {
            for from in [
                DVec3::splat(4.0),
                DVec3::new(4.0, 4.25, 4.0),
                DVec3::new(4.125, 4.25, 4.0),
            ] {
                // Inside the middle one: seen from the back, then one more octahedron.
                let Met::Hit(hit) = tree.nearest(from, along, |_| true) else {
                    panic!("no hit from {from} along {along:?}");
                };
                assert!(!hit.front);
                assert_eq!(hit.triangle / 8, 13);
                let fronts: Vec<bool> = tree
                    .all(from, along, |_| true)
                    .iter()
                    .map(|h| h.front)
                    .collect();
                assert_eq!(fronts, [false, true, false]);
            }
        }
        let outside = DVec3::new(-4.0, 4.0, 4.0);
        let count = |along| tree.all(outside, along, |_| true).len();
        assert_eq!(count(Direction::ALL[0]), 6);
        assert_eq!(count(Direction::ALL[1]), 0);
        let on = DVec3::new(0.5, 0.25, 0.25);
        assert!(matches!(
            tree.nearest(on, Direction::ALL[0], |_| true),
            Met::Touches(_)
        ));
    }

    #[test]
    fn pairs_are_those_of_an_exhaustive_search() {
        let (vertices, triangles) = octahedra(2);
        let group = |t: u32| t / 16;
        let tree = Tree::new(&vertices, &triangles, group);
        let mut found = Vec::new();
        tree.pairs(group, |s, t| {
            found.push((s.min(t), s.max(t)));
            true
        });
        assert!(found.is_empty());
        let group = |t: u32| t;
        let tree = Tree::new(&vertices, &triangles, group);
        tree.pairs(group, |s, t| {
            found.push((s.min(t), s.max(t)));
            true
        });
        found.sort_unstable();
        let mut wanted = Vec::new();
        for s in 0..triangles.len() as u32 {
            wanted.extend(
                (s + 1..triangles.len() as u32)
                    .filter_map(|t| tree.boxes_meet(s, t).then_some((s, t))),
            );
        }
        assert_eq!(found, wanted);
    }
}
