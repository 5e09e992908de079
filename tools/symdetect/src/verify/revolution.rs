//! How far a body is from a body of revolution.

use crate::budget::SURVEY;
use crate::shape::Shape;
use crate::verify::deviation::{Bound, Deviation};
use crate::verify::operation::golden_rotations;
use tmesh::Frame;

/// Angles that a body of revolution is turned by: a Fibonacci number, after which multiples of the golden section are
/// spaced most evenly, and more than any facet count has divisors.
const TURNS: usize = 233;

impl Shape {
    /// Largest deviation under rotations by angles spread over the whole turn, each sample by an
    /// angle of its own: small for a body of revolution. `None` beyond the bound.
    pub fn deviation_from_revolution(&self, frame: &Frame, bound: Bound) -> Option<Deviation> {
        let operations = golden_rotations(frame, TURNS, self.target_in_place());
        let samples = &self.samples.mixed;
        let count = samples.len().min(SURVEY);
        self.worst(count, bound, |i| {
            (&samples[i], &operations[i % operations.len()])
        })
        .ok()
    }
}
