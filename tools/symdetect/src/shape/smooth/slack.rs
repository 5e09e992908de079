//! How well the shape behind facets is known.

use crate::shape::smooth::facets::{Facets, Fold};
use crate::shape::smooth::heights::Heights;
use crate::shape::table::Table;
use glam::{DMat3, DVec3};
use std::f64::consts::SQRT_2;

/// What heights above each flat differ by from those that the facets next to it tell.
pub fn slack(
    facets: &Facets<'_>,
    around: &Table,
    (folds, curvature, least): (&[Fold], &[DMat3], f64),
    heights: &mut [Heights],
) {
    let angles: Vec<[f64; 3]> = (0..facets.triangles.len())
        .map(|t| angles(facets.corners(t)))
        .collect();
    let mut slack = vec![0.0_f64; facets.flats.count()];
    for (t, &flat) in facets.flats.of.iter().enumerate() {
        let mut known = f64::from(heights[t].slack);
        if facets.single[flat as usize] {
            known = known.max(from_normals(
                (facets, around, &angles, least),
                t,
                &heights[t],
            ));
        }
        let s = &mut slack[flat as usize];
        *s = s.max(known);
    }
    for fold in folds {
        for (flat, off) in from_neighbours(facets, fold, curvature) {
            let s = &mut slack[flat as usize];
            *s = s.max(off);
        }
    }
    for (heights, &flat) in heights.iter_mut().zip(&facets.flats.of) {
        heights.slack = slack[flat as usize] as f32;
    }
}

/// The difference between the heights above the sides of a triangle and those that the normals at its corners tell,
/// which are means of those of the facets around.
fn from_normals(
    (facets, around, angles, least): (&Facets<'_>, &Table, &[[f64; 3]], f64),
    t: usize,
    heights: &Heights,
) -> f64 {
    let corners = facets.triangles[t];
    let normal = |v: u32| {
        let smooth = |s: &&u32| facets.normals[**s as usize].dot(facets.normals[t]) >= least;
        let weighted = |s: &u32| {
            let s = *s as usize;
            let at = facets.triangles[s].iter().position(|w| *w == v);
            facets.normals[s] * angles[s][at.unwrap_or(0)]
        };
        let sum: DVec3 = around.of(v).iter().filter(smooth).map(weighted).sum();
        sum.normalize_or_zero()
    };
    let normals = corners.map(normal);
    let off = |c: usize| {
        let d = (c + 1) % 3;
        let [p, q] = [c, d].map(|i| facets.vertices[corners[i] as usize]);
        // A cubic with these slopes at its ends, and what it is beside a parabola: where it bends both ways, it is above
        // the side on one half of it and below on the other.
        let height = 0.125 * (q - p).dot(normals[d] - normals[c]);
        let bends_both_ways = 0.125 * (q - p).dot(normals[c] + normals[d]).abs();
        (height - f64::from(heights.side[c])).abs() + bends_both_ways
    };
    [0, 1, 2].map(off).into_iter().fold(0.0, f64::max)
}

/// The angles of a triangle at its corners.
fn angles(corners: [DVec3; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let [a, b, c] = [0, 1, 2].map(|k| corners[(i + k) % 3]);
        let (p, q) = (b - a, c - a);
        libm::atan2(p.cross(q).length(), p.dot(q))
    })
}

/// What the difference in curvature of the facets at a fold makes of the height over the middle of either, `H w^2 / 8`
/// of a facet that is `w` wide; no more than the height of the fold itself, a quarter of the turn times the width.
fn from_neighbours(facets: &Facets<'_>, fold: &Fold, curvature: &[DMat3]) -> [(u32, f64); 2] {
    // Compared as if the facets were unfolded into one plane.
    let unfolded = |i: usize| {
        let u = &fold.uses[i];
        let [a, b] = facets.ends(u);
        let along = (b - a).normalize_or_zero();
        let out = along.cross(facets.normal(u));
        let h = curvature[fold.flats[i] as usize];
        // Both axes of the second facet point the other way, so that products of two do not.
        let mixed = out.dot(h * along);
        DVec3::new(out.dot(h * out), SQRT_2 * mixed, along.dot(h * along))
    };
    let difference = (unfolded(0) - unfolded(1)).length();
    [0, 1].map(|i| {
        let (own, other) = (fold.widths[i], fold.widths[1 - i]);
        let single = facets.single[fold.flats[i] as usize];
        let width = if single { own } else { own.min(other) };
        let height = 0.125 * difference * width * other;
        (fold.flats[i], height.min(0.25 * fold.turn.abs() * width))
    })
}
