//! Names of sets, patches and markers, for formats that are not free in them.

use std::collections::BTreeSet;

/// Longest name that a set may have: CalculiX reads 80 characters, of which its own suffixes and the
/// numbers that make names unique take some.
const MAX_NAME: usize = 60;

/// Names of letters, digits, `_` and `-`, unique without regard to case and to those `taken`, in the same
/// order; what has no name is called so.
pub fn fitting(names: impl Iterator<Item = Option<String>>, taken: &[&str]) -> Vec<String> {
    let mut seen: BTreeSet<String> = taken.iter().map(|&name| name.to_owned()).collect();
    names
        .map(|name| {
            let name = name.unwrap_or_else(|| "unnamed".to_owned());
            let valid = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            let mut base: String = name
                .chars()
                .map(|c| if valid(c) { c } else { '_' })
                .collect();
            if !base.starts_with(|c: char| c.is_ascii_alphabetic()) {
                base.insert(0, 'n');
            }
            base.truncate(MAX_NAME);
            let mut candidate = base.clone();
            let mut n = 1;
            while !seen.insert(candidate.to_ascii_lowercase()) {
                n += 1;
                candidate = format!("{base}-{n}");
            }
            candidate
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fit_and_are_unique() {
        let names = ["liner/copper", "Liner_copper", "3rd", "all-nodes", "a b"];
        let names = names.iter().map(|n| Some((*n).to_owned()));
        let fitted = fitting(names, &["all-nodes", "all-elements"]);
        let expected = [
            "liner_copper",
            "Liner_copper-2",
            "n3rd",
            "all-nodes-2",
            "a_b",
        ];
        assert_eq!(fitted, expected);
    }
}
