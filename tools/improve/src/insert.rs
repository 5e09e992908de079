//! Puts new vertices where nothing else helps.
//!
//! A tetrahedron makes room for a vertex, together with those around it that would be no better than it is with the
//! new vertex in their place; the cavity is filled from the vertex, which then moves to where the worst of the
//! new tetrahedra is best (after B. Klingner, J. Shewchuk, "Aggressive tetrahedral mesh improvement", 2007). It
//! is the only way where all corners are on a surface that has to stay. In a flat facet with nothing beyond, the vertex may be
//! on the surface: the cavity is open there, and triangles of the facet are filled from the vertex too. On an edge of the surface,
//! there is a cavity in each of the spaces that meet there.

use crate::cavity::{Cavity, faces};
use crate::freedom::{Exact, Freedom};
use crate::freedoms::Freedoms;
use crate::mesh::{Corners, Mesh};
use crate::quality::{GAIN, Grade, HALF_DIGITS};
use crate::smooth::{Newcomer, settle};
use crate::support::Support;
use crate::surface::outline;
use geom::measure::double_area_vector;
use geom::tet::{EDGES, FACES};
use glam::DVec3;
use std::rc::Rc;

/// Places from which the vertex is moved to where it is best: the best of all, beyond which the result is hardly ever
/// better.
const TRIED: usize = 4;

/// A new vertex, and the tetrahedra at it in the place of others.
pub struct Insertion {
    at: DVec3,
    parts: Vec<Part>,
    least: f64,
    /// Triangles of the surface that it divides, by patch, the edge that it is on, the patch of a curved shape that it is inside
    /// of, and what it may do there.
    divided: Vec<Vec<[u32; 3]>>,
    edge: Option<[u32; 2]>,
    patch: Option<u32>,
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

    /// Volume of what is larger than it may be, before and after, six times.
    pub fn too_large(&self, mesh: &Mesh<'_>) -> [f64; 2] {
        let of = |region, six_volume| match mesh.fits(region, six_volume, 0.0) {
            true => 0.0,
            false => six_volume,
        };
        let (mut before, mut after) = (0.0, 0.0);
        for part in &self.parts {
            for tet in part.old.iter().filter_map(|&c| mesh.number(c)) {
                before += of(mesh.region(tet), mesh.grade(tet).six_volume);
            }
            let region = part.old.first().and_then(|&c| mesh.number(c));
            for (_, grade) in &part.new {
                after += region.map_or(0.0, |t| of(mesh.region(t), grade.six_volume));
            }
        }
        [before, after]
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
            let along = self.patch.and_then(|patch| freedoms.along(patch, self.at));
            freedoms.add(vertex, along.unwrap_or(freedom), exact);
            for triangles in &self.divided {
                mesh.divide_surface(triangles, vertex, self.edge);
            }
        }
    }
}

/// Tetrahedra that would make room for a vertex.
struct Place {
    start: DVec3,
    /// What of the surface the vertex is on, unless it is inside.
    support: Option<Rc<Support>>,
    /// One in each of the spaces that the surface leaves there.
    cavities: Vec<Cavity>,
    /// The smallest quality of what would be there with the vertex at `start`.
    least: f64,
}

/// The new vertex in or at a tetrahedron that makes the worst one there better, and as good as possible; or, given a quality, one that leaves
/// all there better than that.
pub fn find(
    mesh: &Mesh<'_>,
    freedoms: &Freedoms,
    tet: u32,
    above: Option<f64>,
) -> Option<Insertion> {
    let corners = mesh.corners(tet);
    let points = corners.map(|v| mesh.positions[v as usize]);
    let inside = places(points).map(|p| (p, None));
    let triangles = faces(mesh, tet).into_iter();
    let triangles = triangles.filter_map(|face| Support::triangle(mesh, freedoms, (face, tet)));
    let edges = EDGES.iter().filter_map(|&[i, j]| {
        let ends = [corners[i], corners[j]];
        Support::edge(mesh, freedoms, ends)
    });
    let on_surface = triangles.chain(edges).map(Rc::new);
    let on_surface = on_surface.flat_map(|s| s.places(mesh).map(move |p| (p, Some(s.clone()))));
    let all = inside.chain(on_surface);
    let mut places: Vec<Place> = all
        .filter_map(|(start, support)| place(mesh, (tet, above), start, support))
        .collect();
    // The vertex is moved from there, which takes time.
    places.sort_by(|a, b| b.least.total_cmp(&a.least));
    places.truncate(TRIED);
    let mut best: Option<Insertion> = None;
    for place in places {
        let found = fill(mesh, freedoms, (place, above));
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

/// The cavities that suit a vertex at `start` for a tetrahedron.
fn place(
    mesh: &Mesh<'_>,
    (tet, above): (u32, Option<f64>),
    start: DVec3,
    support: Option<Rc<Support>>,
) -> Option<Place> {
    let above = above.unwrap_or_else(|| mesh.bounds(&[tet], GAIN, HALF_DIGITS).0);
    let cavities = match &support {
        None => vec![Cavity::new(mesh, vec![tet], (start, above), |_| false)?],
        Some(support) => {
            let grown = |above: f64| -> Option<Vec<Cavity>> {
                let is_open = |face| support.is_divided(mesh, face);
                let all = support.spaces.iter();
                all.map(|space| Cavity::new(mesh, space.clone(), (start, above), is_open))
                    .collect()
            };
            // Otherwise what is there alone makes room.
            grown(above).or_else(|| grown(HALF_DIGITS))?
        }
    };
    let least = cavities.iter().map(|cavity| cavity.least);
    Some(Place {
        least: least.fold(f64::INFINITY, f64::min),
        start,
        support,
        cavities,
    })
}

/// Fills cavities from a vertex that is moved to the best place, if that makes the worst tetrahedron better, or all better than asked for.
fn fill(
    mesh: &Mesh<'_>,
    freedoms: &Freedoms,
    (place, above): (Place, Option<f64>),
) -> Option<Insertion> {
    let support = place.support.as_deref();
    let within = support.map_or((Freedom::Free, Exact::default()), |s| s.within);
    let edge = support.and_then(Support::ends);
    let all_old = place.cavities.iter().flat_map(|c| c.old.iter().copied());
    let above = above.unwrap_or_else(|| {
        mesh.bounds(&all_old.collect::<Vec<_>>(), GAIN, HALF_DIGITS)
            .0
    });
    let vertex = mesh.positions.len() as u32;
    let mut star = Newcomer::default();
    for cavity in &place.cavities {
        let (_, most) = mesh.bounds(&cavity.old, GAIN, HALF_DIGITS);
        let region = mesh.region(*cavity.old.first()?);
        for &[a, b, c] in &cavity.hull {
            star.add([a, b, c, vertex], region, most);
        }
    }
    let corners = star.corners().to_vec();
    let (at, grades) = settle(mesh, freedoms, place.start, star, within);
    let least = grades
        .iter()
        .map(|g| g.quality)
        .fold(f64::INFINITY, f64::min);
    // None where the vertex is inside.
    let open = place.cavities.iter().flat_map(|c| &c.open);
    let divided = mesh.surface().by_patch(open);
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
        patch: support.and_then(|s| s.patch),
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
