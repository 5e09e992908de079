//! Real numbers of bulk data.

use crate::text::{number, significant_digits};

/// Columns of a large field, the longest number that programs read.
const WIDTH: usize = 16;

/// A real number as bulk data have it: with a point, and an exponent that may be a sign and digits
/// only, such as `1.5-3`.
pub fn parse(word: &[u8]) -> Option<f64> {
    number(&plain(word))
}

/// The number with the letter of its exponent, as other formats have it.
pub fn plain(word: &[u8]) -> Vec<u8> {
    let mut text = word.to_vec();
    let is_letter = |b: &u8| b.is_ascii_alphabetic();
    let sign = text.iter().skip(1).position(|b| matches!(b, b'+' | b'-'));
    if let Some(at) = sign
        && !text.iter().any(is_letter)
    {
        text.insert(at + 1, b'e');
    }
    text
}

/// A number in at most 16 characters: exactly where they suffice, else the nearest one that fits, which
/// is that of 14 digits behind the point for numbers below 1, and of 10 digits at least for those that
/// need an exponent.
pub fn real(x: f64) -> String {
    let fits = |text: &String| text.len() <= WIDTH;
    let exact = [fixed(&format!("{x}")), scientific(&format!("{x:e}"))];
    if let Some(short) = exact.into_iter().filter(fits).min_by_key(String::len) {
        return short;
    }
    let nearest = |form: &dyn Fn(usize) -> String| (0..WIDTH).rev().map(form).find(fits);
    let fixed = nearest(&|decimals| fixed(&format!("{x:.decimals$}")));
    // A point, and a sign and a digit of the exponent, are what the other form has beside digits.
    let most = WIDTH - usize::from(x < 0.0) - ".-1".len();
    if let Some(fixed) = &fixed
        && significant_digits(fixed.as_bytes()) as usize >= most
    {
        return fixed.clone();
    }
    let scientific = nearest(&|decimals| scientific(&format!("{x:.decimals$e}")));
    let off = |text: &String| parse(text.as_bytes()).map_or(f64::INFINITY, |y| (y - x).abs());
    let both = [fixed, scientific].into_iter().flatten();
    let found = both.min_by(|a, b| off(a).total_cmp(&off(b)));
    found.unwrap_or_else(|| "0.".to_owned())
}

/// Digits with a point, without a zero before it and zeros at the end.
fn fixed(text: &str) -> String {
    let mut text = text.to_owned();
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').len());
    } else {
        text.push('.');
    }
    match text.strip_prefix('-') {
        Some(rest) => format!("-{}", short(rest)),
        None => short(&text).to_owned(),
    }
}

fn short(text: &str) -> &str {
    match text.strip_prefix('0') {
        Some(rest) if rest.len() > 1 => rest,
        _ => text,
    }
}

/// A mantissa with a point, and the exponent as a sign and digits.
fn scientific(text: &str) -> String {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let mut mantissa = mantissa.to_owned();
    if mantissa.contains('.') {
        mantissa.truncate(mantissa.trim_end_matches('0').len());
    } else {
        mantissa.push('.');
    }
    let sign = if exponent.starts_with('-') { "" } else { "+" };
    format!("{mantissa}{sign}{exponent}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fit_their_field_and_come_back() {
        for (x, expected) in [
            (0.0, "0."),
            (-0.0, "-0."),
            (0.25, ".25"),
            (-1.0, "-1."),
            (120.0, "120."),
            (1e-9, "1.-9"),
            (-2.5e20, "-2.5+20"),
            (f64::from(0.1_f32), ".100000001490116"),
        ] {
            assert_eq!(real(x), expected);
        }
        for power in -300..300 {
            for x in [1.0 / 3.0, -0.060_699_450_194_871_274, 7.0] {
                let x = x * 10.0_f64.powi(power);
                let text = real(x);
                assert!(text.len() <= WIDTH && text.contains('.'), "{text}");
                let back = parse(text.as_bytes()).unwrap();
                assert!((back - x).abs() <= 1e-9 * x.abs(), "{x:e} {text}");
                if (-1..3).contains(&power) {
                    assert!((back - x).abs() <= 1e-11 * x.abs(), "{x:e} {text}");
                }
            }
        }
    }

    #[test]
    fn exponents_need_no_letter() {
        for (text, x) in [
            ("1.5-3", 1.5e-3),
            ("-1.5+3", -1.5e3),
            ("1.5E-3", 1.5e-3),
            ("1.5D+3", 1.5e3),
            (".5", 0.5),
            ("-7.", -7.0),
            ("+2.0", 2.0),
        ] {
            assert_eq!(parse(text.as_bytes()), Some(x), "{text}");
        }
        for odd in ["", "1.5--3", "x", "1.5-3-3"] {
            assert_eq!(parse(odd.as_bytes()), None, "{odd}");
        }
    }
}
