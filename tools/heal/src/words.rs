//! Points and counts as they appear in messages, and names.

use geom::number::significant;
use glam::DVec3;
use interchange::text::{counted, plain};
use rustc_hash::FxHashMap;

/// A point with seven significant digits per coordinate: `(0.5, -12.25, 1e-9)`.
pub fn place(p: DVec3) -> String {
    let [x, y, z] = p.to_array().map(short);
    format!("({x}, {y}, {z})")
}

/// Digits of places in messages: one more than single precision keeps whatever the number, so that
/// the place can be found in the file.
const DIGITS: usize = f32::DIGITS as usize + 1;

/// A number with seven significant digits, without trailing zeros.
pub fn short(x: f64) -> String {
    significant(x, DIGITS)
}

/// A notice about something dropped.
pub fn dropped(n: usize, one: &str, many: &str, why: &str) -> String {
    format!("{} {why}: dropped", counted(n, one, many))
}

/// Makes names unique by numbering the repeated ones, and replaces empty ones by `word` and the
/// position, counted from 1.
pub fn unique_names<'a>(names: impl Iterator<Item = &'a str>, word: &str) -> Vec<String> {
    let mut seen: FxHashMap<String, usize> = FxHashMap::default();
    let mut unique: Vec<String> = Vec::new();
    for (i, name) in names.enumerate() {
        let mut base = plain(name);
        if base.is_empty() {
            base = format!("{word}{}", i + 1);
        }
        let mut candidate = base.clone();
        while seen.contains_key(&candidate) {
            let n = seen.entry(base.clone()).or_insert(1);
            *n += 1;
            candidate = format!("{base}-{n}");
        }
        seen.insert(candidate.clone(), 1);
        unique.push(candidate);
    }
    unique
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

    #[test]
    fn names_are_made_unique() {
        let names = ["a", "a", "", "a-2", "a"];
        assert_eq!(
            unique_names(names.into_iter(), "region"),
            ["a", "a-2", "region3", "a-2-2", "a-3"]
        );
        assert_eq!(unique_names(["\u{1b}[31m\t"].into_iter(), "x"), ["[31m"]);
        assert_eq!(unique_names(["\t\u{7f}"].into_iter(), "x"), ["x1"]);
    }
}
