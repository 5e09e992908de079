//! How facets bend.

use crate::shape::smooth::facets::Facets;
use crate::shape::smooth::facets::Fold;
use glam::{DMat3, DVec3};

/// The curvature tensor of each flat, one over length, positive where the body is convex. By the divergence theorem
/// `A H = sum over the sides of length * part of the turn * m m^T`, with `A` the area and `m` the normal of a side in
/// the plane of the facet.
pub fn curvature(facets: &Facets<'_>, folds: &[Fold]) -> Vec<DMat3> {
    let mut tensor = vec![DMat3::ZERO; facets.flats.count()];
    for fold in folds {
        for (i, share) in shares(facets, fold).into_iter().enumerate() {
            let u = &fold.uses[i];
            let [a, b] = facets.ends(u);
            let out = (b - a).cross(facets.normal(u)).normalize_or_zero();
            let weight = (b - a).length() * fold.turn * share;
            tensor[fold.flats[i] as usize] += outer(out * weight, out);
        }
    }
    for (tensor, area) in tensor.iter_mut().zip(facets.areas()) {
        *tensor *= if area > 0.0 { 1.0 / area } else { 0.0 };
    }
    tensor
}

/// The parts of the turn at a fold that either facet has: in proportion to their widths, as on a circle. A polygon
/// that is more than twice as wide as what is beyond is the flat face that a rounding ends at, not one of its facets.
fn shares(facets: &Facets<'_>, fold: &Fold) -> [f64; 2] {
    let [w, x] = fold.widths;
    let is_flat = |i: usize| !facets.single[fold.flats[i] as usize] && !fold.is_like(i);
    if is_flat(0) {
        [0.0, 1.0]
    } else if is_flat(1) {
        [1.0, 0.0]
    } else {
        [w / (w + x), x / (w + x)]
    }
}

/// The matrix `a b^T`.
pub fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
