//! Radii at which there is no room for the wall of a hub.

use crate::wedge::Wedge;
use glam::{DVec2, DVec3};

/// The intervals of radius, increasing and disjoint, that faces nearer to the axis' direction than to the radial one
/// cover, model units.
pub fn steep(wedge: &Wedge<'_>) -> Vec<[f64; 2]> {
    let mut covered = Vec::new();
    for t in wedge.body() {
        let corners = wedge.corners(t);
        let [a, b, c] = corners;
        let normal = geom::measure::double_area_vector(a, b, c);
        if normal.z.abs() < normal.truncate().length() {
            let flat = corners.map(DVec3::truncate);
            let near = (0..3).map(|k| from_origin(flat[k], flat[(k + 1) % 3]));
            let far = flat.iter().fold(0.0_f64, |m, p| m.max(p.length()));
            covered.push([near.fold(f64::INFINITY, f64::min), far]);
        }
    }
    merged(covered)
}

/// Distance of a segment from the origin.
fn from_origin(a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let t = (-a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    if t.is_nan() {
        a.length()
    } else {
        (a + along * t).length()
    }
}

fn merged(mut intervals: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    intervals.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut merged: Vec<[f64; 2]> = Vec::new();
    for i in intervals {
        match merged.last_mut() {
            Some(last) if i[0] <= last[1] => last[1] = last[1].max(i[1]),
            _ => merged.push(i),
        }
    }
    merged
}
