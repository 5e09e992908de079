//! Replaces a few tetrahedra by others with the same hull.
//!
//! An edge goes with the ring of tetrahedra around it, which is filled by the best triangulation
//! of the ring (G. Klincsek, "Minimal triangulations of polygonal domains", 1980; J. Shewchuk, "Two
//! discrete optimization algorithms for the topological improvement of tetrahedral meshes", 2002); the face
//! between two tetrahedra goes for an edge. Around an edge inside of a flat facet of the surface, the ring is open.

use crate::mesh::{Corners, Mesh};
use crate::quality::{GAIN, Grade, HALF_DIGITS};
use crate::surface::Diagonal;
use arrayvec::ArrayVec;
use geom::tet::{EDGES, FACES};

/// Tetrahedra around an edge that is removed, at most. Larger rings hardly ever give better ones.
const RING: usize = 7;

/// Most tetrahedra in the place of those around an edge.
const FILLING: usize = 2 * (RING - 2);

/// Tetrahedra, and those that are better in their place.
pub struct Flip {
    old: Ring,
    new: ArrayVec<(Corners, Grade), FILLING>,
    /// The edge of the surface that goes.
    diagonal: Option<Diagonal>,
}

impl Flip {
    /// Puts the better ones in their place.
    pub fn apply(&self, mesh: &mut Mesh<'_>) {
        mesh.renew();
        mesh.replace(&self.old, &self.new);
        if let Some(diagonal) = self.diagonal {
            mesh.replace_diagonal(diagonal);
        }
    }
}

/// What could replace one tetrahedron and some of its neighbours. Depends on what there is at its corners only.
pub fn find(mesh: &Mesh<'_>, tet: u32) -> Option<Flip> {
    let corners = mesh.corners(tet);
    EDGES
        .iter()
        .find_map(|&[i, j]| remove_edge(mesh, tet, corners[i], corners[j]))
        .or_else(|| {
            let mut faces = FACES.iter().enumerate();
            faces.find_map(|(i, face)| remove_face(mesh, tet, corners[i], face.map(|j| corners[j])))
        })
}

/// Removes the edge from `a` to `b` of a tetrahedron.
fn remove_edge(mesh: &Mesh<'_>, tet: u32, a: u32, b: u32) -> Option<Flip> {
    if mesh.is_fixed_edge(a, b) {
        return None;
    }
    let Around {
        old,
        ring,
        diagonal,
    } = around(mesh, tet, a, b)?;
    let (above, most) = mesh.bounds(&old, GAIN, HALF_DIGITS);
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
        return None;
    }
    let mut new = ArrayVec::new();
    let mut open = ArrayVec::<_, RING>::from_iter([(0, n - 1)]);
    while let Some((i, j)) = open.pop() {
        if j - i >= 2 {
            let k = apex[i][j];
            new.extend(pair(i, k, j).map(|corners| (corners, mesh.of_corners(corners))));
            open.extend([(i, k), (k, j)]);
        }
    }
    Some(Flip { old, new, diagonal })
}

/// Tetrahedra or vertices around an edge.
pub type Ring = ArrayVec<u32, RING>;

/// What is around an edge.
pub struct Around {
    /// The tetrahedra.
    pub old: Ring,
    /// The vertices, counter-clockwise seen from the edge's end.
    pub ring: Ring,
    /// Where the ring is open: the edge of the surface, and that from the last to the first of the vertices.
    pub diagonal: Option<Diagonal>,
}

/// What is around an edge from `a` to `b` inside of a region, or inside of a flat facet around one.
pub fn around(mesh: &Mesh<'_>, tet: u32, a: u32, b: u32) -> Option<Around> {
    let region = mesh.region(tet);
    let mut old = Ring::new();
    for &t in mesh.star(a) {
        if mesh.corners(t).contains(&b) {
            if old.is_full() || mesh.region(t) != region {
                return None;
            }
            old.push(t);
        }
    }
    let mut steps = ArrayVec::<_, RING>::new();
    for &t in &old {
        steps.push(opposite_side(mesh.corners(t), a, b)?);
    }
    let open = steps
        .iter()
        .find(|s| steps.iter().all(|other| other[1] != s[0]));
    let first = open.or(steps.first())?[0];
    let mut ring = Ring::from_iter([first]);
    let mut here = first;
    for _ in &steps {
        here = steps.iter().find(|s| s[0] == here)?[1];
        if here == first {
            break;
        }
        ring.try_push(here).ok()?;
    }
    let diagonal = open.map(|_| Diagonal {
        old: [a, b],
        new: [first, here],
    });
    let whole = ring.len() == steps.len() + usize::from(diagonal.is_some());
    let is_free = diagonal.is_none_or(|d| mesh.surface().has(d));
    (ring.len() >= 3 && whole && is_free).then_some(Around {
        old,
        ring,
        diagonal,
    })
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
fn remove_face(mesh: &Mesh<'_>, tet: u32, top: u32, face: [u32; 3]) -> Option<Flip> {
    if mesh.is_fixed_face(face) {
        return None;
    }
    let region = mesh.region(tet);
    let other = mesh.star(face[0]).iter().copied().find(|&t| {
        let corners = mesh.corners(t);
        t != tet && face.iter().all(|v| corners.contains(v))
    });
    let other = other.filter(|&t| mesh.region(t) == region)?;
    let apex = mesh.corners(other).into_iter().find(|v| !face.contains(v));
    let bottom = apex?;
    let old = [tet, other];
    let (above, most) = mesh.bounds(&old, GAIN, HALF_DIGITS);
    // The face is counter-clockwise seen from the bottom.
    let mut new = ArrayVec::new();
    for i in 0..3 {
        let corners = [face[i], face[(i + 1) % 3], top, bottom];
        let grade = mesh.of_corners(corners);
        let good = grade.quality > above && mesh.fits(region, grade.six_volume, most);
        if !good {
            return None;
        }
        new.push((corners, grade));
    }
    let old = old.into_iter().collect();
    Some(Flip {
        old,
        new,
        diagonal: None,
    })
}
