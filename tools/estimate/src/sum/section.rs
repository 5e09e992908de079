//! The body's section by radius and height.

use crate::wedge::Wedge;
use glam::{DVec2, DVec3};

/// A triangle of the section by radius and height, and the region there.
pub type SectionTriangle = ([DVec2; 3], u32);

/// Radius and height of a point.
pub fn flat(p: DVec3) -> DVec2 {
    DVec2::new(p.x.hypot(p.y), p.z)
}

/// Triangles of the body's section with each cut face of the wedge. A face that reaches over the axis is folded there.
pub fn sections(wedge: &Wedge<'_>) -> Vec<Vec<SectionTriangle>> {
    let section = |list: &Vec<u32>| {
        let corners = list.iter().flat_map(|&t| wedge.corners(t));
        let farthest =
            corners.max_by(|p, q| p.truncate().length().total_cmp(&q.truncate().length()));
        let outward = farthest.map_or(DVec2::X, DVec3::truncate);
        let mut found = Vec::new();
        for &t in list {
            let region = wedge.template.triangles[t as usize].back;
            let folded = fold(wedge.corners(t), outward);
            found.extend(folded.into_iter().map(|corners| (corners, region)));
        }
        found
    };
    wedge.sections.iter().map(section).collect()
}

/// A triangle in a plane through the axis, `outward` in it, divided where it passes the axis.
fn fold(corners: [DVec3; 3], outward: DVec2) -> Vec<[DVec2; 3]> {
    let side = corners.map(|p| p.truncate().dot(outward));
    let plain = corners.map(flat);
    if side.iter().all(|s| *s >= 0.0) || side.iter().all(|s| *s <= 0.0) {
        return vec![plain];
    }
    let on_axis = |i: usize, j: usize| {
        let share = side[i] / (side[i] - side[j]);
        DVec2::new(0.0, corners[i].z + (corners[j].z - corners[i].z) * share)
    };
    let mut found = Vec::new();
    for sign in [1.0, -1.0] {
        let mut ring = Vec::with_capacity(4);
        for i in 0..3 {
            let j = (i + 1) % 3;
            if side[i] * sign >= 0.0 {
                ring.push(plain[i]);
            }
            if side[i] * side[j] < 0.0 {
                ring.push(on_axis(i, j));
            }
        }
        found.extend((2..ring.len()).map(|k| [ring[0], ring[k - 1], ring[k]]));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_over_the_axis_is_folded_and_keeps_its_area() {
        let corner = |x: f64, z: f64| DVec3::new(0.6 * x, 0.8 * x, z);
        let corners = [corner(-1.0, 0.0), corner(2.0, 0.0), corner(0.5, 2.0)];
        let folded = fold(corners, DVec2::new(0.6, 0.8));
        assert_eq!(folded.len(), 3);
        let area = |t: &[DVec2; 3]| 0.5 * (t[1] - t[0]).perp_dot(t[2] - t[0]).abs();
        let sum: f64 = folded.iter().map(area).sum();
        assert!((sum - 3.0).abs() < 1e-12, "{sum}");
        assert!(folded.iter().flatten().all(|p| p.x >= 0.0));
    }
}
