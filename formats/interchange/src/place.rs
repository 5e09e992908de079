//! Points and counts as they appear in messages.

use glam::DVec3;

/// A point with seven significant digits per coordinate: `(0.5, -12.25, 1e-9)`.
pub fn place(p: DVec3) -> String {
    let [x, y, z] = p.to_array().map(short);
    format!("({x}, {y}, {z})")
}

/// A number with seven significant digits, without trailing zeros.
pub fn short(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 || !x.is_finite() {
        return format!("{x}").replace("-0", "0");
    }
    if (1e-4..1e7).contains(&size) {
        let decimals = (6 - size.log10().floor() as i32).max(0) as usize;
        return trimmed(&format!("{x:.decimals$}")).to_owned();
    }
    let text = format!("{x:.6e}");
    let at = text.find('e').unwrap_or(text.len());
    format!("{}{}", trimmed(&text[..at]), &text[at..])
}

fn trimmed(number: &str) -> &str {
    if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        number
    }
}

/// `1 edge`, `2 edges`.
pub fn counted(n: usize, one: &str, many: &str) -> String {
    if n == 1 {
        format!("1 {one}")
    } else {
        format!("{n} {many}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_short() {
        let p = DVec3::new(0.1 + 0.2, -0.0, 1e-20 / 3.0);
        assert_eq!(place(p), "(0.3, 0, 3.333333e-21)");
        assert_eq!(short(-1234567.0), "-1234567");
        assert_eq!(short(2e9), "2e9");
    }
}
