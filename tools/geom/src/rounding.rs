//! How far rounded results are off, from the precision of the numbers and the count of operations.

/// Bound on the relative error of a product of so many factors `1 + d`, each rounding by at most half the distance
/// `epsilon` from one to the next number (Higham, "Accuracy and Stability of Numerical Algorithms", lemma 3.1).
const fn bound(operations: u32, epsilon: f64) -> f64 {
    let first_order = 0.5 * epsilon * operations as f64;
    first_order / (1.0 - first_order)
}

/// The bound after so many operations in double precision, relative to the sum of the sizes of all terms.
#[inline]
pub const fn double(operations: u32) -> f64 {
    bound(operations, f64::EPSILON)
}

/// The same in single precision.
#[inline]
pub const fn single(operations: u32) -> f64 {
    bound(operations, f32::EPSILON as f64)
}

/// The largest power of two that is not larger than a positive number; 1 for numbers that have none among the normal ones:
/// zero, what is nearly zero, and infinity. Lengths divided by it are near one, and no digit of them is lost.
#[inline]
pub fn power_of_two(x: f64) -> f64 {
    // The exponent without the digits.
    let power = f64::from_bits(x.to_bits() & f64::INFINITY.to_bits());
    if power.is_normal() { power } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_off_by_no_more_than_the_bound() {
        // Each addition loses what is half a digit.
        let half = 0.5 * f64::EPSILON;
        let sum = (0..7).fold(1.0, |sum, _| sum + half);
        let exact_less_one = 7.0 * half;
        assert_eq!(sum, 1.0);
        assert!(exact_less_one <= double(7) && double(7) < 8.0 * half);
        assert!(single(3) > 1.5 * f64::from(f32::EPSILON));
    }

    #[test]
    fn powers_of_two_are_next_below() {
        for (x, power) in [
            (1.0, 1.0),
            (0.75, 0.5),
            (5.0, 4.0),
            (f64::MAX, 2.0_f64.powi(1023)),
            (f64::MIN_POSITIVE, f64::MIN_POSITIVE),
            (f64::from_bits(7), 1.0),
            (0.0, 1.0),
            (f64::INFINITY, 1.0),
        ] {
            assert_eq!(power_of_two(x), power);
        }
    }
}
