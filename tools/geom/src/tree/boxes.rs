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

    /// A node with this box alone.
    pub fn node(&self) -> Node {
        let mut node = Node::EMPTY;
        let bin = Bin::EMPTY.with(self);
        node.set(0, &Range::of(bin, 0, 0), LEAF);
        node
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
        Self::of(Bin::of(&items[first..first + count]), first, depth)
    }

    fn of(bin: Bin, first: usize, depth: usize) -> Self {
        Self {
            first,
            count: bin.count,
            depth,
            bounds: bin.bounds,
            margin: bin.margin,
        }
    }
}

/// Some items.
#[derive(Clone, Copy)]
struct Bin {
    count: usize,
    bounds: Outer,
    margin: f32,
}

impl Bin {
    const EMPTY: Self = Self {
        count: 0,
        bounds: Outer::EMPTY,
        margin: 0.0,
    };

    fn of(items: &[Item]) -> Self {
        items.iter().fold(Self::EMPTY, Self::with)
    }

    fn with(self, item: &Item) -> Self {
        self.and(Self {
            count: 1,
            bounds: item.bounds,
            margin: item.margin,
        })
    }

    fn and(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            bounds: self.bounds.union(other.bounds),
            margin: self.margin.max(other.margin),
        }
    }

    /// What all its items together add to the cost of a search.
    fn cost(&self) -> f32 {
        self.bounds.half_area() * self.count as f32
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
            let [left, right] = split(items, parts[widest]);
            parts[widest] = left;
            parts.insert(widest + 1, right);
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

/// Partitions a range of two or more into two that are not empty.
fn split(items: &mut [Item], range: Range) -> [Range; 2] {
    let all = &mut items[range.first..range.first + range.count];
    let [left, right] = match split_by_cost(all, range.depth) {
        Some(parts) => parts,
        None => {
            let (left, right) = all.split_at(all.len() / 2);
            [Bin::of(left), Bin::of(right)]
        }
    };
    let depth = range.depth + 1;
    [
        Range::of(left, range.first, depth),
        Range::of(right, range.first + left.count, depth),
    ]
}

/// Partitions items where that costs searches least or, if none of the places looked at is one, into halves; none where
/// all middles are the same.
fn split_by_cost(items: &mut [Item], depth: usize) -> Option<[Bin; 2]> {
    let middles = items.iter().fold(Outer::EMPTY, |b, i| b.with(i.middle()));
    let extent = middles.high - middles.low;
    let axis = (0..3).fold(0, |m, i| if extent[i] > extent[m] { i } else { m });
    if extent[axis] <= 0.0 {
        return None;
    }
    let low = middles.low[axis];
    // No more bins than items.
    let count = BINS.min(items.len());
    let scale = count as f32 / extent[axis];
    let bin = |i: &Item| (((i.middle()[axis] - low) * scale) as usize).min(count - 1);
    let place = match depth {
        HALVING_DEPTH.. => None,
        _ => {
            let mut bins = [Bin::EMPTY; BINS];
            for item in items.iter() {
                let b = &mut bins[bin(item)];
                *b = b.with(item);
            }
            cheapest(&bins[..count])
        }
    };
    let Some((place, parts)) = place else {
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |a, b| {
            a.middle()[axis]
                .total_cmp(&b.middle()[axis])
                .then(a.index.cmp(&b.index))
        });
        let (left, right) = items.split_at(half);
        return Some([Bin::of(left), Bin::of(right)]);
    };
    let mut left = 0;
    for i in 0..items.len() {
        if bin(&items[i]) < place {
            items.swap(left, i);
            left += 1;
        }
    }
    Some(parts)
}

/// The first bin of the right part where that is best, with both parts; neither is empty.
fn cheapest(bins: &[Bin]) -> Option<(usize, [Bin; 2])> {
    let mut rights = [Bin::EMPTY; BINS];
    let mut right = Bin::EMPTY;
    for i in (1..bins.len()).rev() {
        right = right.and(bins[i]);
        rights[i] = right;
    }
    let mut left = Bin::EMPTY;
    let mut best: Option<(f32, usize, [Bin; 2])> = None;
    for i in 1..bins.len() {
        left = left.and(bins[i - 1]);
        let cost = left.cost() + rights[i].cost();
        if left.count > 0 && rights[i].count > 0 && best.is_none_or(|b| cost < b.0) {
            best = Some((cost, i, [left, rights[i]]));
        }
    }
    best.map(|(_, place, parts)| (place, parts))
}
