//! Shapes that are known.

use super::{Reading, SmoothShape};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

const READING: Reading = Reading {
    flat: 1e-9,
    feature: 0.866_025_403_784_438_6,
};

/// Points at radii and heights, so many around the axis, and the quadrilaterals between them as two triangles each.
fn lathe(profile: &[(f64, f64)], around: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let place = |&(r, z): &(f64, f64), k: u32| {
        let a = TAU * f64::from(k) / f64::from(around);
        DVec3::new(r * libm::cos(a), r * libm::sin(a), z)
    };
    let points = profile
        .iter()
        .flat_map(|p| (0..around).map(move |k| place(p, k)));
    let mut triangles = Vec::new();
    for i in 0..profile.len() as u32 - 1 {
        for k in 0..around {
            let next = (k + 1) % around;
            let [a, b, c, d] = [
                i * around + k,
                i * around + next,
                (i + 1) * around + next,
                (i + 1) * around + k,
            ];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (points.collect(), triangles)
}

/// The largest distance from the shape to where it is to be, over points of all triangles.
fn farthest(points: &[DVec3], triangles: &[[u32; 3]], off: impl Fn(DVec3) -> f64) -> f64 {
    let shape = SmoothShape::new(points, triangles, READING);
    let mut most = 0.0_f64;
    for (t, corners) in (0..).zip(triangles) {
        let [a, b, c] = corners.map(|v| points[v as usize]);
        for (u, v) in [
            (0.5, 0.5),
            (0.5, 0.0),
            (0.25, 0.0),
            (0.3, 0.4),
            (1.0, 0.0),
            (0.1, 0.8),
        ] {
            let p = a + u * (b - a) + v * (c - a);
            most = most.max(off(p + shape.above(&[shape.facet(t)], p)).abs());
        }
    }
    most
}

#[test]
fn a_prism_is_a_cylinder() {
    let (points, triangles) = lathe(&[(1.0, 0.0), (1.0, 2.0)], 16);
    let off = |p: DVec3| p.truncate().length() - 1.0;
    // An arc of 22.5 degrees is 0.0192 high, and a parabola of this height is off it by a quarter of a per cent.
    assert!(farthest(&points, &triangles, off) < 6e-5);
    assert!(farthest(&points, &triangles, |p| p.z - p.z.clamp(0.0, 2.0)) < 1e-12);
}

#[test]
fn facets_of_a_sphere_are_a_sphere() {
    // Between the polar circles: borders are curves.
    let rings: Vec<(f64, f64)> = (2..=14)
        .map(|i| PI * f64::from(i) / 16.0)
        .map(|a| (libm::sin(a), -libm::cos(a)))
        .collect();
    let (points, triangles) = lathe(&rings, 32);
    // What the facets hide, the half diagonal of one squared and halved, is 0.0096.
    assert!(farthest(&points, &triangles, |p| p.length() - 1.0) < 1.5e-4);
}

#[test]
fn points_that_divide_facets_make_no_difference() {
    let (mut points, mut triangles) = lathe(&[(1.0, 0.0), (1.0, 2.0)], 16);
    // One more in the middle of every triangle, and one on an edge at the border.
    for [a, b, c] in std::mem::take(&mut triangles) {
        let middle = points.len() as u32;
        points.push((points[a as usize] + points[b as usize] + points[c as usize]) / 3.0);
        triangles.extend([[a, b, middle], [b, c, middle], [c, a, middle]]);
    }
    let first = triangles[0];
    let on_edge = points.len() as u32;
    points.push(0.7 * points[first[0] as usize] + 0.3 * points[first[1] as usize]);
    triangles[0] = [first[0], on_edge, first[2]];
    triangles.push([on_edge, first[1], first[2]]);
    let off = |p: DVec3| p.truncate().length() - 1.0;
    assert!(farthest(&points, &triangles, off) < 6e-5);
}

#[test]
fn prisms_of_few_sides_and_ridges_of_roofs_are_what_they_are() {
    let (points, triangles) = lathe(&[(1.0, 0.0), (1.0, 2.0)], 8);
    assert!(SmoothShape::new(&points, &triangles, READING).is_drawn());
    let roof = [(-1.0, 0.0), (0.0, 0.15), (1.0, 0.0)];
    let points: Vec<DVec3> = (roof.iter())
        .flat_map(|&(x, z)| [0.0, 1.0].map(|y| DVec3::new(x, y, z)))
        .collect();
    let triangles = [[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]];
    assert!(SmoothShape::new(&points, &triangles, READING).is_drawn());
}
