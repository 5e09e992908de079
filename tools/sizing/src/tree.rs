//! A graded size as an octree.

use crate::field::{Cells, Folded};
use glam::DVec3;
use std::rc::Rc;

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

/// The same where a cube is beyond the border of a size field, in some part: there a body stands out of it by what chords cut off, or
/// lengths grow. A choice: the border of a field is mostly that of the body, where a tree for a quarter would have ten times the leaves.
const ALIKE_BEYOND: f64 = 2.0;

/// A cube is not divided further for a size field once it is this part of the least length in it: no element is there that the
/// difference would matter to. In a field on elements without flat ones, and limited by a gradation of 1.5, leaves are about as wide as
/// elements; this ends it in flat ones, where lengths may change as fast as they like.
const FINEST: f64 = 0.25;

/// Nodes, at most, which take a quarter of a gigabyte. More than one for each element are rare, so that what is beyond would have as many
/// elements.
const MOST: usize = 1 << 24;

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
    pub fn new(sources: &[Source], growth: f64, most: f64, ends: [DVec3; 2]) -> Self {
        let cube = cube(ends);
        // Without a field there is no limit.
        Self::with_field(sources, growth, most, cube, None).unwrap_or(Self {
            origin: cube.0,
            width: cube.1,
            nodes: vec![Node::leaf(most)],
        })
    }

    /// The same beside a size field, folded into units of the cube of this origin and width (see [`cube`]). In leaves that the field
    /// decides there is the middle of its range in them. `None` where that takes too many nodes.
    pub fn with_field(
        sources: &[Source],
        growth: f64,
        most: f64,
        (origin, width): (DVec3, f64),
        field: Option<&Folded>,
    ) -> Option<Self> {
        let mut graded = Self {
            origin,
            width,
            nodes: vec![Node::leaf(most)],
        };
        let builder = Builder {
            sources,
            growth,
            most,
        };
        let mut cells = field.map(|field| Cells::new(field, growth));
        let all: Vec<u32> = (0..sources.len() as u32).collect();
        let listed = cells.as_ref().map(Cells::all).unwrap_or_default();
        // Nodes with what matters there; corners in units of the cube.
        let mut open = vec![(0, DVec3::ZERO, 1.0, 0, Rc::new(all), listed)];
        while let Some((node, corner, part, depth, known, mut listed)) = open.pop() {
            let (range, kept) = builder.range(origin + corner * width, part * width, &known);
            let mut is_done = range[1] <= ALIKE * range[0];
            let mut size = range[0];
            if field.is_some_and(|field| !field.meets(corner, part)) {
                // Nobody asks there.
                is_done = true;
            } else if let Some(cells) = &mut cells {
                let cube = (corner, part);
                let is_much = cells.narrow(cube, &mut listed);
                is_done = false;
                if !is_much || depth == DEPTH {
                    let (seen, kept) = cells.see(cube, &listed, range[1] / width);
                    let least = range[0].min(seen.least * width);
                    let [within, beyond] = [seen.within, seen.beyond].map(|x| x * width);
                    is_done = range[1].min(within) <= ALIKE * least
                        || beyond <= ALIKE_BEYOND * least
                        || part * width <= FINEST * least;
                    size = size.min(seen.middle * width);
                    listed = kept;
                }
            }
            if is_done || depth == DEPTH {
                graded.nodes[node].size = size;
                continue;
            }
            let first = graded.nodes.len();
            if cells.is_some() && first > MOST {
                return None;
            }
            graded.nodes[node].first = first as u32;
            graded.nodes.extend([Node::leaf(most); 8]);
            let half = 0.5 * part;
            let kept = Rc::new(kept);
            let cells = cells.as_ref();
            let listed = cells.map(|cells| cells.divided((corner, part), &listed));
            for (child, listed) in listed.unwrap_or_default().into_iter().enumerate() {
                let bits = [1, 2, 4].map(|bit| if child & bit == 0 { 0.0 } else { half });
                let corner = corner + DVec3::from_array(bits);
                let kept = Rc::clone(&kept);
                open.push((first + child, corner, half, depth + 1, kept, listed));
            }
        }
        Some(graded)
    }

    /// Its leaves: least coordinates, width and size of each, model units.
    pub fn leaves(&self) -> Vec<(DVec3, f64, f64)> {
        let mut leaves = Vec::new();
        let mut open = vec![(0, self.origin, self.width)];
        while let Some((node, corner, width)) = open.pop() {
            let Node { size, first } = self.nodes[node as usize];
            if first == 0 {
                leaves.push((corner, width, size));
                continue;
            }
            for child in 0..8 {
                let bits = [1, 2, 4].map(|bit| if child & bit == 0 { 0.0 } else { 0.5 * width });
                let corner = corner + DVec3::from_array(bits);
                open.push((first + child, corner, 0.5 * width));
            }
        }
        leaves
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

/// The cube about points, given by their least and largest coordinates: its origin and width, model units.
pub fn cube([low, high]: [DVec3; 2]) -> (DVec3, f64) {
    (low, (high - low).max_element())
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
