//! Numbers as CalculiX reads them.

/// A number in at most 20 characters, all that CalculiX reads of one; 14 significant digits where the
/// shortest exact form is longer.
pub fn coordinate(x: f64) -> String {
    let exact = format!("{x:?}");
    if exact.len() <= 20 {
        return exact;
    }
    let digits = format!("{x:.13e}");
    if digits.len() <= 20 {
        return digits;
    }
    format!("{x:.12e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fit_their_field() {
        for x in [
            0.0,
            1.0 / 3.0,
            -0.060_699_450_194_871_274,
            -1.0 / 3e17,
            -1.0 / 3e200,
        ] {
            let text = coordinate(x);
            assert!(text.len() <= 20, "{text}");
            let back: f64 = text.parse().unwrap();
            assert!((back - x).abs() <= 1e-12 * x.abs(), "{text}");
        }
        assert_eq!(coordinate(0.25), "0.25");
    }
}
