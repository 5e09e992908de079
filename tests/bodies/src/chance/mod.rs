//! Deterministic pseudo-random numbers, and choices made with them.

mod dice;
mod random;

pub use dice::Dice;
pub use random::Random;
