//! Replaces a few tetrahedra by others with the same hull.
//!
//! An inner edge goes with the ring of tetrahedra around it, which is filled by the best triangulation
//! of the ring (G. Klincsek, "Minimal triangulations of polygonal domains", 1980; J. Shewchuk, "Two
//! discrete optimization algorithms for the topological improvement of tetrahedral meshes", 2002); the face
//! between two tetrahedra goes for an edge.

use super::LEAST;
use super::mesh::{Corners, Mesh};
use geom::tet::{EDGES, FACES};

/// Tetrahedra around an edge that is removed, at most. Larger rings hardly ever give better ones.
const RING: usize = 7;
/// The smallest quality has to grow by this part.
const GAIN: f64 = 1e-2;

/// Replaces one tetrahedron and some of its neighbours by better ones; returns whether that was
/// possible.
pub fn flip(mesh: &mut Mesh<'_>, tet: u32) -> bool {
    let corners = mesh.corners(tet);
    EDGES
        .iter()
        .any(|&[i, j]| remove_edge(mesh, tet, corners[i], corners[j]))
        || FACES
            .iter()
            .enumerate()
            .any(|(i, face)| remove_face(mesh, tet, corners[i], face.map(|j| corners[j])))
}

/// Removes the edge from `a` to `b` of a tetrahedron.
fn remove_edge(mesh: &mut Mesh<'_>, tet: u32, a: u32, b: u32) -> bool {
    if mesh.is_fixed_edge(a, b) {
        return false;
    }
    let Some((old, ring)) = ring(mesh, tet, a, b) else {
        return false;
    };
    let (above, most) = mesh.bounds(&old, GAIN, LEAST);
    let region = mesh.region(tet);
    let n = ring.len();
    // The ring runs counter-clockwise seen from b.
    let pair = |i: usize, k: usize, j: usize| -> [Corners; 2] {
        [
            [ring[i], ring[k], ring[j], b],
            [ring[i], ring[j], ring[k], a],
        ]
    };
    let quality = |i: usize, k: usize, j: usize| {
        let mut least = f64::INFINITY;
        for corners in pair(i, k, j) {
            let grade = mesh.of_corners(corners);
            if !mesh.fits(region, grade.six_volume, most) {
                return -1.0;
            }
            least = least.min(grade.quality);
            if least <= above {
                break;
            }
        }
        least
    };
    // Best smallest quality of the polygon from i to j, and the corner opposite to that side.
    let mut best = [[f64::INFINITY; RING]; RING];
    let mut apex = [[0_usize; RING]; RING];
    for span in 2..n {
        for i in 0..n - span {
            let j = i + span;
            best[i][j] = -1.0;
            for k in i + 1..j {
                let parts = best[i][k].min(best[k][j]);
                if parts <= best[i][j] || parts <= above {
                    continue;
                }
                let whole = parts.min(quality(i, k, j));
                if whole > best[i][j] {
                    best[i][j] = whole;
                    apex[i][j] = k;
                }
            }
        }
    }
    if best[0][n - 1] <= above {
        return false;
    }
    let mut new = Vec::with_capacity(2 * (n - 2));
    let mut open = vec![(0, n - 1)];
    while let Some((i, j)) = open.pop() {
        if j - i >= 2 {
            let k = apex[i][j];
            new.extend(pair(i, k, j));
            open.extend([(i, k), (k, j)]);
        }
    }
    mesh.replace(&old, &new);
    true
}

/// The tetrahedra around an inner edge of a region, and the vertices around it, counter-clockwise seen
/// from `b`.
fn ring(mesh: &Mesh<'_>, tet: u32, a: u32, b: u32) -> Option<(Vec<u32>, Vec<u32>)> {
    let region = mesh.region(tet);
    let mut old = Vec::with_capacity(RING);
    for &t in mesh.star(a) {
        if mesh.corners(t).contains(&b) {
            if old.len() == RING || mesh.region(t) != region {
                return None;
            }
            old.push(t);
        }
    }
    if old.len() < 3 {
        return None;
    }
    let mut steps = Vec::with_capacity(RING);
    for &t in &old {
        steps.push(opposite_side(mesh.corners(t), a, b)?);
    }
    let first = steps[0][0];
    let mut around = Vec::with_capacity(RING);
    let mut here = first;
    for _ in 0..steps.len() {
        around.push(here);
        here = steps.iter().find(|s| s[0] == here)?[1];
    }
    let whole = here == first && (1..around.len()).all(|i| around[i] != first);
    whole.then_some((old, around))
}

/// The two corners that are neither `a` nor `b`, in the order that is counter-clockwise about the way from
/// `a` to `b`, seen from `b`: so that the tetrahedron (a, c, d, b) is positive.
fn opposite_side(corners: Corners, a: u32, b: u32) -> Option<[u32; 2]> {
    let i = corners.iter().position(|&v| v == a)?;
    let j = corners.iter().position(|&v| v == b)?;
    let mut rest = (0..4).filter(|&k| k != i && k != j);
    let (k, l) = (rest.next()?, rest.next()?);
    let (c, d) = (corners[k], corners[l]);
    // Parity of (i, k, l, j) as a permutation of the corners.
    let order = [i, k, l, j];
    let mut inversions = 0;
    for x in 0..4 {
        inversions += (x + 1..4).filter(|&y| order[x] > order[y]).count();
    }
    Some(if inversions % 2 == 0 { [c, d] } else { [d, c] })
}

/// Removes the face opposite to `top` of a tetrahedron, for an edge to the other side's apex.
fn remove_face(mesh: &mut Mesh<'_>, tet: u32, top: u32, face: [u32; 3]) -> bool {
    if mesh.is_fixed_face(face) {
        return false;
    }
    let region = mesh.region(tet);
    let other = mesh.star(face[0]).iter().copied().find(|&t| {
        let corners = mesh.corners(t);
        t != tet && face.iter().all(|v| corners.contains(v))
    });
    let Some(other) = other.filter(|&t| mesh.region(t) == region) else {
        return false;
    };
    let apex = mesh.corners(other).into_iter().find(|v| !face.contains(v));
    let Some(bottom) = apex else {
        return false;
    };
    let old = [tet, other];
    let (above, most) = mesh.bounds(&old, GAIN, LEAST);
    // The face is counter-clockwise seen from the bottom.
    let new = [0, 1, 2].map(|i| [face[i], face[(i + 1) % 3], top, bottom]);
    let good = new.iter().all(|&corners| {
        let grade = mesh.of_corners(corners);
        grade.quality > above && mesh.fits(region, grade.six_volume, most)
    });
    if good {
        mesh.replace(&old, &new);
    }
    good
}
