//! How far a body is from a body of revolution.

use crate::budget::{REPORTED, SURVEY};
use crate::shape::Shape;
use crate::verify::deviation::{Bound, Deviation};
use crate::verify::operation::golden_rotations;
use std::f64::consts::PI;
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

    /// The share of some samples that rotations by angles spread over the whole turn take off the surface.
    pub fn off_revolution(&self, frame: &Frame, bound: Bound) -> f64 {
        let operations = golden_rotations(frame, TURNS, self.target_in_place());
        let samples = &self.samples.mixed[..self.samples.mixed.len().min(REPORTED)];
        let pairs = samples.iter().zip(operations.iter().cycle());
        let off = pairs.filter(|(sample, operation)| !self.lands(operation, sample, bound));
        off.count() as f64 / samples.len() as f64
    }

    /// The highest order that is told from any rotation: half a step of it moves the rim farther than some samples are
    /// off that a bound allows to be, under angles spread over the whole turn.
    pub fn highest_told(&self, frame: &Frame, radius: f64, bound: Bound) -> u32 {
        let operations = golden_rotations(frame, TURNS, self.target_in_place());
        let samples = self.samples.mixed.iter().take(REPORTED);
        let allowed = (samples.zip(&operations)).fold(0.0, |most: f64, (sample, operation)| {
            let value = self.passing(sample, operation, bound, most);
            most.max(value.unwrap_or(0.0))
        });
        // Beyond any number of facets where nothing is off.
        (PI * radius / allowed) as u32
    }
}
