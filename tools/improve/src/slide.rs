//! Vertices that may be moved along a curved shape.

use crate::flats::Flats;
use crate::freedom::Freedom;
use crate::shape::NO_PATCH;
use geom::edges::Edges;
use geom::measure::{corners, double_area_vector};
use glam::DVec3;
use tmesh::Template;

/// The vertices of a filled template, number `own`, that are inside of a patch of a curved shape, and what they may do: those around which all
/// triangles of the surface stand for one patch, without a feature between them, none of which touches a face that is shared with another
/// template. Linear.
pub fn sliding((template, own): (&Template, usize), flats: &Flats<'_>) -> Vec<(u32, Freedom)> {
    let Some(curved) = &flats.curved else {
        return Vec::new();
    };
    let patch = |t: usize| curved.patches[flats.of_triangle[t] as usize];
    let mut shared = vec![false; template.vertices.len()];
    let beyond = template
        .gluings
        .iter()
        .filter(|g| g.other_than(own).is_some());
    let touching = beyond.flat_map(|g| g.vertices_here());
    for v in touching.chain(flats.fixed.iter().copied()) {
        shared[v as usize] = true;
    }

    let mut patches: Vec<Option<u32>> = vec![None; template.vertices.len()];
    let mut vectors = vec![DVec3::ZERO; template.vertices.len()];
    for (t, triangle) in template.triangles.iter().enumerate() {
        let [a, b, c] = corners(&template.vertices, triangle);
        let vector = double_area_vector(a, b, c);
        let is_shared = triangle.vertices.iter().any(|&v| shared[v as usize]);
        let here = if is_shared { NO_PATCH } else { patch(t) };
        for v in triangle.vertices {
            let known = patches[v as usize].get_or_insert(here);
            if *known != here {
                *known = NO_PATCH;
            }
            vectors[v as usize] += vector;
        }
    }
    let ids: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
    let edges = Edges::new(&ids);
    for (e, ends) in edges.ends.iter().enumerate() {
        let is_smooth = matches!(edges.around(e), [s, t] if s.forward != t.forward && {
            let [s, t] = [s, t].map(|u| &template.triangles[u.triangle as usize]);
            let [m, n] = [s, t].map(|t| {
                let [a, b, c] = corners(&template.vertices, t);
                double_area_vector(a, b, c).normalize_or_zero()
            });
            let kind = |t: &tmesh::Triangle| (t.marker, t.front, t.back);
            kind(s) == kind(t) && m.dot(n) > curved.feature
        });
        if !is_smooth {
            ends.iter()
                .for_each(|&v| patches[v as usize] = Some(NO_PATCH));
        }
    }
    let all = (0_u32..).zip(patches).zip(vectors);
    all.filter_map(|((v, patch), vector)| {
        let patch = patch.filter(|&patch| patch != NO_PATCH)?;
        let axes = vector.try_normalize()?.any_orthonormal_pair();
        Some((v, Freedom::Along(patch, axes.into())))
    })
    .collect()
}
