//! A graded size as an octree.

use glam::DVec3;

/// A box in which elements are to have a size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source {
    /// Least and largest coordinates, model units.
    pub ends: [DVec3; 2],
    /// Edge length wanted in it, model units, above zero.
    pub size: f64,
}

/// Largest size in a leaf over the smallest one there, but for what is deeper than [`DEPTH`]. A choice: the volumes of elements of one size
/// differ by far more, and a tree for a tenth would be ten times as large.
const ALIKE: f64 = 1.25;

/// Halvings of the body, at most: a leaf is then as small as what rounding of single precision leaves of it.
const DEPTH: u32 = f32::MANTISSA_DIGITS;

/// A node of an octree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Size in a leaf; what it is in other nodes means nothing.
    pub size: f64,
    /// The first of eight children, which follow each other, x first, then y; 0 for a leaf.
    pub first: u32,
}

/// The size of elements at each point: that of the sources, growing with the distance from them at a bounded rate.
///
/// Sizes limited by their gradient as by Persson ("Mesh size functions for implicit geometries and PDE-based gradient limiting",
/// 2006), whose solution for single sources is the least of all cones over them; stored in leaves that have the least value
/// in them, which the largest exceeds by a quarter at most.
#[derive(Clone, Debug, PartialEq)]
pub struct Graded {
    /// Least coordinates of the cube, model units.
    pub origin: DVec3,
    /// Its width, model units.
    pub width: f64,
    /// Nodes, the root first.
    pub nodes: Vec<Node>,
}

impl Graded {
    /// Sizes in a cube about points (their least and largest coordinates) that grow by `growth` of the distance from sources. Sizes are
    /// `most` at most. As long as the sum over all levels of the sources that matter in a node.
    pub fn new(sources: &[Source], growth: f64, most: f64, [low, high]: [DVec3; 2]) -> Self {
        let mut graded = Self {
            origin: low,
            width: (high - low).max_element(),
            nodes: vec![Node::leaf(most)],
        };
        let all: Vec<u32> = (0..sources.len() as u32).collect();
        let builder = Builder {
            sources,
            growth,
            most,
        };
        // Nodes with the sources that matter there.
        let mut open = vec![(0, low, graded.width, 0, all)];
        while let Some((node, corner, width, depth, known)) = open.pop() {
            let (range, kept) = builder.range(corner, width, &known);
            if range[1] <= ALIKE * range[0] || depth == DEPTH {
                graded.nodes[node].size = range[0];
                continue;
            }
            let first = graded.nodes.len();
            graded.nodes[node].first = first as u32;
            graded.nodes.extend([Node::leaf(most); 8]);
            let half = 0.5 * width;
            for child in 0..8 {
                let bits = [1, 2, 4].map(|bit| if child & bit == 0 { 0.0 } else { half });
                let corner = corner + DVec3::from_array(bits);
                open.push((first + child, corner, half, depth + 1, kept.clone()));
            }
        }
        graded
    }

    /// The same in another unit of length.
    #[must_use]
    pub fn scaled(&self, scale: f64) -> Self {
        let node = |node: &Node| Node {
            size: node.size * scale,
            ..*node
        };
        Self {
            origin: self.origin * scale,
            width: self.width * scale,
            nodes: self.nodes.iter().map(node).collect(),
        }
    }

    /// Edge length wanted at a point, model units; outside of the cube that of the nearest place in it.
    pub fn at(&self, p: DVec3) -> f64 {
        let mut at = (p - self.origin) / self.width;
        let mut node = self.nodes[0];
        while node.first != 0 {
            let mut child = node.first;
            for (axis, bit) in [1, 2, 4].into_iter().enumerate() {
                at[axis] *= 2.0;
                if at[axis] >= 1.0 {
                    at[axis] -= 1.0;
                    child += bit;
                }
            }
            node = self.nodes[child as usize];
        }
        node.size
    }
}

impl Node {
    fn leaf(size: f64) -> Self {
        Self { size, first: 0 }
    }
}

/// What a tree is made from.
struct Builder<'a> {
    sources: &'a [Source],
    growth: f64,
    most: f64,
}

impl Builder<'_> {
    /// The least and the largest size in a cube, and the sources that matter there.
    fn range(&self, corner: DVec3, width: f64, known: &[u32]) -> ([f64; 2], Vec<u32>) {
        let far = corner + width;
        let sizes = |source: &Source| {
            let [low, high] = source.ends;
            let near = (low - far).max(corner - high).max(DVec3::ZERO);
            // The farthest corner of the cube.
            let farthest = (low - corner).max(far - high).max(DVec3::ZERO);
            [near, farthest].map(|d| source.size + self.growth * d.length())
        };
        let (mut least, mut largest) = (self.most, self.most);
        let each = known.iter().map(|&s| {
            let [near, far] = sizes(&self.sources[s as usize]);
            least = least.min(near);
            largest = largest.min(far);
            (s, near)
        });
        let each: Vec<(u32, f64)> = each.collect();
        let kept = each.into_iter().filter(|&(_, near)| near <= largest);
        let kept = kept.map(|(s, _)| s).collect();
        ([least, largest], kept)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_grow_from_their_sources() {
        let source = |x: f64, size: f64| Source {
            ends: [DVec3::new(x, 0.0, 0.0), DVec3::new(x, 1.0, 1.0)],
            size,
        };
        let sources = [source(0.0, 0.01), source(1.0, 0.1)];
        let ends = [DVec3::ZERO, DVec3::new(1.0, 1.0, 1.0)];
        let graded = Graded::new(&sources, 0.5, 0.2, ends);
        for i in 0..=50 {
            let x = f64::from(i) / 50.0;
            let exact = (0.01 + 0.5 * x).min(0.1 + 0.5 * (1.0 - x)).min(0.2);
            let found = graded.at(DVec3::new(x, 0.37, 0.7));
            assert!(
                (found / exact).ln().abs() <= ALIKE.ln(),
                "{x}: {found} {exact}"
            );
        }
        // Beside the cube it goes on.
        assert!(graded.at(DVec3::new(-3.0, 0.0, 2.0)) < 0.02);
        // Nothing is asked for.
        let none = Graded::new(&[], 0.5, f64::INFINITY, ends);
        assert_eq!((none.at(DVec3::ONE), none.nodes.len()), (f64::INFINITY, 1));
    }
}
