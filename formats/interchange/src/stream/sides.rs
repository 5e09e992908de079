//! Which tetrahedron each surface triangle is a face of, and which triangles share a label.

use super::Label;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Template};

/// No tetrahedron.
pub const NONE: u32 = u32::MAX;

/// Corners of the faces of a tetrahedron, by the vertex that each lies opposite to; outward normals.
pub(crate) const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// For each triangle of a template the tetrahedron behind it, or in front of it where there is none
/// behind, and the position of the vertex opposite to it; ([`NONE`], 0) when it is no face.
///
/// Linear in triangles and tetrahedra.
pub fn face_tets(template: &Template) -> Vec<(u32, u8)> {
    let mut of_face: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    of_face.reserve(template.triangles.len());
    for (i, triangle) in template.triangles.iter().enumerate() {
        of_face.insert(sorted(triangle.vertices).0, i as u32);
    }
    let mut found = vec![(NONE, 0); template.triangles.len()];
    for (t, tet) in template.tets.iter().enumerate() {
        for (opposite, corners) in FACES.iter().enumerate() {
            let (key, odd) = sorted(corners.map(|c| tet.vertices[c]));
            let Some(&i) = of_face.get(&key) else {
                continue;
            };
            let behind = sorted(template.triangles[i as usize].vertices).1 == odd;
            let entry = &mut found[i as usize];
            if behind || entry.0 == NONE {
                *entry = (t as u32, opposite as u8);
            }
        }
    }
    found
}

/// The corners increasing, and whether that took an odd permutation.
fn sorted([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    let mut key = [a, b, c];
    key.sort_unstable();
    let odd = key != [a, b, c] && key != [b, c, a] && key != [c, a, b];
    (key, odd)
}

/// The label of a triangle on no wall.
pub fn marker_label(marker: u32) -> Label {
    if marker == OUTSIDE {
        Label::Unnamed
    } else {
        Label::Marker(marker)
    }
}

/// The given triangles of a template sorted into lists by label, each in the order given.
pub fn by_label(triangles: impl Iterator<Item = (u32, Label)>) -> BTreeMap<Label, Vec<u32>> {
    let mut lists: BTreeMap<Label, Vec<u32>> = BTreeMap::new();
    // Labels come in long runs.
    let mut run: Option<(Label, Vec<u32>)> = None;
    for (triangle, label) in triangles {
        match &mut run {
            Some((at, list)) if *at == label => list.push(triangle),
            _ => {
                let next = lists.remove(&label).unwrap_or_default();
                if let Some((at, list)) = run.replace((label, next)) {
                    lists.insert(at, list);
                }
                if let Some((_, list)) = &mut run {
                    list.push(triangle);
                }
            }
        }
    }
    lists.extend(run);
    lists
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use tmesh::{Tet, Triangle};

    #[test]
    fn an_interface_belongs_to_the_tetrahedron_behind_it() {
        let tet = |vertices| Tet {
            vertices,
            region: 1,
        };
        let triangle = |vertices| Triangle {
            vertices,
            marker: 1,
            front: 1,
            back: 1,
        };
        let mut template = Template {
            vertices: vec![DVec3::ZERO; 6],
            tets: vec![tet([0, 1, 2, 3]), tet([0, 2, 1, 4])],
            triangles: vec![
                triangle([0, 1, 2]),
                triangle([2, 1, 0]),
                triangle([1, 2, 3]),
                triangle([0, 1, 5]),
            ],
            ..Template::default()
        };
        template.triangles.remove(1);
        // Outward of the second tetrahedron is 0 1 2: it is behind.
        assert_eq!(face_tets(&template), [(1, 3), (0, 0), (NONE, 0)]);
        template.triangles[0].vertices = [0, 2, 1];
        assert_eq!(face_tets(&template)[0], (0, 3));
    }

    #[test]
    fn lists_keep_their_order() {
        let labels = [2, 2, 1, 2, OUTSIDE, 1].map(marker_label);
        let lists = by_label((0..).zip(labels));
        let expected = [
            (Label::Marker(1), vec![2, 5]),
            (Label::Marker(2), vec![0, 1, 3]),
            (Label::Unnamed, vec![4]),
        ];
        assert!(lists.into_iter().eq(expected));
    }
}
