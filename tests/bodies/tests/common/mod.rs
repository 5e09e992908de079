//! What is checked of bodies.

use bodies::Body;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Area of a regular polygon.
pub fn polygon(order: u32, radius: f64) -> f64 {
    let n = f64::from(order);
    0.5 * n * radius * radius * (2.0 * PI / n).sin()
}

/// Checks the volume of every material.
#[track_caller]
pub fn has_volumes(body: &Body, expected: &[f64]) {
    assert_eq!(body.materials.len(), expected.len());
    for (material, &expected) in expected.iter().enumerate() {
        let found = body.volume(material);
        let error = (found - expected).abs() / expected;
        assert!(error < 1e-11, "material {material}: {found} for {expected}");
    }
}

/// Every directed edge of a solid has its opposite, equally often.
#[track_caller]
pub fn is_closed(body: &Body) {
    for material in 0..body.materials.len() {
        let mut edges: BTreeMap<(u32, u32), i32> = BTreeMap::new();
        for [a, b, c] in body.solid(material) {
            for (u, v) in [(a, b), (b, c), (c, a)] {
                *edges.entry((u.min(v), u.max(v))).or_default() += if u < v { 1 } else { -1 };
            }
        }
        assert!(edges.values().all(|&count| count == 0));
        assert!(body.volume(material) > 0.0);
    }
}
