//! Decimal numbers of the ordinary kind, read as the standard library reads them, in one pass.

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

/// Digits that a mantissa may have.
const MOST_DIGITS: u32 = 19;

/// Decimal places for which there is a reciprocal.
const PLACES: usize = 36;

/// Powers of ten that are exact.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// For each number of places `k`: the bits `b` that `10^k` takes, and `2^(b + 63) / 10^k` without its
/// fraction, which takes 64 bits.
const RECIPROCALS: [(i32, u64); PLACES + 1] = {
    let mut list = [(0, 0); PLACES + 1];
    let mut k = 1;
    while k <= PLACES {
        let power = 10_u128.pow(k as u32);
        let bits = 128 - power.leading_zeros() as i32;
        let mut rest = 1_u128 << (bits - 1);
        let mut quotient = 0;
        let mut i = 0;
        while i < 64 {
            rest *= 2;
            quotient *= 2;
            if rest >= power {
                rest -= power;
                quotient += 1;
            }
            i += 1;
        }
        list[k] = (bits, quotient);
        k += 1;
    }
    list
};

/// The number that a text begins with, up to white space or the text's end. `None` where there is anything
/// else, or where it takes more to tell the nearest number.
pub fn decimal(text: &[u8]) -> Option<Decimal> {
    let negative = text.first() == Some(&b'-');
    let mut at = usize::from(negative || text.first() == Some(&b'+'));
    let (mut mantissa, mut digits, mut any) = (0_u64, 0, false);
    let mut point = None;
    loop {
        match text.get(at) {
            Some(c @ b'0'..=b'9') => {
                if mantissa != 0
                    && digits + 8 <= MOST_DIGITS
                    && let Some(eight) = eight_digits(&text[at..])
                {
                    mantissa = 100_000_000 * mantissa + eight;
                    digits += 8;
                    at += 8;
                    continue;
                }
                mantissa = (mantissa.wrapping_mul(10)).wrapping_add(u64::from(c - b'0'));
                digits += u32::from(mantissa != 0);
                any = true;
            }
            Some(b'.') if point.is_none() => point = Some(at),
            _ => break,
        }
        // Beyond that the mantissa means nothing.
        if digits > MOST_DIGITS {
            return None;
        }
        at += 1;
    }
    if !any {
        return None;
    }
    let places = point.map_or(0, |p| at - p - 1);
    let mut exponent = 0;
    if let Some(b'e' | b'E') = text.get(at) {
        let length;
        (exponent, length) = exponent_of(&text[at + 1..])?;
        at += 1 + length;
    }
    if text.get(at).is_some_and(|b| !b.is_ascii_whitespace()) {
        return None;
    }
    let size = nearest(mantissa, exponent - i32::try_from(places).ok()?)?;
    Some(Decimal {
        value: if negative { -size } else { size },
        length: at,
        digits,
    })
}

/// The number that the first eight bytes are, if they are all digits.
fn eight_digits(text: &[u8]) -> Option<u64> {
    const ONES: u64 = 0x0101_0101_0101_0101;
    let bytes = u64::from_le_bytes(*text.first_chunk()?);
    // Digits are 0x30 to 0x39, and with 6 more none gets beyond 0x3f.
    let high = (bytes | bytes.wrapping_add(6 * ONES)) & (0xf0 * ONES);
    if high != 0x30 * ONES || bytes & (0xf0 * ONES) != 0x30 * ONES {
        return None;
    }
    // Neighbours are joined: digits to pairs, pairs to fours, fours to the eight; the first is the lowest
    // byte.
    let pairs = (bytes & (0x0f * ONES)).wrapping_mul(1 + (10 << 8)) >> 8 & 0x00ff_00ff_00ff_00ff;
    let fours = pairs.wrapping_mul(1 + (100 << 16)) >> 16 & 0x0000_ffff_0000_ffff;
    Some(fours.wrapping_mul(1 + (10_000 << 32)) >> 32)
}

/// An exponent of few digits, and the bytes it takes.
fn exponent_of(text: &[u8]) -> Option<(i32, usize)> {
    let negative = text.first() == Some(&b'-');
    let sign = usize::from(negative || text.first() == Some(&b'+'));
    let digits = text[sign..].iter().take_while(|b| b.is_ascii_digit());
    let (value, count) = digits.take(4).fold((0, 0), |(value, count), b| {
        (10 * value + i32::from(b - b'0'), count + 1)
    });
    (1..4)
        .contains(&count)
        .then_some((if negative { -value } else { value }, sign + count))
}

/// The number nearest to `mantissa * 10^exponent`, where that is easy to tell.
fn nearest(mantissa: u64, exponent: i32) -> Option<f64> {
    if mantissa == 0 {
        return Some(0.0);
    }
    let power = exponent.unsigned_abs() as usize;
    // Both are exact, and the result is rounded once.
    if mantissa <= 1 << 53 && power < POWERS.len() {
        let (x, y) = (mantissa as f64, POWERS[power]);
        return Some(if exponent < 0 { x / y } else { x * y });
    }
    if exponent >= 0 || power > PLACES {
        return None;
    }
    let (bits, reciprocal) = RECIPROCALS[power];
    let shift = mantissa.leading_zeros();
    let product = u128::from(mantissa << shift) * u128::from(reciprocal);
    // The quotient, in units of its last bit here, is not less than this and less than two more.
    let high = (product >> 64) as u64;
    let spare = 64 - high.leading_zeros() - f64::MANTISSA_DIGITS;
    let (whole, rest, half) = (high >> spare, high & ((1 << spare) - 1), 1 << (spare - 1));
    let rounded = match rest {
        _ if rest + 2 <= half => whole,
        _ if rest > half => whole + 1,
        _ => return None,
    };
    let scale = (1 + spare as i32) - shift as i32 - bits;
    Some(rounded as f64 * f64::from_bits(((1023 + scale) as u64) << 52))
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
        assert!(known > 90_000, "{known}");
    }

    #[test]
    fn eight_digits_are_eight_digits() {
        assert_eq!(eight_digits(b"123456789"), Some(12_345_678));
        assert_eq!(eight_digits(b"1234567"), None);
        for at in 0..8 {
            for byte in 0..=u8::MAX {
                let mut text = *b"00000009";
                text[at] = byte;
                let known = std::str::from_utf8(&text).ok().filter(|_| byte != b'+');
                assert_eq!(eight_digits(&text), known.and_then(|t| t.parse().ok()));
            }
        }
    }

    #[test]
    fn what_is_read_ends_with_the_word() {
        let all = |text: &str| read(text).map(|d| (d.value, d.length, d.digits));
        assert_eq!(all("-1.50e1\t2"), Some((-15.0, 7, 3)));
        assert_eq!(all("+.05\r\n"), Some((0.05, 4, 1)));
        assert_eq!(all("007."), Some((7.0, 4, 1)));
        assert_eq!(all("-0"), Some((-0.0, 2, 0)));
        for odd in [
            "",
            "-",
            ".",
            "e5",
            "1e",
            "1e+",
            "1d5",
            "1.2.3",
            "nan",
            "1#",
            "1e99999",
            "--1",
            "\u{e4}",
            "12345678901234567890",
            "inf",
            "0x10",
        ] {
            assert_eq!(all(odd), None, "{odd}");
        }
    }
}
