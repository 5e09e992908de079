//! Deterministic pseudo-random numbers.

use glam::DVec3;

/// SplitMix64 (Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// The next number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        0.5 + 0.5 * self.signed()
    }

    /// The next number in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        self.bits() as i64 as f64 / 2.0_f64.powi(63)
    }

    /// The next vector in the cube [-1, 1)^3.
    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }
}
