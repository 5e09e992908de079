//! Orders that a few samples do not rule out.

use crate::budget::SCAN;
use crate::rotation::find::OrderSearch;
use crate::shape::{Random, Sample, Shape, Target};
use crate::threads;
use crate::verify::{Operation, golden_rotations};
use glam::DVec3;
use tmesh::{Frame, Isometry};

/// Turns that tell which samples are taken off the surface by most turns; and powers of an order that a place is tried
/// under.
const TELLING_TURNS: usize = 4;

/// A few samples, to be tried under many orders.
struct Scan<'a> {
    shape: &'a Shape,
    frame: &'a Frame,
    /// Numbers of the samples, those first that most turns take off the surface.
    places: Vec<usize>,
    /// Deviation beyond which a sample is off.
    limit: f64,
    /// Samples that may be off.
    outliers: usize,
}

impl<'a> Scan<'a> {
    fn new(shape: &'a Shape, frame: &'a Frame, limit: f64, outliers: f64) -> Self {
        let samples = &shape.samples.mixed;
        let turns = golden_rotations(frame, TELLING_TURNS, Target::Any);
        let misses = |i: &usize| {
            let off = |turn: &&Operation| {
                let image = turn.motion.apply(samples[*i].point);
                (shape.nearest(image, 0, &Target::Any, limit)).is_none()
            };
            turns.iter().filter(off).count()
        };
        let mut places: Vec<usize> = (0..SCAN.min(samples.len())).collect();
        places.sort_by_cached_key(|i| std::cmp::Reverse(misses(i)));
        Self {
            shape,
            frame,
            outliers: (outliers * places.len() as f64) as usize,
            places,
            limit,
        }
    }

    /// Whether an order may hold. Regions do not count here.
    fn passes(&self, n: u32) -> bool {
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
            let turn = Isometry::rotation(k, n);
            let distance =
                (self.shape).distance_of_image(self.frame, turn, &samples[i], self.limit);
            if distance.is_none() {
                if left == 0 {
                    return false;
                }
                left -= 1;
            }
        }
        true
    }
}

impl OrderSearch<'_> {
    /// Orders that a few samples do not rule out, increasing. The share `outliers` of them may be off.
    pub fn scan(&self, frame: &Frame, limit: f64, outliers: f64) -> Vec<u32> {
        let scan = Scan::new(self.shape, frame, limit, outliers);
        let orders: Vec<u32> = (self.orders.clone())
            .filter(|&n| self.limits.admit(n))
            .collect();
        let passed = threads::map(&orders, |&n| scan.passes(n));
        let passed = orders.into_iter().zip(passed).filter(|(_, passed)| *passed);
        passed.map(|(n, _)| n).collect()
    }

    /// Whether a few samples leave it open that one of the orders holds in the frame as it is.
    pub fn may_hold(&self, frame: &Frame) -> bool {
        let bound = self.limits.bound(self.shape.radius(frame)).most();
        let scan = Scan::new(self.shape, frame, bound, 0.0);
        (self.orders.clone())
            .filter(|&n| self.limits.admit(n))
            .any(|n| scan.passes(n))
    }

    /// Whether one of a few powers of the rotation of order `n` maps a point off the surface.
    pub fn stumbles(&self, frame: &Frame, n: u32, point: DVec3, limit: f64) -> bool {
        let sample = Sample { point, triangle: 0 };
        let mut random = Random(u64::from(n));
        (0..TELLING_TURNS).any(|i| {
            let k = match i {
                0 => 1,
                _ => 1 + random.below(n as usize - 1) as i64,
            };
            let turn = Isometry::rotation(k, n);
            (self.shape)
                .distance_of_image(frame, turn, &sample, limit)
                .is_none()
        })
    }
}
