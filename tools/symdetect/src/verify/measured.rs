//! Residuals of orders that need not hold.

use crate::shape::{Random, Shape};
use crate::verify::deviation::{Bound, Deviation};
use crate::verify::operation::Operation;
use tmesh::{Frame, Isometry};

/// Powers of a rotation that residuals are measured under at most.
const POWERS: usize = 64;

impl Shape {
    /// Largest deviation over `count` samples and random powers of the rotation of order `n`; stops at the
    /// first one beyond `most`.
    pub fn deviation_measured(&self, frame: &Frame, n: u32, count: usize, most: f64) -> Deviation {
        let mut random = Random(u64::from(n));
        let target = self.target_in_place();
        let operations: Vec<Operation> = (0..count.min(POWERS))
            .map(|i| {
                let k = if i % 4 == 0 {
                    1
                } else {
                    1 + random.below(n as usize - 1) as i64
                };
                Operation::new(frame, Isometry::rotation(k, n), target.clone())
            })
            .collect();
        let samples = &self.samples.mixed;
        let count = count.min(samples.len());
        let measured = self.worst(count, Bound::plain(most), |i| {
            (&samples[i], &operations[(i * 7) % operations.len()])
        });
        measured.unwrap_or_else(|beyond| beyond)
    }
}
