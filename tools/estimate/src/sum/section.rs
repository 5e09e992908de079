//! The body's section by radius and height.

use crate::wedge::Wedge;
use glam::{DVec2, DVec3};

/// A triangle of the section by radius and height, and the region there.
pub type SectionTriangle = ([DVec2; 3], u32);

/// Radius and height of a point.
pub fn flat(p: DVec3) -> DVec2 {
    DVec2::new(p.x.hypot(p.y), p.z)
}

/// Triangles of the body's section with each cut face of the wedge. Either side of a face that reaches over the axis is one of its own: what is on one side
/// lies nowhere near to what is on the other.
pub fn sections(wedge: &Wedge<'_>) -> Vec<Vec<SectionTriangle>> {
    let section = |list: &Vec<u32>| {
        let corners = list.iter().flat_map(|&t| wedge.corners(t));
        let farthest =
            corners.max_by(|p, q| p.truncate().length().total_cmp(&q.truncate().length()));
        let outward = farthest.map_or(DVec2::X, DVec3::truncate);
        let mut sides: [Vec<SectionTriangle>; 2] = Default::default();
        for &t in list {
            let region = wedge.template.triangles[t as usize].back;
            let divided = divided(wedge.corners(t), outward);
            for (side, parts) in sides.iter_mut().zip(divided) {
                side.extend(parts.into_iter().map(|corners| (corners, region)));
            }
        }
        sides.into_iter().filter(|side| !side.is_empty())
    };
    wedge.sections.iter().flat_map(section).collect()
}

/// What of a triangle in a plane through the axis, `outward` in it, is on that side of the axis, and what is on the other.
fn divided(corners: [DVec3; 3], outward: DVec2) -> [Vec<[DVec2; 3]>; 2] {
    let side = corners.map(|p| p.truncate().dot(outward));
    let plain = corners.map(flat);
    let on_axis = |i: usize, j: usize| {
        let share = side[i] / (side[i] - side[j]);
        DVec2::new(0.0, corners[i].z + (corners[j].z - corners[i].z) * share)
    };
    [1.0, -1.0].map(|sign| {
        if side.iter().all(|s| s * sign >= 0.0) {
            return vec![plain];
        }
        if side.iter().all(|s| s * sign <= 0.0) {
            return Vec::new();
        }
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
        (2..ring.len())
            .map(|k| [ring[0], ring[k - 1], ring[k]])
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_over_the_axis_is_divided_there_and_keeps_its_area() {
        let corner = |x: f64, z: f64| DVec3::new(0.6 * x, 0.8 * x, z);
        let corners = [corner(-1.0, 0.0), corner(2.0, 0.0), corner(0.5, 2.0)];
        let sides = divided(corners, DVec2::new(0.6, 0.8));
        assert_eq!(sides.each_ref().map(Vec::len), [2, 1]);
        let area = |t: &[DVec2; 3]| 0.5 * (t[1] - t[0]).perp_dot(t[2] - t[0]).abs();
        let areas = sides
            .each_ref()
            .map(|side| side.iter().map(area).sum::<f64>());
        assert!(
            (areas[0] - 7.0 / 3.0).abs() < 1e-12 && (areas[1] - 2.0 / 3.0).abs() < 1e-12,
            "{areas:?}"
        );
        assert!(sides.iter().flatten().flatten().all(|p| p.x >= 0.0));
        // What is on one side is there as it is.
        let far = [corner(1.0, 0.0), corner(2.0, 0.0), corner(0.5, 2.0)];
        assert_eq!(
            divided(far, DVec2::new(0.6, 0.8)).map(|side| side.len()),
            [1, 0]
        );
        assert_eq!(
            divided(far, DVec2::new(-0.6, -0.8)).map(|side| side.len()),
            [0, 1]
        );
    }
}
