//! What follows where flat faces go to flat faces.

use crate::budget::REPORTED;
use crate::shape::Shape;
use crate::verify::deviation::{Bound, Deviation};
use crate::verify::operation::Operation;

/// Share of the limit up to which what a test of the whole surface says of a rotation by one step, times the number of
/// steps, leaves its powers to a quick test: the sum is an upper bound, so that anything up to 1 would be sound where
/// the first test is exact; samples may have missed the worst place by some factor.
const IMPLIED: f64 = 0.25;
impl Shape {
    /// Deviation of an operation that takes all flat faces to faces, if it does.
    pub fn deviation_of_faces(&self, operation: &Operation, bound: Bound) -> Option<Deviation> {
        let faces = self.faces()?;
        let within = self.same_corner().min(bound.limit);
        let (value, at) = faces.image(&operation.motion, &operation.target, within)?;
        Some(Deviation {
            value,
            at,
            image: operation.motion.apply(at),
            everywhere: true,
        })
    }

    /// The same of all powers of a rotation: what its first one implies is not asked again, and how far off others
    /// are is measured in some corners.
    pub fn rotation_of_faces(
        &self,
        n: u32,
        power: impl Fn(u32) -> Operation,
        bound: Bound,
    ) -> Option<Deviation> {
        let mut worst = self.deviation_of_faces(&power(1), bound)?;
        if !self.implies(n, worst, Deviation::NONE, bound) {
            return None;
        }
        for k in [n / 2, n / 3, 2 * n / 5, n - 1] {
            if k > 1 {
                let within = self.same_corner().min(bound.limit);
                let faces = self.faces()?;
                let value = faces.image_of_some(&power(k).motion, REPORTED, within)?;
                worst.value = worst.value.max(value);
            }
        }
        Some(worst)
    }

    /// Whether a rotation by a turn over `n` and an operation beside it, which both hold everywhere, leave no doubt that
    /// all products with its powers do: those deviate by at most so many times what the rotation does, and by what
    /// the other one does.
    pub fn implies(&self, n: u32, rotation: Deviation, other: Deviation, bound: Bound) -> bool {
        let most = rotation.value * f64::from(n - 1) + other.value;
        let enough = self.same_corner().max(IMPLIED * bound.limit);
        rotation.everywhere && other.everywhere && most <= enough
    }

    /// Whether what a test of the whole surface says of a rotation by one step leaves its `others` powers to a quick
    /// test: powers deviate by at most so many times what the first does.
    pub fn hardly_off(first: f64, others: usize, limit: f64) -> bool {
        first * others as f64 <= IMPLIED * limit
    }
}
