//! Elements that the thin triangles of a surface cost.
//!
//! A facet is meshed by triangles of good shape, so a thin one, if nothing in its plane continues it, gets
//! elements as small as it is wide all along. Blades and other curved faces are often drawn so.

use crate::features::FLAT;
use geom::edges::Edges;
use geom::measure::{corners, double_area_vector};
use glam::DVec3;
use tmesh::{Template, Triangle};

/// Sum, over the triangles that are narrower than elements beside them, `size` in model units, and not part
/// of a larger facet, of length over width less one: elements of the estimate. `feature`: where the surface is remeshed, the cosine of the angle
/// at a feature edge; then a facet is what such edges and other faces leave together.
pub fn needles(body: &Template, size: impl Fn(&Triangle) -> f64, feature: Option<f64>) -> f64 {
    let points = |t: usize| corners(&body.vertices, body.triangles[t]);
    let normals: Vec<DVec3> = (0..body.triangles.len())
        .map(|t| {
            let [a, b, c] = points(t);
            double_area_vector(a, b, c)
        })
        .collect();
    let list: Vec<[u32; 3]> = body.triangles.iter().map(|t| t.vertices).collect();
    let edges = Edges::new(&list);
    // Longest edge and second longest of each triangle are flat: it is part of something wider.
    let mut lengths = vec![[(0.0_f64, false); 3]; list.len()];
    let mut known = vec![0_usize; list.len()];
    for (e, ends) in edges.ends.iter().enumerate() {
        let around = edges.around(e);
        let [a, b] = ends.map(|v| body.vertices[v as usize]);
        let is_flat = matches!(around, [u, v] if {
            let [m, n] = [u, v].map(|u| normals[u.triangle as usize].normalize_or_zero());
            let [s, t] = [u, v].map(|u| &body.triangles[u.triangle as usize]);
            let is_alike = (s.marker, s.front, s.back) == (t.marker, t.front, t.back);
            m.dot(n).abs() > FLAT || feature.is_some_and(|least| is_alike && m.dot(n) >= least)
        });
        for u in around {
            let t = u.triangle as usize;
            if let Some(slot) = lengths[t].get_mut(known[t]) {
                *slot = (a.distance(b), is_flat);
            }
            known[t] += 1;
        }
    }
    let mut sum = 0.0;
    for (t, mut sides) in lengths.into_iter().enumerate() {
        sides.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        let [(length, first), (_, second), _] = sides;
        let width = normals[t].length() / length;
        if !first && !second && width > 0.0 && width < size(&body.triangles[t]) {
            sum += length / width - 1.0;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::OUTSIDE;

    fn body(apex: DVec3) -> Template {
        // Two triangles, 1 long and 0.1 wide, that share their long side.
        let triangle = |vertices| Triangle {
            vertices,
            marker: 1,
            front: OUTSIDE,
            back: 1,
        };
        Template {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.1, 0.0), apex],
            triangles: vec![triangle([0, 1, 2]), triangle([1, 0, 3])],
            ..Template::default()
        }
    }

    #[test]
    fn thin_triangles_count_unless_they_are_part_of_a_wider_facet() {
        let bent = body(DVec3::new(0.5, 0.0, 0.1));
        assert!((needles(&bent, |_| 1.0, None) - 18.0).abs() < 1e-9);
        // Elements that are smaller anyway.
        assert_eq!(needles(&bent, |_| 0.05, None), 0.0);
        let flat = body(DVec3::new(0.5, -0.1, 0.0));
        assert_eq!(needles(&flat, |_| 1.0, None), 0.0);
        // Remeshed, they are narrow where they meet at a feature.
        let folded = body(DVec3::new(0.5, -0.1, 0.01));
        assert!(needles(&folded, |_| 1.0, None) > 17.0);
        assert_eq!(needles(&folded, |_| 1.0, Some(0.9)), 0.0);
        assert!((needles(&bent, |_| 1.0, Some(0.9)) - 18.0).abs() < 1e-9);
    }
}
