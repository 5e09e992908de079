//! Pairs of boxes that meet.

use super::boxes::{Bounds, Boxes, Item, LEAF, Node, WIDTH};
use super::placement::Placement;
use glam::DVec3;

/// Marks boxes of more than one group.
const MIXED: u32 = u32::MAX;

/// Pairs that are visited at most, per box: a choice. Boxes of real surfaces meet some ten others. A fan of `n` triangles
/// around a point has `n / 2` pairs for each, so that those of up to 4000 triangles are searched to the end, and
/// a search through triangles that all lie over each other ends after minutes instead of hours for a million of them
/// (130 ns for each pair of crossing triangles).
const PAIRS_EACH: u64 = 2000;

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// All pairs were looked at, or the caller had seen enough.
    Done,
    /// There are far more pairs with meeting boxes than boxes; the rest was not looked at.
    GaveUp,
}

/// Calls `visit` for all pairs of boxes of different groups that meet, each given by its lowest and highest
/// coordinates, until it returns false; and for some pairs that nearly meet, by single precision about the size of
/// all. The order of the pairs is the same in every run. O(n log n) where few boxes meet; the number of pairs is bounded
/// by a multiple of the number of boxes.
pub fn pairs(
    boxes: impl Iterator<Item = [DVec3; 2]>,
    group: impl Fn(u32) -> u32,
    mut visit: impl FnMut(u32, u32) -> bool,
) -> Search {
    let mut bounds: Vec<Bounds> = boxes.map(|[low, high]| Bounds { low, high }).collect();
    let is_of_first = |i| group(i) != MIXED && group(i) == group(0);
    if (0..bounds.len() as u32).all(is_of_first) {
        return Search::Done;
    }
    let all = Bounds::of(bounds.iter().flat_map(|b| [&b.low, &b.high]));
    let placement = Placement::of(all);
    for b in &mut bounds {
        b.low = placement.inside(b.low);
        b.high = placement.inside(b.high);
    }
    let items = (0..).zip(&bounds).map(|(i, b)| Item::new(*b, i)).collect();
    let mut left = PAIRS_EACH * bounds.len() as u64;
    drop(bounds);
    let boxes = Boxes::new(items);
    let mut end = Search::Done;
    let mut walk = Walk {
        groups: groups(&boxes, group),
        boxes: &boxes,
        open: Vec::new(),
        visit: |s, t| {
            if left == 0 {
                end = Search::GaveUp;
                return false;
            }
            left -= 1;
            visit(s, t)
        },
    };
    if !boxes.nodes.is_empty() {
        walk.run();
    }
    end
}

/// The boxes that are chosen and those that meet a chosen one, in order; some that nearly meet one may be among them, and
/// all others where most are chosen.
/// O(n log m) for m chosen ones where few boxes meet.
pub fn with_neighbours(boxes: &[[DVec3; 2]], is_chosen: impl Fn(u32) -> bool) -> Vec<u32> {
    let numbers = || 0..boxes.len() as u32;
    // Then hardly any are left out, and the search for them takes longer than what they take.
    if 2 * numbers().filter(|&i| is_chosen(i)).count() > boxes.len() {
        return numbers().collect();
    }
    let all = Bounds::of(boxes.iter().flatten());
    let placement = Placement::of(all);
    let item = |i: u32| {
        let [low, high] = boxes[i as usize].map(|p| placement.inside(p));
        Item::new(Bounds { low, high }, i)
    };
    let chosen = Boxes::new(numbers().filter(|&i| is_chosen(i)).map(item).collect());
    let mut open = Vec::new();
    let kept = numbers().filter(|&i| is_chosen(i) || chosen.meet_any(&item(i), &mut open));
    kept.collect()
}

/// A box by the node that has it and its place there.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Slot {
    node: u32,
    place: u32,
}

/// Group of the boxes below each child, or [`MIXED`].
fn groups(boxes: &Boxes, group: impl Fn(u32) -> u32) -> Vec<[u32; WIDTH]> {
    let mut groups = vec![[MIXED; WIDTH]; boxes.nodes.len()];
    // Children come after their parents.
    for (n, node) in boxes.nodes.iter().enumerate().rev() {
        for place in 0..WIDTH {
            if !node.is_filled(place) {
                continue;
            }
            let child = node.child[place];
            groups[n][place] = if child & LEAF != 0 {
                group(boxes.index[(child & !LEAF) as usize])
            } else {
                let below = &boxes.nodes[child as usize];
                let filled = (0..WIDTH).filter(|&p| below.is_filled(p));
                let mut of = filled.map(|p| groups[child as usize][p]);
                let first = of.next().unwrap_or(MIXED);
                if of.all(|g| g == first) { first } else { MIXED }
            };
        }
    }
    groups
}

struct Walk<'a, V> {
    boxes: &'a Boxes,
    groups: Vec<[u32; WIDTH]>,
    /// Pairs of boxes that meet, not both leaves, still to be looked into.
    open: Vec<[Slot; 2]>,
    visit: V,
}

impl<V: FnMut(u32, u32) -> bool> Walk<'_, V> {
    fn run(&mut self) {
        if !self.within(0) {
            return;
        }
        while let Some([a, b]) = self.open.pop() {
            let [m, n] = [a, b].map(|slot| self.child(slot));
            let go_on = match (m & LEAF != 0, n & LEAF != 0) {
                _ if a == b => self.within(m),
                (false, true) => self.against(b, m),
                (true, _) => self.against(a, n),
                (false, false) => self.between(m, n),
            };
            if !go_on {
                return;
            }
        }
    }

    fn child(&self, slot: Slot) -> u32 {
        self.boxes.nodes[slot.node as usize].child[slot.place as usize]
    }

    fn node(&self, node: u32) -> &Node {
        &self.boxes.nodes[node as usize]
    }

    /// The boxes of one node among each other.
    fn within(&mut self, node: u32) -> bool {
        for place in 0..WIDTH as u32 {
            let slot = Slot { node, place };
            let (child, group) = (self.child(slot), self.group(slot));
            if !self.node(node).is_filled(place as usize) {
                continue;
            }
            if child & LEAF == 0 && group == MIXED {
                self.open.push([slot, slot]);
            }
            let met = self.node(node).meeting(self.node(node), place as usize);
            // Those of higher places.
            if !self.meet(slot, node, met & !1 << place) {
                return false;
            }
        }
        true
    }

    /// The boxes of one node with those of another.
    fn between(&mut self, m: u32, n: u32) -> bool {
        (0..WIDTH as u32).all(|place| {
            let met = self.node(n).meeting(self.node(m), place as usize);
            self.meet(Slot { node: m, place }, n, met)
        })
    }

    /// A box with those of a node.
    fn against(&mut self, slot: Slot, n: u32) -> bool {
        let met = self
            .node(n)
            .meeting(self.node(slot.node), slot.place as usize);
        self.meet(slot, n, met)
    }

    fn group(&self, slot: Slot) -> u32 {
        self.groups[slot.node as usize][slot.place as usize]
    }

    /// Takes a box with those of a node that it meets, a bit each.
    fn meet(&mut self, slot: Slot, n: u32, mut met: u32) -> bool {
        while met != 0 {
            let other = Slot {
                node: n,
                place: met.trailing_zeros(),
            };
            met &= met - 1;
            let group = self.group(slot);
            if group == self.group(other) && group != MIXED {
                continue;
            }
            let (s, t) = (self.child(slot), self.child(other));
            if s & t & LEAF == 0 {
                self.open.push([slot, other]);
                continue;
            }
            let [s, t] = [s, t].map(|leaf| self.boxes.index[(leaf & !LEAF) as usize]);
            if !(self.visit)(s, t) {
                return false;
            }
        }
        true
    }
}

impl Boxes {
    /// Whether one of the boxes meets another one. The stack is for work.
    fn meet_any(&self, item: &Item, open: &mut Vec<u32>) -> bool {
        let lone = item.node();
        open.clear();
        if !self.nodes.is_empty() {
            open.push(0);
        }
        while let Some(n) = open.pop() {
            let node = &self.nodes[n as usize];
            let mut met = node.meeting(&lone, 0);
            while met != 0 {
                let child = node.child[met.trailing_zeros() as usize];
                met &= met - 1;
                if child & LEAF != 0 {
                    return true;
                }
                open.push(child);
            }
        }
        false
    }
}

impl Node {
    /// Whether there is a box at a place.
    fn is_filled(&self, place: usize) -> bool {
        self.low[0][place] <= self.high[0][place]
    }

    /// Which of the boxes meet a box of another node, a bit each.
    #[inline]
    fn meeting(&self, other: &Self, place: usize) -> u32 {
        let mut meets = [u32::MAX; WIDTH];
        for k in 0..3 {
            let (low, high) = (other.low[k][place], other.high[k][place]);
            for (i, meets) in meets.iter_mut().enumerate() {
                let both = (self.low[k][i] <= high) & (self.high[k][i] >= low);
                *meets &= u32::from(both).wrapping_neg();
            }
        }
        (meets.iter().enumerate()).fold(0, |bits, (i, meets)| bits | (meets & (1 << i)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes of different sizes, strewn evenly.
    fn some_boxes(count: u32) -> Vec<[DVec3; 2]> {
        let place = |i: u32, k: f64| libm::sin(f64::from(i) * k);
        (0..count)
            .map(|i| {
                let low = DVec3::new(place(i, 1.0), place(i, 2.3), place(i, 0.7));
                let size = 0.02 + 0.1 * place(i, 5.1).abs();
                [low, low + size * DVec3::new(1.0, place(i, 3.3).abs(), 0.2)]
            })
            .collect()
    }

    fn found(boxes: &[[DVec3; 2]], group: impl Fn(u32) -> u32) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        pairs(boxes.iter().copied(), group, |s, t| {
            found.push((s.min(t), s.max(t)));
            true
        });
        found.sort_unstable();
        found
    }

    #[test]
    fn pairs_are_those_of_an_exhaustive_search() {
        let boxes = some_boxes(700);
        let meet = |s: u32, t: u32| {
            let ([a, b], [c, d]) = (boxes[s as usize], boxes[t as usize]);
            a.cmple(d).all() && c.cmple(b).all()
        };
        for groups in [1, 2, 50, 700] {
            let group = |t: u32| t % groups;
            let mut wanted = Vec::new();
            for s in 0..700 {
                wanted.extend(
                    (s + 1..700)
                        .filter(|&t| group(s) != group(t) && meet(s, t))
                        .map(|t| (s, t)),
                );
            }
            assert_eq!(found(&boxes, group), wanted, "{groups} groups");
        }
    }

    #[test]
    fn neighbours_are_those_of_an_exhaustive_search() {
        let boxes = some_boxes(700);
        let meet = |s: usize, t: usize| {
            let ([a, b], [c, d]) = (boxes[s], boxes[t]);
            a.cmple(d).all() && c.cmple(b).all()
        };
        for share in [3, 50, 1000] {
            let is_chosen = |t: u32| t % share == share / 2;
            let chosen: Vec<usize> = (0..700).filter(|&t| is_chosen(t as u32)).collect();
            let near = |t: usize| chosen.iter().any(|&c| meet(t, c));
            let wanted: Vec<u32> = (0..700).filter(|&t| near(t as usize)).collect();
            assert_eq!(with_neighbours(&boxes, is_chosen), wanted, "one in {share}");
        }
        assert_eq!(with_neighbours(&boxes, |t| t % 3 > 0).len(), 700);
    }

    #[test]
    fn boxes_that_touch_meet_wherever_they_are() {
        for shift in [0.0, 1e6, 1.0 / 3.0] {
            let p = |x: f64| DVec3::splat(x / 7.0 + shift);
            let boxes = [[p(0.0), p(1.0)], [p(1.0), p(1.0)], [p(1.5), p(2.0)]];
            assert_eq!(found(&boxes, |t| t), [(0, 1)]);
        }
        assert!(found(&[], |t| t).is_empty());
        assert!(found(&[[DVec3::ZERO; 2]], |t| t).is_empty());
    }

    #[test]
    fn a_search_can_be_ended() {
        let boxes = vec![[DVec3::ZERO, DVec3::ONE]; 100];
        let mut count = 0;
        pairs(
            boxes.into_iter(),
            |t| t,
            |_, _| {
                count += 1;
                count < 7
            },
        );
        assert_eq!(count, 7);
    }

    #[test]
    fn boxes_that_all_meet_are_given_up_on_when_there_are_many() {
        let all = |count: usize| {
            let boxes = std::iter::repeat_n([DVec3::ZERO, DVec3::ONE], count);
            let mut visited = 0;
            let end = pairs(
                boxes,
                |t| t,
                |_, _| {
                    visited += 1;
                    true
                },
            );
            (end, visited)
        };
        assert_eq!(all(4000), (Search::Done, 4000 * 3999 / 2));
        assert_eq!(all(4100), (Search::GaveUp, 4100 * PAIRS_EACH));
    }
}
