//! Verification of a single operation.

use crate::budget::QUICK;
use crate::shape::{Motion, Permutation, Shape};
use crate::verify::deviation::{Bound, Depth, Deviation};
use crate::verify::operation::Operation;

impl Shape {
    /// Verifies one operation that is its own kind (a mirror): every sample, or a few thousand.
    /// Regions stay where they are if that can be, else they are permuted.
    pub fn verify_one(
        &self,
        motion: Motion,
        bound: Bound,
        depth: Depth,
    ) -> Result<(Deviation, Permutation), Deviation> {
        self.with_permutation(motion, bound, |permutation| {
            let operation = Operation {
                motion,
                target: self.target(permutation),
            };
            if let Some(everywhere) = self.deviation_of_faces(&operation, bound) {
                return Ok(everywhere);
            }
            let (mixed, sorted) = (&self.samples.mixed, &self.samples.sorted);
            let first = mixed.len().min(QUICK);
            let worst = self.worst(first, bound, |i| (&mixed[i], &operation))?;
            if depth == Depth::Quick {
                return Ok(worst);
            }
            self.worst(sorted.len(), bound, |i| (&sorted[i], &operation))
        })
    }
}
