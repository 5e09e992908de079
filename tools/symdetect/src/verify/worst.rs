//! Tests of operations at samples of the surface.

use crate::shape::{Sample, Shape};
use crate::threads;
use crate::tolerance::ARITHMETIC;
use crate::verify::deviation::{Bound, Deviation};
use crate::verify::operation::Operation;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Tests that a thread does in one go: half a millisecond, long against the microseconds that handing them over takes.
const SHARE: usize = 512;

impl Shape {
    /// Deviation of one test, and whether it passes. Beyond the bound, the distance to any triangle
    /// that would do, or 1 when there is none. A deviation no larger than one that is `known` need not be exact.
    fn test(
        &self,
        sample: &Sample,
        operation: &Operation,
        bound: Bound,
        known: f64,
    ) -> (f64, bool) {
        let beyond = match self.passing(sample, operation, bound, known) {
            Ok(value) => return (value, true),
            Err(beyond) => beyond,
        };
        if let Some(value) = beyond {
            return (value, false);
        }
        let image = operation.motion.apply(sample.point);
        let (triangle, target) = (sample.triangle, &operation.target);
        let find = |within| self.near_enough((image, triangle), target, within, ARITHMETIC);
        // Where many triangles are about equally far, an open search would visit them all.
        let mut within = 4.0 * self.most(bound).max(ARITHMETIC);
        while within < 2.0 {
            if let Some(n) = find(within) {
                return (n.distance, false);
            }
            within *= 4.0;
        }
        (find(f64::INFINITY).map_or(1.0, |n| n.distance), false)
    }

    /// Deviation of a test that passes; of another one, as an error, if it was found. A deviation no larger than one that is
    /// `known` need not be exact.
    pub(super) fn passing(
        &self,
        sample: &Sample,
        operation: &Operation,
        bound: Bound,
        known: f64,
    ) -> Result<f64, Option<f64>> {
        let image = operation.motion.apply(sample.point);
        let (triangle, target) = (sample.triangle, &operation.target);
        let enough = known
            .min(bound.limit)
            .max(ARITHMETIC.min(0.1 * bound.limit));
        // A little beyond the limit, so that what is found within it is found exactly.
        let within = 1.01 * bound.limit;
        if let Some(n) = self.near_enough((image, triangle), target, within, enough)
            && n.distance <= bound.limit
        {
            return Ok(n.distance);
        }
        if !bound.facets {
            return Err(None);
        }
        let behind = self.nearest_behind((image, None), triangle, target, bound.limit);
        let n = behind.ok_or(None)?;
        match self.facets_explain(sample, operation, &n, bound) {
            true => Ok(n.distance),
            false => Err(Some(n.distance)),
        }
    }

    /// Whether the image of a sample is on the surface.
    pub fn lands(&self, operation: &Operation, sample: &Sample, bound: Bound) -> bool {
        let image = operation.motion.apply(sample.point);
        let (triangle, target) = (sample.triangle, &operation.target);
        let limit = bound.limit;
        let is_near = || {
            self.near_enough((image, triangle), target, limit, limit)
                .is_some()
        };
        let is_behind = || {
            let hit = self.nearest_behind((image, None), triangle, target, limit);
            hit.is_some_and(|hit| self.facets_explain(sample, operation, &hit, bound))
        };
        is_near() || bound.facets && is_behind()
    }

    /// Runs tests 0 to `count - 1`; `job` names sample and operation of each. Returns the largest
    /// deviation, or as an error the first one that does not pass.
    pub fn worst<'a>(
        &self,
        count: usize,
        bound: Bound,
        job: impl Fn(usize) -> (&'a Sample, &'a Operation) + Sync,
    ) -> Result<Deviation, Deviation> {
        let run = |range: Range<usize>, known: Deviation| {
            let mut worst = known;
            for i in range {
                let (sample, operation) = job(i);
                let (value, passes) = self.test(sample, operation, bound, worst.value);
                let deviation = Deviation {
                    value,
                    at: sample.point,
                    image: operation.motion.apply(sample.point),
                    everywhere: false,
                };
                if !passes {
                    return Err(deviation);
                }
                worst = worst.max(deviation);
            }
            Ok(worst)
        };
        // What fails mostly fails early.
        let first = count.min(SHARE / 2);
        let begun = run(0..first, Deviation::UNTESTED)?;
        let shares: Vec<Range<usize>> = (first..count)
            .step_by(SHARE)
            .map(|i| i..(i + SHARE).min(count))
            .collect();
        // Shares behind the first one that fails make no difference.
        let failed = AtomicUsize::new(usize::MAX);
        let unless_failed = |share: &Range<usize>| {
            if share.start > failed.load(Ordering::Relaxed) {
                return Ok(Deviation::UNTESTED);
            }
            run(share.clone(), begun)
                .inspect_err(|_| _ = failed.fetch_min(share.start, Ordering::Relaxed))
        };
        let mut worst = begun;
        for result in threads::map(&shares, unless_failed) {
            worst = worst.max(result?);
        }
        Ok(worst)
    }
}
