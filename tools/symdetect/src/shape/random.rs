//! Random numbers that are the same on every run and machine.

/// What the state of the generator grows by with each number.
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// A small deterministic random generator (SplitMix64, Steele et al. 2014, with the constants of that paper).
#[derive(Clone)]
pub struct Random(pub u64);

impl Random {
    /// Next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(STEP);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// The same generator so many numbers later.
    pub fn after(&self, numbers: usize) -> Self {
        Self(self.0.wrapping_add((numbers as u64).wrapping_mul(STEP)))
    }

    /// Uniform in `0..n`, `n` positive.
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.bits()) * n as u128) >> 64) as usize
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Puts a slice into random order.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }
}
