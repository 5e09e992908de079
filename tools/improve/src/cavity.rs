//! Tetrahedra that make room for a vertex.

use crate::mesh::Mesh;
use crate::quality::HALF_DIGITS;
use geom::tet::{EDGES, FACES};
use glam::DVec3;

/// Tetrahedra that make room for a vertex, at most: about twice as many as there are at an inner vertex.
const ROOM: usize = 40;

/// Tetrahedra of one region, and what is around them.
pub struct Cavity {
    /// The tetrahedra.
    pub old: Vec<u32>,
    /// Faces that are filled from the vertex, seen from inside.
    pub hull: Vec<[u32; 3]>,
    /// Faces of the surface that the vertex is in.
    pub open: Vec<[u32; 3]>,
    /// The smallest quality of what is filled from where the vertex starts.
    pub least: f64,
}

impl Cavity {
    /// What makes room for a vertex at `start`: some tetrahedra of a region that have faces in common, and those beyond their faces
    /// where what is filled from these would be no better than `above`. `is_open` says which faces the vertex is in.
    pub fn new(
        mesh: &Mesh<'_>,
        mut old: Vec<u32>,
        (start, above): (DVec3, f64),
        is_open: impl Fn([u32; 3]) -> bool,
    ) -> Option<Self> {
        let region = mesh.region(*old.first()?);
        let mut hull = Hull::default();
        for &tet in &old {
            hull.wrap(mesh, tet);
        }
        let mut open: Vec<[u32; 3]> = Vec::new();
        while let Some(face) = hull.next() {
            if is_open(face) {
                open.push(face);
                hull.remove();
                continue;
            }
            let [a, b, c] = face.map(|v| mesh.positions[v as usize]);
            let quality = mesh.of_points([a, b, c, start]).quality;
            if quality > above {
                hull.keep(quality);
                continue;
            }
            let other = mesh
                .beyond(face, hull.inside())
                .filter(|&t| mesh.region(t) == region && !mesh.is_fixed_face(face))
                .filter(|_| old.len() < ROOM);
            let Some(other) = other else {
                // The vertex is moved later on.
                if quality <= HALF_DIGITS {
                    return None;
                }
                hull.keep(quality);
                continue;
            };
            old.push(other);
            hull.wrap(mesh, other);
        }
        let cavity = Self {
            old,
            least: hull.least(),
            hull: hull.faces,
            open,
        };
        cavity.is_whole(mesh).then_some(cavity)
    }

    /// Whether all vertices stay, and all edges of triangles inside of the region.
    fn is_whole(&self, mesh: &Mesh<'_>) -> bool {
        let kept = |v: &u32| self.hull.iter().any(|face| face.contains(v));
        let edge_kept = |a: u32, b: u32| {
            !mesh.is_fixed_edge(a, b) || self.hull.iter().any(|f| f.contains(&a) && f.contains(&b))
        };
        self.old.iter().all(|&t| {
            let corners = mesh.corners(t);
            corners.iter().all(kept)
                && EDGES
                    .iter()
                    .all(|&[i, j]| edge_kept(corners[i], corners[j]))
        })
    }
}

/// The faces around tetrahedra, seen from inside, while more of these are added. The first ones were looked at and kept.
#[derive(Default)]
struct Hull {
    faces: Vec<[u32; 3]>,
    /// The tetrahedron inside of each face.
    insides: Vec<u32>,
    /// The sum of the corners of each face: most faces are told from another by it.
    sums: Vec<u32>,
    /// What is filled from each face that was kept.
    kept: Vec<f64>,
}

impl Hull {
    /// The next face to look at.
    fn next(&self) -> Option<[u32; 3]> {
        self.faces.get(self.kept.len()).copied()
    }

    /// The tetrahedron inside of that face.
    fn inside(&self) -> u32 {
        self.insides[self.kept.len()]
    }

    /// Keeps that face, with the quality of what is filled from it.
    fn keep(&mut self, quality: f64) {
        self.kept.push(quality);
    }

    /// Takes that face out.
    fn remove(&mut self) {
        self.remove_at(self.kept.len());
    }

    /// Adds a tetrahedron to what the hull is around: faces that both have in common are gone, the others are new ones.
    fn wrap(&mut self, mesh: &Mesh<'_>, tet: u32) {
        for face in faces(mesh, tet) {
            let [a, b, c] = face;
            let sum = a.wrapping_add(b).wrapping_add(c);
            let sums = self.sums.iter().zip(&self.faces);
            let is_same =
                |(&s, f): (&u32, &[u32; 3])| s == sum && f.iter().all(|v| face.contains(v));
            match sums.map(is_same).position(|same| same) {
                Some(place) => self.remove_at(place),
                None => {
                    self.faces.push(face);
                    self.insides.push(tet);
                    self.sums.push(sum);
                }
            }
        }
    }

    fn remove_at(&mut self, place: usize) {
        self.faces.remove(place);
        self.insides.remove(place);
        self.sums.remove(place);
        if place < self.kept.len() {
            self.kept.remove(place);
        }
    }

    /// The smallest quality of what is filled from faces that were kept.
    fn least(&self) -> f64 {
        self.kept.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// The faces of a tetrahedron, each positive with a vertex inside as the fourth.
pub fn faces(mesh: &Mesh<'_>, tet: u32) -> [[u32; 3]; 4] {
    let corners = mesh.corners(tet);
    FACES.map(|[i, j, k]| [corners[i], corners[k], corners[j]])
}
