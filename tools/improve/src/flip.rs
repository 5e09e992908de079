//! Replaces a few tetrahedra by others with the same hull.
//!
//! An edge goes with the ring of tetrahedra around it, which is filled by the best triangulation
//! of the ring (G. Klincsek, "Minimal triangulations of polygonal domains", 1980; J. Shewchuk, "Two
//! discrete optimization algorithms for the topological improvement of tetrahedral meshes", 2002); the face
//! between two tetrahedra goes for an edge. Around an edge inside of a flat facet, of what stands for a
//! curved shape, or of a seam, the ring is open, and there may be another one on the other side.

use crate::mesh::{Corners, Mesh};
use crate::quality::{GAIN, Grade, HALF_DIGITS};
use crate::surface::{Beyond, Diagonal};
use arrayvec::ArrayVec;
use geom::tet::{EDGES, FACES};

/// Tetrahedra around an edge that is removed, at most. Larger rings hardly ever give better ones.
const RING: usize = 7;

/// Most tetrahedra in the place of those around an edge.
const FILLING: usize = 2 * (RING - 2);

/// Tetrahedra, and those that are better in their place.
pub struct Flip {
    /// Around an edge inside of the surface, those on both sides of it.
    parts: ArrayVec<Part, 2>,
    /// The edge of the surface that goes.
    diagonal: Option<Diagonal>,
}

/// Tetrahedra of one region that are replaced.
struct Part {
    old: Old,
    new: Filling,
}

/// Which ones: their numbers change when others are replaced.
enum Old {
    /// Those of a region at an edge.
    Edge(u32, [u32; 2]),
    /// The two at a face.
    Face([u32; 2]),
}

/// Tetrahedra in the place of others.
type Filling = ArrayVec<(Corners, Grade), FILLING>;

impl Flip {
    /// Puts the better ones in their place.
    pub fn apply(&self, mesh: &mut Mesh<'_>) {
        mesh.renew();
        for Part { old, new } in &self.parts {
            match *old {
                Old::Edge(region, [a, b]) => {
                    let old: Vec<u32> = at_edge(mesh, region, a, b).collect();
                    mesh.replace(&old, new);
                }
                Old::Face(old) => mesh.replace(&old, new),
            }
        }
        if let Some(diagonal) = self.diagonal {
            mesh.replace_diagonal(diagonal);
        }
    }
}

/// What could replace one tetrahedron and some of its neighbours. Depends on what there is at its corners, and at their
/// partners on seams, only.
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
    let sides = sides(mesh, mesh.region(tet), a, b)?;
    let old: ArrayVec<u32, { 2 * RING }> = sides.iter().flat_map(|s| s.old.clone()).collect();
    let (above, _) = mesh.bounds(&old, GAIN, HALF_DIGITS);
    let mut parts = ArrayVec::new();
    for side in &sides {
        parts.push(Part {
            old: Old::Edge(side.region, side.edge),
            new: fill(mesh, side, above)?,
        });
    }
    Some(Flip {
        parts,
        diagonal: sides[0].open.map(|new| Diagonal { old: [a, b], new }),
    })
}

/// The best tetrahedra in the place of those around an edge, if they are all better than `above`.
fn fill(mesh: &Mesh<'_>, side: &Side, above: f64) -> Option<Filling> {
    let Side {
        region,
        edge: [a, b],
        ref old,
        ref ring,
        ..
    } = *side;
    let (_, most) = mesh.bounds(old, GAIN, HALF_DIGITS);
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
            let is_side = (i, j) == (0, n - 1) && side.open.is_none();
            if !is_side && is_edge(mesh, ring[i], ring[j]) {
                return None;
            }
            let k = apex[i][j];
            new.extend(pair(i, k, j).map(|corners| (corners, mesh.of_corners(corners))));
            open.extend([(i, k), (k, j)]);
        }
    }
    Some(new)
}

/// Tetrahedra or vertices around an edge.
type Ring = ArrayVec<u32, RING>;

/// What is around an edge inside of a region.
struct Side {
    region: u32,
    /// The edge, from `a` to `b`.
    edge: [u32; 2],
    /// The tetrahedra.
    old: Ring,
    /// The vertices, counter-clockwise seen from `b`.
    ring: Ring,
    /// The first and the last of them, where the ring is open.
    open: Option<[u32; 2]>,
}

/// What is around an edge that may be replaced: one closed ring, or an open one and what is beyond its ends.
fn sides(mesh: &Mesh<'_>, region: u32, a: u32, b: u32) -> Option<ArrayVec<Side, 2>> {
    let side = around(mesh, region, a, b)?;
    let mut sides = ArrayVec::new();
    if let Some(new) = side.open {
        let diagonal = Diagonal { old: [a, b], new };
        if !mesh.may_replace(diagonal) {
            return None;
        }
        let other = match mesh.surface().beyond(diagonal, region)? {
            Beyond::Nothing => None,
            Beyond::Region(other) => Some((diagonal, other)),
            Beyond::Twins(diagonal, other) => Some((diagonal, other)),
        };
        if let Some((Diagonal { old: [a, b], new }, region)) = other {
            let [first, last] = new;
            let other = around(mesh, region, a, b).filter(|s| s.open == Some([last, first]))?;
            if side.old.iter().any(|t| other.old.contains(t)) {
                return None;
            }
            sides.push(other);
        }
    }
    sides.insert(0, side);
    Some(sides)
}

/// Whether there is an edge between two vertices. Where a shape is next to flat, tetrahedra around another edge between the same
/// vertices would have volume as well, and lie over those that there are.
fn is_edge(mesh: &Mesh<'_>, a: u32, b: u32) -> bool {
    let mut star = mesh.star(a).iter();
    star.any(|&t| mesh.corners(t).contains(&b))
}

/// The tetrahedra of a region at an edge.
fn at_edge<'m>(
    mesh: &'m Mesh<'_>,
    region: u32,
    a: u32,
    b: u32,
) -> impl Iterator<Item = u32> + use<'m> {
    let star = mesh.star(a).iter().copied();
    star.filter(move |&t| mesh.corners(t).contains(&b) && mesh.region(t) == region)
}

/// What is around an edge from `a` to `b` inside of a region.
fn around(mesh: &Mesh<'_>, region: u32, a: u32, b: u32) -> Option<Side> {
    let mut old = Ring::new();
    let mut steps = ArrayVec::<_, RING>::new();
    for t in at_edge(mesh, region, a, b) {
        old.try_push(t).ok()?;
        steps.push(opposite_side(mesh.corners(t), a, b)?);
    }
    let start = steps
        .iter()
        .find(|s| steps.iter().all(|other| other[1] != s[0]));
    let first = start.or(steps.first())?[0];
    let mut ring = Ring::from_iter([first]);
    let mut here = first;
    for _ in &steps {
        here = steps.iter().find(|s| s[0] == here)?[1];
        if here == first {
            break;
        }
        ring.try_push(here).ok()?;
    }
    let open = start.map(|_| [first, here]);
    let whole = ring.len() == steps.len() + usize::from(open.is_some());
    (ring.len() >= 3 && whole).then_some(Side {
        region,
        edge: [a, b],
        old,
        ring,
        open,
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
    let other = mesh.beyond(face, tet);
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
    if is_edge(mesh, top, bottom) {
        return None;
    }
    Some(Flip {
        parts: ArrayVec::from_iter([Part {
            old: Old::Face(old),
            new,
        }]),
        diagonal: None,
    })
}
