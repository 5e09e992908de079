//! What facets explain of how far the images of a body are off it, and what remains.

use crate::budget::QUICK;
use crate::shape::{Random, Sample, Shape};
use crate::tolerance::ARITHMETIC;
use crate::verify::deviation::{Bound, Deviation};
use crate::verify::group::Verified;
use crate::verify::operation::Operation;
use glam::DVec3;
use tmesh::{Frame, Group};

/// A length at a place of the surface, both in the units of the shape.
#[derive(Clone, Copy, Debug)]
pub struct Share {
    /// The length.
    pub value: f64,
    /// The place.
    pub at: DVec3,
}

impl Share {
    fn max(self, value: f64, at: DVec3) -> Self {
        match value > self.value {
            true => Self { value, at },
            false => self,
        }
    }
}

/// The two parts of deviations: an image is as far from the surface as the facets there stand off the shape behind them,
/// and as far as that shape is off its image.
#[derive(Clone, Copy, Debug)]
pub struct Shares {
    /// The most that facets explain at a place.
    pub facets: Share,
    /// The most that remains at a place.
    pub remaining: Share,
}

impl Verified {
    /// The parts of the deviations of a group that was verified within a bound: where the largest of them was found, and
    /// at samples under operations drawn at random.
    pub fn shares(&self, shape: &Shape, frame: &Frame, group: Group, bound: Bound) -> Shares {
        let worst = self.deviation;
        let nothing = |at| Share { value: 0.0, at };
        let mut shares = Shares {
            facets: nothing(worst.at),
            remaining: nothing(worst.at),
        };
        let mut largest_is_met = false;
        let operations = match bound.facets {
            true => self.operations(shape, frame, group),
            false => Vec::new(),
        };
        if !operations.is_empty() {
            let mut take = |sample: &Sample, operation: &Operation| {
                let Ok(off) = shape.passing(sample, operation, bound, 0.0) else {
                    return;
                };
                let left = shape.remaining(sample, operation, bound).min(off);
                shares.facets = shares.facets.max(off - left, sample.point);
                shares.remaining = shares.remaining.max(left, sample.point);
            };
            if let Some((sample, operation)) = worst.test(shape, &operations) {
                largest_is_met = true;
                take(sample, operation);
            }
            let mut random = Random(u64::from(group.order));
            for sample in shape.samples.mixed.iter().take(QUICK) {
                take(sample, &operations[random.below(operations.len())]);
            }
        }
        if !largest_is_met {
            // Found in corners of flat faces, which facets explain nothing of, or at angles of a body of revolution.
            let share = match bound.facets && worst.value > bound.limit {
                true => &mut shares.facets,
                false => &mut shares.remaining,
            };
            *share = share.max(worst.value, worst.at);
        }
        shares
    }

    /// All operations of the group but the identity.
    fn operations(&self, shape: &Shape, frame: &Frame, group: Group) -> Vec<Operation> {
        let powers = self.rotation.powers(group.order);
        let elements = group.elements().skip(1);
        let operation = |element| {
            let (k, mirrored, flipped) = group.exponents(element)?;
            let mut regions = powers[k as usize].clone();
            if mirrored {
                regions = regions.after(&self.mirror);
            }
            if flipped {
                regions = regions.after(&self.turning);
            }
            Some(Operation::new(frame, element, shape.target(&regions)))
        };
        elements.filter_map(operation).collect()
    }
}

impl Deviation {
    /// The sample and the operation that it was found with.
    fn test<'a>(
        &self,
        shape: &'a Shape,
        operations: &'a [Operation],
    ) -> Option<(&'a Sample, &'a Operation)> {
        let sample = shape.samples.mixed.iter().find(|s| s.point == self.at)?;
        // Products of matrices round differently.
        let found = |o: &&Operation| o.motion.apply(self.at).distance(self.image) <= ARITHMETIC;
        let operation = operations.iter().find(found)?;
        Some((sample, operation))
    }
}

impl Shape {
    /// What facets leave unexplained of how far the image of a sample is off.
    fn remaining(&self, sample: &Sample, operation: &Operation, bound: Bound) -> f64 {
        let left = self.unexplained(sample, operation, bound);
        left.map_or(0.0, |(_, off)| off.abs())
    }
}
