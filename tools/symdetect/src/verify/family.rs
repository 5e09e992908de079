//! Verification of all powers of a rotation, and of other families of operations.

use crate::budget::{FULL, QUICK};
use crate::shape::{Motion, Permutation, Random, Shape};
use crate::verify::deviation::{Bound, Depth, Deviation};
use crate::verify::operation::Operation;
use tmesh::{Frame, Isometry};

impl Shape {
    /// Verifies that the rotation by every multiple of a turn over `n` about the frame's z axis maps
    /// the surface onto itself.
    pub fn verify_rotation(
        &self,
        frame: &Frame,
        n: u32,
        bound: Bound,
        depth: Depth,
    ) -> Result<(Deviation, Permutation), Deviation> {
        let step = Motion::new(frame, Isometry::rotation(1, n).matrix());
        self.with_permutation(step, bound, |permutation| {
            let motion = |k: u32| Motion::new(frame, Isometry::rotation(i64::from(k), n).matrix());
            let powers = permutation.powers(n);
            if !powers[n as usize - 1].after(permutation).is_identity() {
                return Err(Deviation {
                    value: 1.0,
                    ..Deviation::NONE
                });
            }
            let power = |k: u32| Operation {
                motion: motion(k),
                target: self.target(&powers[k as usize]),
            };
            if let Some(everywhere) = self.rotation_of_faces(n, power, bound) {
                return Ok(everywhere);
            }
            let operations: Vec<Operation> = (1..n).map(power).collect();
            self.verify_family(&operations, bound, depth)
        })
    }

    /// Verifies many operations: a share of the samples for each, and with [`Depth::Full`] all of
    /// them for the first, of which the others then are powers.
    pub fn verify_family(
        &self,
        operations: &[Operation],
        bound: Bound,
        depth: Depth,
    ) -> Result<Deviation, Deviation> {
        let (samples, sorted) = (&self.samples.mixed, &self.samples.sorted);
        let others = operations.len();
        // Each sample with an operation drawn at random, before anything systematic.
        let mut random = Random(others as u64);
        let draws: Vec<u32> = (0..samples.len().min(QUICK / 2))
            .map(|_| random.below(others) as u32)
            .collect();
        let mut worst = self.worst(draws.len(), bound, |i| {
            (&samples[i], &operations[draws[i] as usize])
        })?;
        let mut implied = false;
        if depth == Depth::Full {
            let first = self.worst(sorted.len(), bound, |i| (&sorted[i], &operations[0]))?;
            implied = Self::hardly_off(first.value, others, bound.limit);
            worst = worst.max(first);
        }
        let shared = match depth {
            Depth::Full if !implied => sorted.len().min(FULL),
            _ => QUICK,
        };
        let each = (shared / others).clamp(16, sorted.len().max(16));
        let stride = (sorted.len() / each).max(1);
        let rest = self.worst(each * others, bound, |i| {
            let (which, i) = (i / each, i % each);
            // Spread over the whole surface, and other samples for the next operation.
            (
                &sorted[(i * stride + which) % sorted.len()],
                &operations[which],
            )
        })?;
        Ok(worst.max(rest))
    }
}
