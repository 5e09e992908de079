//! Bodies whose surface crosses itself, as rough ones may: a mesh of them is one of the union of their parts.

use serde_json::Value;

/// By how much the volume of each region is less in the union, with the region's name, as symdetect reports it. Where solids
/// overlap each other, what is known of them says which one has what both fill.
fn losses(symmetry: &Value) -> impl Iterator<Item = (&str, f64)> {
    let joined = &symmetry["joined"];
    let is_alone = joined["overlaps"].as_array().is_some_and(Vec::is_empty);
    let volumes = joined["volumes"].as_array().filter(|_| is_alone);
    volumes.into_iter().flatten().filter_map(|of| {
        let [before, after] = ["before", "after"].map(|key| of[key].as_f64());
        Some((of["name"].as_str()?, before? - after?))
    })
}

/// Whether a body fills some space more than once.
pub fn is_union(symmetry: &Value) -> bool {
    losses(symmetry).any(|(_, loss)| loss > 0.0)
}

/// The volume that a region fills more than once, by its name in the mesh.
pub fn filled_twice(symmetry: &Value, region: &str) -> f64 {
    let of_region = losses(symmetry).filter(|(name, _)| *name == region);
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
        assert!(!is_union(&of(0.75, &[1])));
        assert!(is_union(&report(0.75)) && !is_union(&report(0.5)));
        assert!(!is_union(&serde_json::json!({"joined": null})));
        assert_eq!(filled_twice(&report(0.75), "a"), 0.25);
        assert_eq!(filled_twice(&report(0.75), "b"), 0.0);
        assert_eq!(filled_twice(&serde_json::json!({}), "a"), 0.0);
    }
}
