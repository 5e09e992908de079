//! How precise the coordinates of a file are.

use super::decimal::significant_digits;

/// Relative error of a number held in single precision.
pub const SINGLE: f64 = 1.0 / (1u64 << 24) as f64;

/// Relative error of a number held in double precision.
pub const DOUBLE: f64 = 1.0 / (1u64 << 53) as f64;

/// Significant decimal digits that tell every two numbers of single precision apart: the least n with
/// 10^(n - 1) > 2^24. Text with no more digits may have been printed from single precision.
const SINGLE_DIGITS: u32 = 9;

/// What the printed coordinates of a text file show about the numbers behind them.
#[derive(Clone, Debug)]
pub struct TextPrecision {
    digits: u32,
    single: bool,
}

impl Default for TextPrecision {
    fn default() -> Self {
        Self {
            digits: 0,
            single: true,
        }
    }
}

impl TextPrecision {
    /// Takes a coordinate into account.
    pub fn note(&mut self, word: &[u8], value: f64) {
        self.note_digits(significant_digits(word), value);
    }

    /// Takes a coordinate into account that has so many significant digits.
    pub fn note_digits(&mut self, digits: u32, value: f64) {
        self.digits = self.digits.max(digits);
        if self.single && digits > SINGLE_DIGITS {
            // A single printed with more digits than it has lies within the printed rounding of
            // itself.
            let off = (value - f64::from(value as f32)).abs();
            self.single = off <= unit(digits) * value.abs();
        }
    }

    /// Error of a coordinate relative to the largest one: single precision unless more than nine
    /// significant digits are printed that single precision cannot hold.
    pub fn relative(&self) -> f64 {
        if self.single || self.digits <= SINGLE_DIGITS {
            SINGLE
        } else {
            (0.5 * unit(self.digits)).max(DOUBLE)
        }
    }

    /// The same if numbers were rounded to the most digits that any of them is printed with, which those of a drawing with
    /// round numbers are not.
    pub fn printed(&self) -> f64 {
        match self.digits {
            0 => self.relative(),
            digits => self.relative().max(0.5 * unit(digits)),
        }
    }
}

/// One unit in the last of so many significant decimal digits, relative to the number at most.
fn unit(digits: u32) -> f64 {
    10.0_f64.powi(1 - digits as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_digits_that_are_printed_may_be_all_that_is_known() {
        let of = |words: &[&str]| {
            let mut precision = TextPrecision::default();
            for word in words {
                precision.note(word.as_bytes(), word.parse().expect("a number"));
            }
            (precision.relative(), precision.printed())
        };
        assert_eq!(of(&["1.23457", "12.5", "0"]), (SINGLE, 5e-6));
        assert_eq!(of(&["1.23456789", "-0.5"]), (SINGLE, SINGLE));
        let double = of(&["0.123456789012"]);
        assert_eq!(double.0, double.1);
        assert_eq!(of(&[]), (SINGLE, SINGLE));
    }
}
