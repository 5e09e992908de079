//! Puts new vertices where nothing else helps.
//!
//! A tetrahedron makes room for a vertex, together with those around it that would be no better than it is with the
//! new vertex in their place; the cavity is filled from the vertex, which then moves to where the worst of the
//! new tetrahedra is best (after B. Klingner, J. Shewchuk, "Aggressive tetrahedral mesh improvement", 2007). It
//! is the only way where all corners are on a surface that has to stay. In a flat facet with nothing beyond, the vertex may be
//! on the surface: the cavity is open there, and triangles of the facet are filled from the vertex too.

use crate::freedom::{Exact, Freedom, Freedoms};
use crate::mesh::{Corners, Mesh};
use crate::quality::{GAIN, Grade, HALF_DIGITS};
use crate::smooth::settle;
use crate::surface::{Sheet, outline};
use geom::measure::double_area_vector;
use geom::tet::{EDGES, FACES};
use glam::DVec3;

/// Places from which the vertex is moved to where it is best: the best of all, beyond which the result is hardly ever
/// better.
const TRIED: usize = 4;

/// Tetrahedra that make room for a vertex, at most: about twice as many as there are at an inner vertex.
const ROOM: usize = 40;

/// A new vertex, and the tetrahedra at it in the place of others.
pub struct Insertion {
    at: DVec3,
    old: Vec<u32>,
    new: Vec<(Corners, Grade)>,
    least: f64,
    /// Triangles of the surface that it divides, and what it may do there.
    divided: Vec<[u32; 3]>,
    within: (Freedom, Exact),
}

impl Insertion {
    /// Whether no more than `count` tetrahedra make room.
    #[cfg(test)]
    pub fn replaces_at_most(&self, count: usize) -> bool {
        self.old.len() <= count
    }

    /// The smallest quality of the tetrahedra at the vertex.
    pub fn least(&self) -> f64 {
        self.least
    }

    /// Adds the vertex, and puts the tetrahedra in their place.
    pub fn apply(&self, mesh: &mut Mesh<'_>, freedoms: &mut Freedoms) {
        mesh.renew();
        let vertex = mesh.add(self.at);
        mesh.replace(&self.old, &self.new);
        if !self.divided.is_empty() {
            let (freedom, exact) = self.within;
            freedoms.add(vertex, freedom, exact);
            mesh.divide_surface(&self.divided, vertex);
        }
    }
}

/// Tetrahedra that would make room for a vertex.
struct Cavity {
    start: DVec3,
    old: Vec<u32>,
    /// What would be in their place, and the smallest quality of them with the vertex at `start`.
    new: Vec<Corners>,
    least: f64,
    /// The patch of the surface that the vertex is in, and the triangles that are divided.
    sheet: Option<Sheet>,
    divided: Vec<[u32; 3]>,
}

/// The new vertex in or at a tetrahedron that makes the worst one there better, and as good as possible.
pub fn find(mesh: &Mesh<'_>, freedoms: &Freedoms, tet: u32) -> Option<Insertion> {
    let points = mesh.corners(tet).map(|v| mesh.positions[v as usize]);
    let inside = places(points).filter_map(|p| cavity(mesh, tet, p, None));
    let sheets = faces(mesh, tet).filter_map(|(face, _)| mesh.surface().sheet(face));
    let on_surface = sheets.flat_map(|sheet| {
        let corners = sheet.corners.map(|v| mesh.positions[v as usize]);
        let exact = freedoms.within(&sheet).1;
        places_on_face(corners).filter_map(move |p| cavity(mesh, tet, exact.place(p), Some(sheet)))
    });
    let mut cavities: Vec<Cavity> = inside.chain(on_surface).collect();
    // The vertex is moved from there, which takes time.
    cavities.sort_by(|a, b| b.least.total_cmp(&a.least));
    cavities.truncate(TRIED);
    let mut best: Option<Insertion> = None;
    for cavity in cavities {
        let found = fill(mesh, freedoms, cavity);
        if let Some(found) = found
            && best.as_ref().is_none_or(|b| b.least < found.least)
        {
            best = Some(found);
        }
    }
    best
}

/// Where to try: the middles of the tetrahedron, its faces and edges, and towards the centre of its circumscribed
/// sphere, which is where refinement puts vertices against long radii.
fn places(points: [DVec3; 4]) -> impl Iterator<Item = DVec3> {
    let [a, b, c, d] = points;
    let middle = (a + b + c + d) * 0.25;
    let faces = FACES.map(|face| face.map(|i| points[i]).iter().sum::<DVec3>() / 3.0);
    let edges = EDGES.map(|[i, j]| (points[i] + points[j]) * 0.5);
    let (u, v, w) = (b - a, c - a, d - a);
    let (uv, vw, wu) = (u.cross(v), v.cross(w), w.cross(u));
    let sum = u.length_squared() * vw + v.length_squared() * wu + w.length_squared() * uv;
    let centre = a + sum / (2.0 * uv.dot(w));
    let towards = [0.5, 1.0].map(|t| middle.lerp(centre, t));
    let all = std::iter::once(middle).chain(faces).chain(edges);
    all.chain(towards.into_iter().filter(|p| p.is_finite()))
}

/// Where to try on a face: its middle, those of its edges, and the centre of its circumscribed circle.
fn places_on_face([a, b, c]: [DVec3; 3]) -> impl Iterator<Item = DVec3> {
    let middle = (a + b + c) / 3.0;
    let (u, v) = (b - a, c - a);
    let normal = u.cross(v);
    let sum = u.length_squared() * v.cross(normal) + v.length_squared() * normal.cross(u);
    let centre = a + sum / (2.0 * normal.length_squared());
    let edges = [[a, b], [b, c], [c, a]].map(|[p, q]| (p + q) * 0.5);
    let all = std::iter::once(middle).chain(edges);
    all.chain(Some(centre).filter(|p| p.is_finite()))
}

/// The cavity that suits a vertex at `start`, inside or in a patch of the surface.
fn cavity(mesh: &Mesh<'_>, tet: u32, start: DVec3, sheet: Option<Sheet>) -> Option<Cavity> {
    let region = mesh.region(tet);
    let (above, _) = mesh.bounds(&[tet], GAIN, HALF_DIGITS);
    let vertex = mesh.positions.len() as u32;
    let mut old = vec![tet];
    // Faces of the cavity, seen from inside, with the tetrahedron inside.
    let mut hull: Vec<([u32; 3], u32)> = faces(mesh, tet).collect();
    let mut divided: Vec<[u32; 3]> = Vec::new();
    let mut next = 0;
    while let Some(&(face, inside)) = hull.get(next) {
        if sheet.is_some_and(|s| mesh.surface().is_in(&s, face)) {
            divided.push(face);
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
        // Faces that it has in common with the cavity are gone, the others are new ones.
        for (face, inside) in faces(mesh, other) {
            let same = |f: &([u32; 3], u32)| f.0.iter().all(|v| face.contains(v));
            match hull.iter().position(same) {
                Some(place) => {
                    hull.remove(place);
                    next -= usize::from(place < next);
                }
                None => hull.push((face, inside)),
            }
        }
    }
    // Otherwise what it divides is not one piece without holes.
    if sheet.is_some() && outline(&divided).len() != divided.len() + 2 {
        return None;
    }
    let kept = |v: &u32| hull.iter().any(|(face, _)| face.contains(v));
    let edge_kept = |a: u32, b: u32| {
        !mesh.is_fixed_edge(a, b) || hull.iter().any(|(f, _)| f.contains(&a) && f.contains(&b))
    };
    let whole = old.iter().all(|&t| {
        let corners = mesh.corners(t);
        corners.iter().all(kept)
            && EDGES
                .iter()
                .all(|&[i, j]| edge_kept(corners[i], corners[j]))
    });
    if !whole {
        return None;
    }
    let new: Vec<Corners> = hull
        .iter()
        .map(|&([a, b, c], _)| [a, b, c, vertex])
        .collect();
    let qualities = hull.iter().map(|(face, _)| {
        let [a, b, c] = face.map(|v| mesh.positions[v as usize]);
        mesh.of_points([a, b, c, start]).quality
    });
    Some(Cavity {
        least: qualities.fold(f64::INFINITY, f64::min),
        start,
        old,
        new,
        sheet,
        divided,
    })
}

/// Fills a cavity from a vertex that is moved to the best place, if that makes the worst tetrahedron better.
fn fill(mesh: &Mesh<'_>, freedoms: &Freedoms, cavity: Cavity) -> Option<Insertion> {
    let Cavity {
        start,
        old,
        new,
        sheet,
        divided,
        ..
    } = cavity;
    let inside = (Freedom::Free, Exact::default());
    let within = sheet.map_or(inside, |sheet| freedoms.within(&sheet));
    let (above, most) = mesh.bounds(&old, GAIN, HALF_DIGITS);
    let region = mesh.region(*old.first()?);
    let (at, grades) = settle(mesh, freedoms, start, &new, (region, most), within);
    let qualities = grades.iter().map(|g| g.quality);
    let least = qualities.fold(f64::INFINITY, f64::min);
    (least > above && sees_all(mesh, at, &divided)).then(|| Insertion {
        at,
        old,
        new: new.into_iter().zip(grades).collect(),
        least,
        divided,
        within,
    })
}

/// Whether a place in the plane of triangles of the surface sees all of their outline from inside. Where the body goes on beyond
/// the edge of a facet, tetrahedra may be positive from outside as well.
fn sees_all(mesh: &Mesh<'_>, at: DVec3, triangles: &[[u32; 3]]) -> bool {
    let position = |v: u32| mesh.positions[v as usize];
    let vector = |[a, b, c]: [DVec3; 3]| double_area_vector(a, b, c);
    let all = triangles.iter().map(|t| vector(t.map(position)));
    let whole: DVec3 = all.sum();
    outline(triangles).into_iter().all(|[a, b]| {
        let part = vector([position(a), position(b), at]);
        part.dot(whole) > HALF_DIGITS * whole.length_squared()
    })
}

/// The faces of a tetrahedron, each positive with a vertex inside as the fourth.
fn faces(mesh: &Mesh<'_>, tet: u32) -> impl Iterator<Item = ([u32; 3], u32)> + use<> {
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
