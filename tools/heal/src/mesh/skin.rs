//! The whole surface of a tetrahedral mesh, from the triangles that a file has of it.

use rustc_hash::FxHashMap;
use tmesh::{OUTSIDE, Tet, Triangle};

/// Regions at a face: of the tetrahedron that has it with outward normal in the order of the sorted
/// corners, and of the other.
type Sides = [u32; 2];

const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Corners increasing, and whether that took an odd permutation.
fn sorted([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    let mut key = [a, b, c];
    key.sort_unstable();
    (
        key,
        key != [a, b, c] && key != [b, c, a] && key != [c, a, b],
    )
}

/// The triangles given, with the regions on their sides, and those that are missing at the boundary and
/// between regions, without marker. Also returns how many of those given are no such face: they are left
/// out. Boundaries face outwards, interfaces towards the higher region id.
///
/// Linear in the tetrahedra.
pub fn surface(tets: &[Tet], given: &[([u32; 3], u32)]) -> (Vec<Triangle>, usize) {
    let mut faces: FxHashMap<[u32; 3], Sides> = FxHashMap::default();
    faces.reserve(2 * tets.len());
    for tet in tets {
        for face in FACES {
            let (key, odd) = sorted(face.map(|c| tet.vertices[c]));
            let sides = faces.entry(key).or_insert([OUTSIDE; 2]);
            sides[usize::from(odd)] = tet.region;
        }
    }
    faces.retain(|_, sides| sides[0] != sides[1]);
    let mut triangles = Vec::with_capacity(faces.len());
    let mut dropped = 0;
    let mut add = |key: [u32; 3], sides: Sides, marker| {
        // The first side is behind the corners in increasing order.
        let [back, front] = sides;
        let [a, b, c] = key;
        triangles.push(if front > back {
            Triangle {
                vertices: [a, b, c],
                marker,
                front,
                back,
            }
        } else {
            Triangle {
                vertices: [a, c, b],
                marker,
                front: back,
                back: front,
            }
        });
    };
    for &(corners, marker) in given {
        let (key, _) = sorted(corners);
        match faces.remove(&key) {
            Some(sides) => add(key, sides, marker),
            None => dropped += 1,
        }
    }
    let mut rest: Vec<_> = faces.into_iter().collect();
    rest.sort_unstable();
    for (key, sides) in rest {
        add(key, sides, OUTSIDE);
    }
    (triangles, dropped)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surface_is_completed_and_turned() {
        let tet = |vertices, region| Tet { vertices, region };
        let tets = [tet([0, 1, 2, 3], 4), tet([0, 2, 1, 4], 2)];
        let given = [
            ([1, 0, 2], 9),
            ([0, 1, 3], 5),
            ([0, 1, 4], 6),
            ([1, 3, 4], 7),
        ];
        let (triangles, dropped) = surface(&tets, &given);
        assert_eq!((triangles.len(), dropped), (7, 1));
        // Towards region 4, whose corner 3 lies above.
        let interface = triangles[0];
        assert_eq!((interface.front, interface.back), (4, 2));
        assert_eq!((interface.vertices, interface.marker), ([0, 1, 2], 9));
        let outer = triangles[1];
        assert_eq!((outer.front, outer.back), (OUTSIDE, 4));
        assert_eq!(
            (sorted(outer.vertices), outer.marker),
            (sorted([0, 1, 3]), 5)
        );
        assert_eq!(triangles.iter().filter(|t| t.marker == OUTSIDE).count(), 4);
    }
}
