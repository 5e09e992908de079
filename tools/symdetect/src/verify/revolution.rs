//! How far a body is from a body of revolution.

use crate::shape::Shape;
use crate::verify::deviation::{Bound, Deviation};
use crate::verify::operation::golden_rotations;
use tmesh::Frame;

impl Shape {
    /// Largest deviation under rotations by angles spread over the whole turn, each sample by an
    /// angle of its own: small for a body of revolution. `None` beyond `limit`.
    pub fn deviation_from_revolution(&self, frame: &Frame, limit: f64) -> Option<Deviation> {
        let operations = golden_rotations(frame, 233, self.target_in_place());
        let samples = &self.samples.mixed;
        let count = samples.len().min(20_000);
        self.worst(count, Bound::plain(limit), |i| {
            (&samples[i], &operations[i % operations.len()])
        })
        .ok()
    }
}
