//! Numbers as people read them, in messages, tables and pictures. Files get all digits, from their writers.

/// Significant digits: what distinguishes two meshes of a million elements, and what a person compares at a glance.
const DIGITS: usize = 6;

/// Powers of ten of the leading digit for which plain notation is used: from 1e-4 as C's `%g` does, where it takes as
/// many characters as scientific notation of two digits in the exponent, to the first power that has a digit more than
/// is shown. Beyond that the padding zeros of plain notation would have to be counted.
const PLAIN: std::ops::Range<i32> = -4..DIGITS as i32 + 1;

/// A number with six significant digits and without trailing zeros, in plain notation from 1e-4 to below 1e7 (there
/// with its whole part), else in scientific notation.
pub fn number(x: f64) -> String {
    significant(x, DIGITS)
}

/// The same with so many significant digits, at least one.
pub fn significant(x: f64, digits: usize) -> String {
    if x == 0.0 || !x.is_finite() {
        // No minus before zero.
        return format!("{}", x + 0.0).to_lowercase();
    }
    let scientific = format!("{x:.*e}", digits - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return scientific;
    };
    // The exponent after rounding: 999999.7 has seven digits.
    match exponent.parse::<i32>() {
        Ok(power) if PLAIN.contains(&power) => {
            let decimals = (digits as i32 - 1 - power).max(0) as usize;
            trimmed(&format!("{x:.decimals$}")).to_owned()
        }
        _ => format!("{}e{exponent}", trimmed(mantissa)),
    }
}

/// Digits without the zeros that end their decimals.
fn trimmed(digits: &str) -> &str {
    if digits.contains('.') {
        digits.trim_end_matches('0').trim_end_matches('.')
    } else {
        digits
    }
}

/// A count that is not known exactly: two significant digits, in groups of three.
pub fn about(count: f64) -> String {
    let rounded = format!("{count:.1e}").parse().unwrap_or(count);
    grouped(rounded as u64)
}

/// A count with its digits in groups of three.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(' ');
        }
        out.push(digit);
    }
    out
}

/// Three numbers as a point: `(0.5, -12.25, 1e-9)`.
pub fn point(p: [f64; 3]) -> String {
    let [x, y, z] = p.map(number);
    format!("({x}, {y}, {z})")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_six_digits_at_most() {
        for (x, expected) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (70.528779, "70.5288"),
            (-0.25, "-0.25"),
            (123_456.7, "123457"),
            (999_999.7, "1000000"),
            (1_234_567.8, "1234568"),
            (0.000_123_456_7, "0.000123457"),
            (1e-7, "1e-7"),
            (-1.234_567_8e-7, "-1.23457e-7"),
            (1.5e9, "1.5e9"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, "nan"),
        ] {
            assert_eq!(number(x), expected);
        }
        assert_eq!(
            point([0.1 + 0.2, -0.0, 1e-20 / 3.0]),
            "(0.3, 0, 3.33333e-21)"
        );
    }

    #[test]
    fn counts_that_are_not_exact_have_two_digits() {
        let all = [0.0, 7.0, 99.6, 1234.0, 449_999.0, 1e9].map(about);
        assert_eq!(all, ["0", "7", "100", "1 200", "450 000", "1 000 000 000"]);
    }

    #[test]
    fn counts_are_grouped_by_thousands() {
        assert_eq!(grouped(1_234_567), "1 234 567");
        assert_eq!(grouped(12), "12");
    }
}
