//! Bodies whose surface crosses itself, as rough ones may: a mesh of them is one of the union of their parts.

use serde_json::Value;

/// By how much the volume of each region is less in the union, with the region's name, as symdetect reports it. `settled`: where solids
/// overlap each other, what is known of them says which one has what both fill.
fn losses(symmetry: &Value, settled: bool) -> impl Iterator<Item = (&str, f64)> {
    let joined = &symmetry["joined"];
    let is_alone = joined["overlaps"].as_array().is_some_and(Vec::is_empty);
    let volumes = joined["volumes"].as_array();
    let volumes = volumes.filter(|_| is_alone || !settled);
    volumes.into_iter().flatten().filter_map(|of| {
        let [before, after] = ["before", "after"].map(|key| of[key].as_f64());
        Some((of["name"].as_str()?, before? - after?))
    })
}

/// Whether a body fills some space more than once; `settled`: other than where its solids overlap.
pub fn is_union(symmetry: &Value, settled: bool) -> bool {
    losses(symmetry, settled).any(|(_, loss)| loss > 0.0)
}

/// The volume that a region fills more than once, by its name in the mesh, or unless `settled` that another one has.
pub fn filled_twice(symmetry: &Value, region: &str, settled: bool) -> f64 {
    let of_region = losses(symmetry, settled).filter(|(name, _)| *name == region);
    of_region.map(|(_, loss)| loss.max(0.0)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_filled_twice_is_reported() {
        let of = |before: f64, overlaps: &[i32]| {
            let volumes = [serde_json::json!({"name": "a", "before": before, "after": 0.5})];
            serde_json::json!({"joined": {"volumes": volumes, "overlaps": overlaps}})
        };
        let report = |before: f64| of(before, &[]);
        assert!(!is_union(&of(0.75, &[1]), true) && is_union(&of(0.75, &[1]), false));
        for settled in [false, true] {
            assert!(is_union(&report(0.75), settled) && !is_union(&report(0.5), settled));
            assert!(!is_union(&serde_json::json!({"joined": null}), settled));
            assert_eq!(filled_twice(&report(0.75), "a", settled), 0.25);
            assert_eq!(filled_twice(&report(0.75), "b", settled), 0.0);
            assert_eq!(filled_twice(&serde_json::json!({}), "a", settled), 0.0);
        }
        assert_eq!(filled_twice(&of(0.75, &[1]), "a", false), 0.25);
    }
}
