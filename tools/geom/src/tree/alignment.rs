//! A frame in which the boxes of a surface's triangles are small.
//!
//! Drawn bodies mostly have many faces across or along a few directions, but are placed anyhow; along these
//! directions, boxes of their triangles are flat or thin and hardly overlap.

use crate::eigen;
use glam::{DMat3, DVec3};

/// The rotation into such a frame, or `None` where the coordinates given are as good. Depends on the triangles,
/// given by their corners, and on their order only.
pub fn alignment(count: usize, corners: impl Fn(usize) -> [DVec3; 3]) -> Option<DMat3> {
    // One of as many triangles as a hierarchy over them has levels: so the search takes a small part of the time of
    // building that, and has enough of them.
    let step = count.checked_ilog2().unwrap_or(0).max(1) as usize;
    let sampled: Vec<[DVec3; 3]> = (0..count).step_by(step).map(&corners).collect();
    let areas: Vec<DVec3> = (sampled.iter())
        .map(|[a, b, c]| (*b - *a).cross(*c - *a))
        .collect();
    // Half the surface of all boxes.
    let cost = |frame: &DMat3| {
        let boxes = sampled.iter().map(|t| {
            let [a, b, c] = t.map(|p| *frame * p);
            let e = a.max(b).max(c) - a.min(b).min(c);
            e.x * e.y + e.y * e.z + e.z * e.x
        });
        boxes.sum::<f64>()
    };
    let given = cost(&DMat3::IDENTITY);
    let best = (main_directions(&areas).into_iter())
        .map(|z| frame(z, beside(&areas, z)))
        .map(|f| (cost(&f), f))
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 < given).then_some(best.1)
}

/// The normal of the largest face, and the direction by which the normals stand out.
fn main_directions(areas: &[DVec3]) -> Vec<DVec3> {
    let mut scatter = [[0.0; 3]; 3];
    for n in areas {
        let size = n.length();
        if size > 0.0 {
            let n = n.to_array();
            for (i, row) in scatter.iter_mut().enumerate() {
                for (j, x) in row.iter_mut().enumerate() {
                    *x += n[i] * n[j] / size;
                }
            }
        }
    }
    let eigen = eigen::symmetric(scatter);
    let [low, middle, high] = eigen.values;
    let main = if high - middle > middle - low { 2 } else { 0 };
    let largest = largest(areas.iter().copied());
    let mut all = vec![DVec3::from_array(eigen.vectors[main])];
    all.extend(largest.and_then(DVec3::try_normalize));
    all.retain(|d| d.is_finite());
    all
}

/// The direction across `z` in which the largest face is seen; any one where there is none.
fn beside(areas: &[DVec3], z: DVec3) -> DVec3 {
    // In the basis of a plane, so that what is left of normals along `z` by rounding is a direction across as well.
    let (u, v) = z.any_orthonormal_pair();
    let across = areas.iter().map(|n| u * n.dot(u) + v * n.dot(v));
    largest(across).and_then(DVec3::try_normalize).unwrap_or(u)
}

fn largest(areas: impl Iterator<Item = DVec3>) -> Option<DVec3> {
    let mut best: Option<DVec3> = None;
    for n in areas {
        if n.length_squared() > best.map_or(0.0, |b| b.length_squared()) {
            best = Some(n);
        }
    }
    best
}

/// Rotation that takes `x` and `z` to the coordinate axes.
fn frame(z: DVec3, x: DVec3) -> DMat3 {
    DMat3::from_cols(x, z.cross(x), z).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The faces of a box, in two triangles each.
    fn cuboid(turn: DMat3) -> Vec<[DVec3; 3]> {
        let size = DVec3::new(1.0, 2.0, 3.0);
        let [x, y, z] = [0, 1, 2].map(|k| DVec3::AXES[k] * size[k]);
        let sides = [(x, y, z), (y, z, x), (z, x, y)];
        let both = sides.map(|(u, v, w)| [(DVec3::ZERO, u, v), (w, u, v)]);
        let corners = |p: DVec3, u: DVec3, v: DVec3| [[p, p + u, p + u + v], [p, p + u + v, p + v]];
        both.as_flattened()
            .iter()
            .flat_map(|&(p, u, v)| corners(p, u, v))
            .map(|t| t.map(|p| turn * p))
            .collect()
    }

    #[test]
    fn a_box_placed_anyhow_is_aligned() {
        let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.64, 0.48), 1.0);
        let faces = cuboid(turn);
        let frame = alignment(faces.len(), |i| faces[i]).expect("a better frame");
        for t in &faces {
            let [a, b, c] = t.map(|p| frame * p);
            let e = a.max(b).max(c) - a.min(b).min(c);
            assert!(e.min_element() < 1e-12, "{e}");
        }
    }

    #[test]
    fn a_box_along_the_axes_stays_and_so_does_nothing_at_all() {
        let faces = cuboid(DMat3::IDENTITY);
        assert_eq!(alignment(faces.len(), |i| faces[i]), None);
        assert_eq!(alignment(0, |_| [DVec3::ZERO; 3]), None);
        assert_eq!(alignment(2, |_| [DVec3::ONE; 3]), None);
    }
}
