//! Dividing of edges that other solids have in common with one whose edges were divided.

use super::split::{Division, fans};
use crate::soup::surface::Surface;
use rustc_hash::FxHashMap;

/// Divides all edges that end at the same points as those `divided`, at the same corners: solids that shared triangles
/// there go on doing so, and what is closed stays closed, as all triangles at an edge are divided. Linear.
pub fn divide_alike(surface: &mut Surface, divided: &[Division]) {
    let mut corners_on: FxHashMap<[u32; 2], &Division> = FxHashMap::default();
    for division in divided {
        let [a, b] = division.ends;
        corners_on.entry([a.min(b), a.max(b)]).or_insert(division);
    }
    let chain = |a: u32, b: u32| -> Vec<u32> {
        match corners_on.get(&[a.min(b), a.max(b)]) {
            None => Vec::new(),
            Some(division) if division.ends[0] == a => division.corners.clone(),
            Some(division) => division.corners.iter().rev().copied().collect(),
        }
    };
    for t in 0..surface.triangles.len() {
        let corners = surface.triangles[t];
        let chains = [0, 1, 2].map(|i| chain(corners[i], corners[(i + 1) % 3]));
        if chains.iter().any(|chain| !chain.is_empty()) {
            surface.replace(t as u32, &fans(corners, chains));
        }
    }
    // Those with a corner that one of their edges is divided at.
    surface.drop_collapsed();
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn surface(triangles: &[[u32; 3]]) -> Surface {
        let n = triangles.len();
        Surface {
            points: vec![DVec3::ZERO; 6],
            triangles: triangles.to_vec(),
            group: vec![0; n],
            solid: vec![0; n],
            partner: vec![0; n],
            source: vec![0; n],
            groups: Vec::new(),
            solids: Vec::new(),
            group_word: "solid",
        }
    }

    #[test]
    fn edges_are_divided_both_ways_and_further() {
        let divided = [
            Division {
                ends: [0, 1],
                corners: vec![3, 4],
            },
            Division {
                ends: [4, 1],
                corners: vec![5],
            },
        ];
        let mut shared = surface(&[[0, 1, 2], [2, 1, 0], [0, 1, 3]]);
        for round in divided.chunks(1) {
            divide_alike(&mut shared, round);
        }
        let mut made = shared.triangles.clone();
        made.iter_mut().for_each(|t| t.sort_unstable());
        made.sort_unstable();
        let once = [[0, 2, 3], [1, 2, 5], [2, 3, 4], [2, 4, 5]];
        let mut expected: Vec<_> = once.iter().chain(&once).copied().collect();
        // Of the triangle that has a corner already, what lies between that one and the other end.
        expected.extend([[1, 3, 5], [3, 4, 5]]);
        expected.sort_unstable();
        assert_eq!(made, expected);
    }
}
