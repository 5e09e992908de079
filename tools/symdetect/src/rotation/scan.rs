//! Orders that a few samples do not rule out.

use crate::budget::{REPORTED, SCAN};
use crate::rotation::find::OrderSearch;
use crate::shape::{Random, Sample, Shape, Target};
use crate::threads;
use crate::verify::{Bound, Operation, golden_rotations};
use tmesh::{Frame, Isometry};

/// Turns that tell which samples are taken off the surface by most turns; and powers of an order that a place is tried
/// under.
pub const TELLING_TURNS: usize = 4;

/// A few samples, to be tried under many orders.
struct Scan<'a> {
    shape: &'a Shape,
    frame: &'a Frame,
    /// Numbers of the samples, those first that most turns take off the surface.
    places: Vec<usize>,
    /// Deviations beyond which a sample is off.
    bound: Bound,
    /// Where images may land.
    target: Target,
    /// Samples that may be off.
    outliers: usize,
}

impl<'a> Scan<'a> {
    fn new(shape: &'a Shape, frame: &'a Frame, bound: Bound, outliers: f64) -> Self {
        let places = shape.telling_samples(frame, bound);
        Self {
            shape,
            frame,
            outliers: (outliers * places.len() as f64) as usize,
            places,
            bound,
            target: shape.target_of_any_exchange(),
        }
    }

    /// How many samples are off under an order, if not too many for it to hold. Regions do not count here
    /// where they may be exchanged.
    fn misses(&self, n: u32) -> Option<usize> {
        let samples = &self.shape.samples.mixed;
        let mut left = self.outliers;
        let random = Random(u64::from(n));
        for &i in &self.places {
            // Whatever comes first, each sample has a power of its own.
            let k = if i % 2 == 0 {
                1
            } else {
                1 + random.after(i / 2).below(n as usize - 1) as i64
            };
            let turn = Operation::new(self.frame, Isometry::rotation(k, n), self.target.clone());
            if !self.shape.lands(&turn, &samples[i], self.bound) {
                left = left.checked_sub(1)?;
            }
        }
        Some(self.outliers - left)
    }
}

impl Shape {
    /// The numbers of a few samples that tell one turn about a frame's axis from others: those that turns take farthest
    /// off the surface, in that order. On a flange, they are at its holes.
    pub fn telling_samples(&self, frame: &Frame, bound: Bound) -> Vec<usize> {
        let samples = &self.samples.mixed;
        let target = self.target_of_any_exchange();
        let turns = golden_rotations(frame, TELLING_TURNS, target);
        let most = self.most(bound);
        let off = |i: &usize| {
            let distance = |turn: &Operation| {
                let image = turn.motion.apply(samples[*i].point);
                let hit = self.near(image, samples[*i].triangle, &turn.target, bound);
                hit.map_or(most, |hit| hit.distance)
            };
            // Of numbers that are not negative, the bits are in the order of the numbers.
            turns.iter().map(distance).sum::<f64>().to_bits()
        };
        let mut places: Vec<usize> = (0..REPORTED.min(samples.len())).collect();
        places.sort_by_cached_key(|i| std::cmp::Reverse(off(i)));
        places.truncate(SCAN);
        places
    }
}

impl OrderSearch<'_> {
    /// Orders that a few samples do not rule out, those first under which the fewest are off, higher before lower ones.
    /// The share `outliers` of them may be off. Only `multiples` of a number are tried.
    pub fn scan(&self, frame: &Frame, bound: Bound, outliers: f64, multiples: u32) -> Vec<u32> {
        let scan = Scan::new(self.shape, frame, bound, outliers);
        let orders: Vec<u32> = (self.orders.clone())
            .filter(|n| n.is_multiple_of(multiples))
            .collect();
        let misses = threads::map(&orders, |&n| scan.misses(n));
        let mut passed: Vec<(usize, u32)> = (misses.into_iter().zip(orders))
            .filter_map(|(misses, n)| Some((misses?, n)))
            .collect();
        passed.sort_by_key(|&(misses, n)| (misses, std::cmp::Reverse(n)));
        passed.into_iter().map(|(_, n)| n).collect()
    }

    /// Whether one of a few powers of the rotation of order `n` maps a place off the surface.
    pub fn stumbles(&self, frame: &Frame, n: u32, place: &Sample, bound: Bound) -> bool {
        let mut random = Random(u64::from(n));
        (0..TELLING_TURNS).any(|i| {
            let k = match i {
                0 => 1,
                _ => 1 + random.below(n as usize - 1) as i64,
            };
            let turn = Operation::new(frame, Isometry::rotation(k, n), Target::Any);
            !self.shape.lands(&turn, place, bound)
        })
    }
}
