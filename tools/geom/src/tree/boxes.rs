//! The hierarchy of boxes.

use arrayvec::ArrayVec;
use glam::{DVec3, Vec3A};

/// Children of a node: as many as fit into one vector instruction of single-precision numbers.
pub const WIDTH: usize = 4;
/// Bins per split. More of them find hardly better splits, and take more time.
const BINS: usize = 12;
/// Depth in splits from which ranges are halved: a balanced hierarchy of all boxes that can be numbered is as deep, and
/// halving adds no more than that again.
const HALVING_DEPTH: usize = u32::BITS as usize;
/// Entries of a traversal stack: a level of the hierarchy takes one and adds its children, and is a split at least.
pub const STACK: usize = 1 + (WIDTH - 1) * 2 * HALVING_DEPTH;
/// Marks a child that is a leaf.
pub const LEAF: u32 = 1 << 31;

/// Boxes in a hierarchy.
pub struct Boxes {
    /// The root first, children after their parents.
    pub nodes: Vec<Node>,
    /// What the caller numbered each leaf's box.
    pub index: Vec<u32>,
}

/// Boxes of the children, coordinate by coordinate; an empty slot has an inverted box.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Node {
    pub low: [[f32; WIDTH]; 3],
    pub high: [[f32; WIDTH]; 3],
    /// The largest margin around what is in each box, beyond the box.
    pub margin: [f32; WIDTH],
    /// Index of a node, or of a leaf with [`LEAF`] set.
    pub child: [u32; WIDTH],
}

impl Node {
    const EMPTY: Self = Self {
        low: [[f32::INFINITY; WIDTH]; 3],
        high: [[f32::NEG_INFINITY; WIDTH]; 3],
        margin: [0.0; WIDTH],
        child: [0; WIDTH],
    };

    /// Squared distances of a point from the boxes; each coordinate's gap is shortened by `margin`.
    #[inline]
    pub fn distances_squared(&self, p: [f32; 3], margin: f32) -> [f32; WIDTH] {
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

    fn set(&mut self, slot: usize, range: &Range, child: u32) {
        for k in 0..3 {
            self.low[k][slot] = range.bounds.low[k];
            self.high[k][slot] = range.bounds.high[k];
        }
        self.margin[slot] = range.margin;
        self.child[slot] = child;
    }
}

/// A box.
#[derive(Clone, Copy)]
pub struct Bounds {
    pub low: DVec3,
    pub high: DVec3,
}

impl Bounds {
    pub const EMPTY: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
    };

    pub fn with(self, p: DVec3) -> Self {
        Self {
            low: self.low.min(p),
            high: self.high.max(p),
        }
    }

    /// The box of points.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, &p| b.with(p))
    }

}

/// A box around another one, in single precision, in which a hierarchy is built: unions are vector instructions, and
/// exact.
#[derive(Clone, Copy)]
struct Outer {
    low: Vec3A,
    high: Vec3A,
}

impl Outer {
    const EMPTY: Self = Self {
        low: Vec3A::INFINITY,
        high: Vec3A::NEG_INFINITY,
    };

    fn of(bounds: Bounds) -> Self {
        let down = |x: f64| {
            let y = x as f32;
            if f64::from(y) > x { y.next_down() } else { y }
        };
        Self {
            low: Vec3A::from_array(bounds.low.to_array().map(down)),
            high: Vec3A::from_array(bounds.high.to_array().map(up)),
        }
    }

    fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    fn with(self, p: Vec3A) -> Self {
        Self {
            low: self.low.min(p),
            high: self.high.max(p),
        }
    }

    fn half_area(&self) -> f32 {
        let e = (self.high - self.low).max(Vec3A::ZERO);
        e.dot(Vec3A::new(e.y, e.z, e.x))
    }
}

/// A number in single precision that is not smaller.
fn up(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) < x { y.next_up() } else { y }
}

/// A box to be put into a hierarchy.
#[derive(Clone, Copy)]
pub struct Item {
    bounds: Outer,
    /// How far beyond the box something still belongs to it.
    margin: f32,
    index: u32,
}

impl Item {
    /// A box with its number.
    pub fn new(bounds: Bounds, index: u32) -> Self {
        Self::with_margin(bounds, 0.0, index)
    }

    /// A box with a margin around it.
    pub fn with_margin(bounds: Bounds, margin: f64, index: u32) -> Self {
        Self {
            bounds: Outer::of(bounds),
            margin: up(margin),
            index,
        }
    }

    /// Twice the middle of the box.
    fn middle(&self) -> Vec3A {
        self.bounds.low + self.bounds.high
    }
}

/// A run of items, with its box and its depth in halvings.
#[derive(Clone, Copy)]
struct Range {
    first: usize,
    count: usize,
    depth: usize,
    bounds: Outer,
    margin: f32,
}

impl Range {
    fn new(items: &[Item], first: usize, count: usize, depth: usize) -> Self {
        let items = &items[first..first + count];
        let bounds = (items.iter()).fold(Outer::EMPTY, |b, i| b.union(i.bounds));
        Self {
            first,
            count,
            depth,
            bounds,
            margin: items.iter().map(|i| i.margin).fold(0.0, f32::max),
        }
    }
}

impl Boxes {
    /// Builds the hierarchy over fewer than 2^31 boxes. Time n log n.
    pub fn new(mut items: Vec<Item>) -> Self {
        let nodes = build(&mut items);
        Self {
            nodes,
            index: items.iter().map(|i| i.index).collect(),
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
                node.set(slot, part, LEAF | part.first as u32);
            } else {
                node.set(slot, part, 0);
                work.push((*part, Some((at, slot))));
            }
        }
        nodes.push(node);
    }
    nodes
}

/// Partitions a range of two or more; returns the size of its left part, neither zero nor all.
fn split(range: &mut [Item], depth: usize) -> usize {
    let middles = range.iter().fold(Outer::EMPTY, |b, i| b.with(i.middle()));
    let extent = middles.high - middles.low;
    let axis = (0..3).fold(0, |m, i| if extent[i] > extent[m] { i } else { m });
    let half = range.len() / 2;
    if extent[axis] <= 0.0 {
        return half;
    }
    let halve = |range: &mut [Item]| {
        range.select_nth_unstable_by(half, |a, b| {
            a.middle()[axis]
                .total_cmp(&b.middle()[axis])
                .then(a.index.cmp(&b.index))
        });
        half
    };
    if depth >= HALVING_DEPTH {
        return halve(range);
    }
    let scale = BINS as f32 / extent[axis];
    let bin = |i: &Item| (((i.middle()[axis] - middles.low[axis]) * scale) as usize).min(BINS - 1);
    let mut bins = [(Outer::EMPTY, 0_usize); BINS];
    for item in range.iter() {
        let b = &mut bins[bin(item)];
        *b = (b.0.union(item.bounds), b.1 + 1);
    }
    let mut right = [0.0_f32; BINS];
    let (mut bounds, mut count) = (Outer::EMPTY, 0);
    for i in (1..BINS).rev() {
        bounds = bounds.union(bins[i].0);
        count += bins[i].1;
        right[i] = bounds.half_area() * count as f32;
    }
    let (mut bounds, mut count) = (Outer::EMPTY, 0);
    let mut best = (f32::INFINITY, 0);
    for i in 1..BINS {
        bounds = bounds.union(bins[i - 1].0);
        count += bins[i - 1].1;
        let cost = bounds.half_area() * count as f32 + right[i];
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
