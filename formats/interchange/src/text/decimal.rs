//! Decimal numbers of the ordinary kind, read from the text that they are in.

/// A number at the beginning of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decimal {
    /// The number nearest to what is written.
    pub value: f64,
    /// Bytes it takes.
    pub length: usize,
    /// Digits without leading zeros and exponent.
    pub digits: u32,
}

/// The finite number that a text begins with, up to white space or the text's end. `None` where there is anything
/// else.
pub fn decimal(text: &[u8]) -> Option<Decimal> {
    let (value, length) = fast_float2::parse_partial::<f64, _>(text).ok()?;
    let ends = text.get(length).is_none_or(u8::is_ascii_whitespace);
    (ends && value.is_finite()).then(|| Decimal {
        value,
        length,
        digits: significant_digits(&text[..length]),
    })
}

/// Digits of a printed number without leading zeros and exponent.
pub fn significant_digits(word: &[u8]) -> u32 {
    let mantissa = word.iter().take_while(|b| !b.is_ascii_alphabetic());
    let digits = mantissa.filter(|b| b.is_ascii_digit());
    digits.skip_while(|b| **b == b'0').count() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<Decimal> {
        let known = decimal(text.as_bytes());
        if let Some(known) = known {
            let word = &text[..known.length];
            let parsed: f64 = word.parse().unwrap();
            assert_eq!(known.value.to_bits(), parsed.to_bits(), "{text}");
        }
        known
    }

    #[test]
    fn numbers_are_those_of_the_standard_library() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            (state >> 32) ^ state
        };
        let mut known = 0;
        for _ in 0..20_000 {
            let x = (random() % (1 << 53)) as f64 / (1_u64 << (random() % 100).min(63)) as f64;
            let mantissa = random() >> (random() % 60);
            let exponent = (random() % 50) as i32 - 40;
            for text in [
                format!("{x}"),
                format!("-{x:e}"),
                format!("{x:.6}"),
                format!("{}", x as f32),
                format!("{:.17e} ", x * 1e-20),
                format!("{mantissa}E{exponent}"),
                // Half way between two numbers.
                format!("{}.5", (1_u64 << 52) + random() % (1 << 52)),
            ] {
                known += usize::from(read(&text).is_some());
            }
        }
        assert!(known == 140_000, "{known}");
    }

    #[test]
    fn what_is_read_ends_with_the_word() {
        let all = |text: &str| read(text).map(|d| (d.value, d.length, d.digits));
        assert_eq!(all("-1.50e1\t2"), Some((-15.0, 7, 3)));
        assert_eq!(all("+.05\r\n"), Some((0.05, 4, 1)));
        assert_eq!(all("007."), Some((7.0, 4, 1)));
        assert_eq!(all("-0"), Some((-0.0, 2, 0)));
        for odd in [
            "", "-", ".", "e5", "1e", "1e+", "1d5", "1.2.3", "nan", "1#", "1e99999", "--1",
            "\u{e4}", "inf", "0x10",
        ] {
            assert_eq!(all(odd), None, "{odd}");
        }
    }
}
