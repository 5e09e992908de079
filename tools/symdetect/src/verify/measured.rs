//! Residuals of orders that need not hold.

use crate::shape::{Motion, Random, Shape, Target};
use crate::verify::deviation::{Bound, Deviation};
use crate::verify::operation::Operation;
use tmesh::{Frame, Isometry};

/// Powers of a rotation that residuals are measured under at most.
const POWERS: usize = 64;

impl Shape {
    /// Largest deviation over `count` samples and random powers of the rotation of order `n`; stops at the
    /// first one beyond `most`. Which regions they are of counts where the surface itself is taken to itself within a
    /// tolerance: of regions that the rotation does not exchange, images are on no surface that would do.
    pub fn deviation_measured(
        &self,
        frame: &Frame,
        n: u32,
        count: usize,
        (tolerance, most): (f64, f64),
    ) -> Deviation {
        let mut random = Random(u64::from(n));
        let powers: Vec<Isometry> = (0..count.min(POWERS))
            .map(|i| {
                let k = if i % 4 == 0 {
                    1
                } else {
                    1 + random.below(n as usize - 1) as i64
                };
                Isometry::rotation(k, n)
            })
            .collect();
        let samples = &self.samples.mixed;
        let count = count.min(samples.len());
        let measured = |target: Target| {
            let operation = |power: &Isometry| Operation::new(frame, *power, target.clone());
            let operations: Vec<Operation> = powers.iter().map(operation).collect();
            let measured = self.worst(count, Bound::plain(most), |i| {
                (&samples[i], &operations[(i * 7) % operations.len()])
            });
            measured.unwrap_or_else(|beyond| beyond)
        };
        let of_surface = measured(self.target_of_any_exchange());
        let exchanges = || {
            let step = Motion::new(frame, Isometry::rotation(1, n).matrix());
            self.vote(&step, Bound::plain(tolerance)).is_some()
        };
        match !self.may_exchange || of_surface.value > tolerance || exchanges() {
            true => of_surface,
            false => measured(self.target_in_place()),
        }
    }
}
