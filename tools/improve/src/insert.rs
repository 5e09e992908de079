//! Puts new vertices where nothing else helps.
//!
//! A tetrahedron makes room for a vertex, together with those around it that would be no better than it is with the
//! new vertex in their place; the cavity is filled from the vertex, which then moves to where the worst of the
//! new tetrahedra is best (after B. Klingner, J. Shewchuk, "Aggressive tetrahedral mesh improvement", 2007). It
//! is the only way where all corners are on a surface that has to stay. In a flat facet with nothing beyond, the vertex may be
//! on the surface: the cavity is open there, and triangles of the facet are filled from the vertex too. On an edge of the surface,
//! there is a cavity in each of the spaces that meet there.

use crate::cavity::{Cavity, faces};
use crate::crease::Crease;
use crate::freedom::{Exact, Freedom, Freedoms};
use crate::mesh::{Corners, Mesh};
use crate::quality::{GAIN, Grade, HALF_DIGITS};
use crate::smooth::{Newcomer, settle};
use crate::surface::{Sheet, outline};
use geom::measure::double_area_vector;
use geom::tet::{EDGES, FACES};
use glam::DVec3;

/// Places from which the vertex is moved to where it is best: the best of all, beyond which the result is hardly ever
/// better.
const TRIED: usize = 4;

/// A new vertex, and the tetrahedra at it in the place of others.
pub struct Insertion {
    at: DVec3,
    parts: Vec<Part>,
    least: f64,
    /// Triangles of the surface that it divides, by patch, the edge that it is on, and what it may do there.
    divided: Vec<Vec<[u32; 3]>>,
    edge: Option<[u32; 2]>,
    within: (Freedom, Exact),
}

/// Tetrahedra of one region that are replaced.
struct Part {
    old: Vec<Corners>,
    new: Vec<(Corners, Grade)>,
}

impl Insertion {
    /// Whether no more than `count` tetrahedra make room.
    #[cfg(test)]
    pub fn replaces_at_most(&self, count: usize) -> bool {
        self.parts.iter().map(|p| p.old.len()).sum::<usize>() <= count
    }

    /// The smallest quality of the tetrahedra at the vertex.
    pub fn least(&self) -> f64 {
        self.least
    }

    /// Adds the vertex, and puts the tetrahedra in their place.
    pub fn apply(&self, mesh: &mut Mesh<'_>, freedoms: &mut Freedoms) {
        mesh.renew();
        let vertex = mesh.add(self.at);
        for part in &self.parts {
            // Numbers change with each replacement.
            let old: Vec<u32> = part.old.iter().filter_map(|&c| mesh.number(c)).collect();
            mesh.replace(&old, &part.new);
        }
        if !self.divided.is_empty() {
            let (freedom, exact) = self.within;
            freedoms.add(vertex, freedom, exact);
            for triangles in &self.divided {
                mesh.divide_surface(triangles, vertex, self.edge);
            }
        }
    }
}

/// Where a vertex comes to be.
enum Site {
    /// Inside of a region.
    Inside,
    /// In a flat patch of the surface with nothing beyond.
    Sheet(Sheet),
    /// On an edge of the surface.
    Crease(Crease),
}

/// Tetrahedra that would make room for a vertex.
struct Place {
    start: DVec3,
    site: Site,
    /// One in each of the spaces that the surface leaves there.
    cavities: Vec<Cavity>,
    /// The smallest quality of what would be there with the vertex at `start`.
    least: f64,
}

/// The new vertex in or at a tetrahedron that makes the worst one there better, and as good as possible.
pub fn find(mesh: &Mesh<'_>, freedoms: &Freedoms, tet: u32) -> Option<Insertion> {
    let corners = mesh.corners(tet);
    let points = corners.map(|v| mesh.positions[v as usize]);
    let mut places: Vec<Place> = places(points)
        .filter_map(|p| place(mesh, tet, p, Site::Inside))
        .collect();
    for (face, _) in faces(mesh, tet) {
        let Some(sheet) = mesh.surface().sheet(face) else {
            continue;
        };
        let exact = freedoms.within(&sheet).1;
        let points = sheet.corners.map(|v| mesh.positions[v as usize]);
        let there = places_on_face(points);
        places.extend(there.filter_map(|p| place(mesh, tet, exact.place(p), Site::Sheet(sheet))));
    }
    for [i, j] in EDGES {
        let Some(crease) = Crease::new(mesh, freedoms, [corners[i], corners[j]]) else {
            continue;
        };
        let middle = crease.within.1.place((points[i] + points[j]) * 0.5);
        places.extend(place(mesh, tet, middle, Site::Crease(crease)));
    }
    // The vertex is moved from there, which takes time.
    places.sort_by(|a, b| b.least.total_cmp(&a.least));
    places.truncate(TRIED);
    let mut best: Option<Insertion> = None;
    for place in places {
        let found = fill(mesh, freedoms, place);
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

/// The cavities that suit a vertex at `start` for a tetrahedron.
fn place(mesh: &Mesh<'_>, tet: u32, start: DVec3, site: Site) -> Option<Place> {
    let (above, _) = mesh.bounds(&[tet], GAIN, HALF_DIGITS);
    let cavities = match &site {
        Site::Inside => vec![Cavity::new(mesh, vec![tet], (start, above), |_| false)?],
        Site::Sheet(sheet) => {
            let is_open = |face| mesh.surface().is_in(sheet, face);
            vec![Cavity::new(mesh, vec![tet], (start, above), is_open)?]
        }
        Site::Crease(crease) => {
            let grown = |above: f64| -> Option<Vec<Cavity>> {
                let is_open = |face| crease.is_divided(mesh, face);
                let all = crease.spaces.iter();
                all.map(|space| Cavity::new(mesh, space.clone(), (start, above), is_open))
                    .collect()
            };
            // Otherwise what is at the edge alone makes room.
            grown(above).or_else(|| grown(HALF_DIGITS))?
        }
    };
    let qualities = cavities.iter().flat_map(|cavity| cavity.hull.iter());
    let qualities = qualities.map(|(face, _)| {
        let [a, b, c] = face.map(|v| mesh.positions[v as usize]);
        mesh.of_points([a, b, c, start]).quality
    });
    Some(Place {
        least: qualities.fold(f64::INFINITY, f64::min),
        start,
        site,
        cavities,
    })
}

/// Fills cavities from a vertex that is moved to the best place, if that makes the worst tetrahedron better.
fn fill(mesh: &Mesh<'_>, freedoms: &Freedoms, place: Place) -> Option<Insertion> {
    let (within, edge) = match &place.site {
        Site::Inside => ((Freedom::Free, Exact::default()), None),
        Site::Sheet(sheet) => (freedoms.within(sheet), None),
        Site::Crease(crease) => (crease.within, Some(crease.ends)),
    };
    let all_old = place.cavities.iter().flat_map(|c| c.old.iter().copied());
    let (above, _) = mesh.bounds(&all_old.collect::<Vec<_>>(), GAIN, HALF_DIGITS);
    let vertex = mesh.positions.len() as u32;
    let mut star = Newcomer::default();
    for cavity in &place.cavities {
        let (_, most) = mesh.bounds(&cavity.old, GAIN, HALF_DIGITS);
        let region = mesh.region(*cavity.old.first()?);
        for &([a, b, c], _) in &cavity.hull {
            star.add([a, b, c, vertex], region, most);
        }
    }
    let corners = star.corners().to_vec();
    let (at, grades) = settle(mesh, freedoms, place.start, star, within);
    let least = grades
        .iter()
        .map(|g| g.quality)
        .fold(f64::INFINITY, f64::min);
    let divided: Vec<Vec<[u32; 3]>> = match place.site {
        Site::Inside => Vec::new(),
        _ => mesh
            .surface()
            .by_patch(place.cavities.iter().flat_map(|c| &c.open)),
    };
    if least <= above || !divided.iter().all(|t| sees_all(mesh, at, t, edge)) {
        return None;
    }
    let mut new = corners.into_iter().zip(grades);
    let parts = place.cavities.iter().map(|cavity| Part {
        old: cavity.old.iter().map(|&t| mesh.corners(t)).collect(),
        new: new.by_ref().take(cavity.hull.len()).collect(),
    });
    Some(Insertion {
        at,
        parts: parts.collect(),
        least,
        divided,
        edge,
        within,
    })
}

/// Whether a place in the plane of triangles of the surface, or on an edge of theirs, sees all of their outline from inside, and they
/// are one piece without holes. Where the body goes on beyond the edge of a facet, tetrahedra may be positive from outside as well.
fn sees_all(mesh: &Mesh<'_>, at: DVec3, triangles: &[[u32; 3]], edge: Option<[u32; 2]>) -> bool {
    let position = |v: u32| mesh.positions[v as usize];
    let vector = |[a, b, c]: [DVec3; 3]| double_area_vector(a, b, c);
    let all = triangles.iter().map(|t| vector(t.map(position)));
    let whole: DVec3 = all.sum();
    let outline = outline(triangles);
    let is_whole = outline.len() == triangles.len() + 2;
    let mut others = outline
        .into_iter()
        .filter(|side| edge.is_none_or(|[a, b]| *side != [a, b] && *side != [b, a]));
    is_whole
        && others.all(|[a, b]| {
            let part = vector([position(a), position(b), at]);
            part.dot(whole) > HALF_DIGITS * whole.length_squared()
        })
}
