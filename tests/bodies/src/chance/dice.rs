//! Random choices.

use super::Random;

/// Choices made by a seed.
#[derive(Clone, Debug)]
pub struct Dice(Random);

impl Dice {
    /// The choices of a seed.
    pub fn new(seed: u64) -> Self {
        Self(Random::new(seed))
    }

    /// A seed for choices apart from these.
    pub fn seed(&mut self) -> u64 {
        self.0.bits()
    }

    /// A number in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        self.0.signed()
    }

    /// A number in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + 0.5 * (self.signed() + 1.0) * (high - low)
    }

    /// A number in [low, high) whose logarithm is evenly spread; both positive.
    pub fn log_between(&mut self, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.between(0.0, 1.0))
    }

    /// An integer below `count`, which is positive.
    pub fn below(&mut self, count: usize) -> usize {
        (self.0.bits() % count as u64) as usize
    }

    /// An integer from `low` to `high`, both possible.
    pub fn integer(&mut self, low: usize, high: usize) -> usize {
        low + self.below(high - low + 1)
    }

    /// True in the given share of cases.
    pub fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    /// One of several.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }
}
