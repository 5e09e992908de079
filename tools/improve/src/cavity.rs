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
    /// Faces that are filled from the vertex, seen from inside, with the tetrahedron inside.
    pub hull: Vec<([u32; 3], u32)>,
    /// Faces of the surface that the vertex is in.
    pub open: Vec<[u32; 3]>,
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
        let mut hull: Vec<([u32; 3], u32)> = Vec::new();
        let mut next = 0;
        for &tet in &old {
            wrap(mesh, (&mut hull, &mut next), tet);
        }
        let mut open: Vec<[u32; 3]> = Vec::new();
        while let Some(&(face, inside)) = hull.get(next) {
            if is_open(face) {
                open.push(face);
                hull.remove(next);
                continue;
            }
            let points = face.map(|v| mesh.positions[v as usize]);
            let grade = mesh.of_points([points[0], points[1], points[2], start]);
            if grade.quality > above {
                next += 1;
                continue;
            }
            let other = beyond(mesh, face, inside)
                .filter(|&t| mesh.region(t) == region && !mesh.is_fixed_face(face))
                .filter(|_| old.len() < ROOM);
            let Some(other) = other else {
                // The vertex is moved later on.
                if grade.quality <= HALF_DIGITS {
                    return None;
                }
                next += 1;
                continue;
            };
            old.push(other);
            wrap(mesh, (&mut hull, &mut next), other);
        }
        let cavity = Self { old, hull, open };
        cavity.is_whole(mesh).then_some(cavity)
    }

    /// Whether all vertices stay, and all edges of triangles inside of the region.
    fn is_whole(&self, mesh: &Mesh<'_>) -> bool {
        let kept = |v: &u32| self.hull.iter().any(|(face, _)| face.contains(v));
        let edge_kept = |a: u32, b: u32| {
            !mesh.is_fixed_edge(a, b)
                || self
                    .hull
                    .iter()
                    .any(|(f, _)| f.contains(&a) && f.contains(&b))
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

/// Adds a tetrahedron to what a hull is around: faces that both have in common are gone, the others are new ones. The place of the next
/// face to look at stays that of the same one, or of the one after it.
fn wrap(mesh: &Mesh<'_>, (hull, next): (&mut Vec<([u32; 3], u32)>, &mut usize), tet: u32) {
    for (face, inside) in faces(mesh, tet) {
        let same = |f: &([u32; 3], u32)| f.0.iter().all(|v| face.contains(v));
        match hull.iter().position(same) {
            Some(place) => {
                hull.remove(place);
                *next -= usize::from(place < *next);
            }
            None => hull.push((face, inside)),
        }
    }
}

/// The faces of a tetrahedron, each positive with a vertex inside as the fourth.
pub fn faces(mesh: &Mesh<'_>, tet: u32) -> impl Iterator<Item = ([u32; 3], u32)> + use<> {
    let corners = mesh.corners(tet);
    FACES
        .iter()
        .map(move |&[i, j, k]| ([corners[i], corners[k], corners[j]], tet))
}

/// The tetrahedron on the other side of a face.
fn beyond(mesh: &Mesh<'_>, face: [u32; 3], inside: u32) -> Option<u32> {
    mesh.star(face[0]).iter().copied().find(|&t| {
        let corners = mesh.corners(t);
        t != inside && face.iter().all(|v| corners.contains(v))
    })
}
