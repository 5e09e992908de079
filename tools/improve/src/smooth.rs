//! Moves vertices to where the worst tetrahedron at them is best.
//!
//! The smallest quality in the star of a vertex, as a function of its position, is a minimum of smooth
//! functions. The steepest way up is the shortest vector of the convex hull of the active ones'
//! gradients; steps along it are halved until the minimum grows (L. Freitag, M. Jones, P. Plassmann,
//! "An efficient parallel algorithm for mesh smoothing", 1995; L. Freitag, C. Ollivier-Gooch, 1997). The search ends
//! where even the slope itself would not gain enough by the step.
//! A vertex on a seam has its star on both sides of it: what is at its partner is turned back.

use crate::freedom::{Exact, Freedom};
use crate::freedoms::Freedoms;
use crate::mesh::{Corners, Mesh};
use crate::near::are_near;
use crate::quality::{GAIN, Grade, HALF_DIGITS};
use crate::shape::Point;
use arrayvec::ArrayVec;
use geom::tet::FACES;
use glam::DVec3;

/// Within this part of the smallest quality above it, others count as active. With none but the smallest, steps would go to and
/// fro between two tetrahedra; with all, none would lead up.
const ACTIVE: f64 = 0.1;

/// A vertex, with its partner on a seam, and all tetrahedra that move with it.
struct Star<'m, 'a> {
    mesh: &'m Mesh<'a>,
    freedoms: &'m Freedoms,
    vertex: u32,
    /// What the vertex keeps, if it is a new one.
    exact: Option<Exact>,
    /// The triangles of the surface there that stand for a curved shape, from the vertex or its partner on.
    faces: Vec<CurvedFace>,
    /// The points of the shape that these are near to.
    points: Vec<Point>,
    tets: Vec<Corners>,
    regions: Vec<u32>,
    /// Size that each tetrahedron may have in any case, six volumes.
    sizes: Vec<f64>,
}

impl Star<'_, '_> {
    /// Qualities with the vertex at `p`; `None` if one is at most `above`.
    fn qualities(&self, p: DVec3, above: f64) -> Option<Vec<f64>> {
        let at = self.positions(p);
        let mut list = Vec::with_capacity(self.tets.len());
        let tets = self.tets.iter().zip(&self.regions).zip(&self.sizes);
        for ((corners, &region), &size) in tets {
            let grade = self.mesh.of_points(corners.map(&at));
            if grade.quality <= above || !self.mesh.fits(region, grade.six_volume, size) {
                return None;
            }
            list.push(grade.quality);
        }
        self.holds(p).then_some(list)
    }

    /// Whether the surface around the vertex stays near to the curved shape that it stands for with the vertex at `p`.
    fn holds(&self, p: DVec3) -> bool {
        if self.faces.is_empty() {
            return true;
        }
        let here = self.mesh.positions[self.vertex as usize];
        let at = self.positions(p);
        let faces = self.faces.iter();
        let faces = faces.map(|face| (face.patch, face.corners.map(&at)));
        self.freedoms.holds(self.vertex, [here, p], faces.clone())
            && are_near(&self.points, faces.map(|(_, corners)| corners))
    }

    /// The middle of the other corners, if the vertex is free to go there and all of them are on its side of a seam.
    fn middle(&self) -> Option<DVec3> {
        let free = self.freedoms.of(self.vertex) == Freedom::Free
            && self.freedoms.partner(self.vertex).is_none();
        let all = self.tets.iter().flatten();
        let others = all.filter(|&&u| u != self.vertex).copied();
        let (sum, count) = others.fold((DVec3::ZERO, 0), |(sum, count), u| {
            (sum + self.mesh.positions[u as usize], count + 1)
        });
        (free && count > 0).then(|| sum / f64::from(count))
    }

    /// The nearest place to `p` that is exactly on what the vertex belongs to.
    fn place(&self, p: DVec3) -> DVec3 {
        match self.exact {
            Some(exact) => exact.place(p),
            None => self.freedoms.place(self.vertex, p),
        }
    }

    /// Grades with the vertex at `p`.
    fn grades(&self, p: DVec3) -> impl Iterator<Item = Grade> + use<'_> {
        let at = self.positions(p);
        let tets = self.tets.iter();
        tets.map(move |corners| self.mesh.of_points(corners.map(&at)))
    }

    /// Positions of vertices, with the moved one at `p`.
    fn positions(&self, p: DVec3) -> impl Fn(u32) -> DVec3 + use<'_> {
        let partner = self
            .freedoms
            .partner(self.vertex)
            .map(|(v, turn)| (v, turn.apply(p)));
        move |u| match partner {
            _ if u == self.vertex => p,
            Some((v, turned)) if u == v => turned,
            _ => self.mesh.positions[u as usize],
        }
    }

    /// Gradient of the quality of one tetrahedron, which it is now, in the directions that are free.
    fn gradient(
        &self,
        (tet, quality): (Corners, f64),
        p: DVec3,
        directions: &[DVec3],
        step: f64,
    ) -> DVec3 {
        let mut gradient = DVec3::ZERO;
        for &direction in directions {
            let at = self.positions(p + direction * step);
            let moved = self.mesh.of_points(tet.map(&at)).quality;
            gradient += direction * ((moved - quality) / step);
        }
        gradient
    }
}

/// A better place for a vertex.
pub struct Move {
    vertex: u32,
    to: DVec3,
    /// Its partner on a seam, and the place for that.
    partner: Option<(u32, DVec3)>,
    /// All tetrahedra that move with it, with their grades afterwards.
    tets: Vec<(u32, Grade)>,
    /// The triangles of the surface that do, those that stand for a curved shape.
    faces: Vec<[u32; 3]>,
}

impl Move {
    /// Moves the vertex.
    pub fn apply(&self, mesh: &mut Mesh<'_>) {
        mesh.renew();
        mesh.put(self.vertex, self.to);
        if let Some((other, to)) = self.partner {
            mesh.put(other, to);
        }
        for &(tet, grade) in &self.tets {
            mesh.regrade(tet, grade);
        }
        if !self.faces.is_empty() {
            mesh.share_points(&self.faces);
        }
    }
}

/// A better place for a vertex, or for the one that it moves with. Depends on what there is at it and at its partner
/// only.
pub fn find(mesh: &Mesh<'_>, freedoms: &Freedoms, vertex: u32) -> Option<Move> {
    let vertex = freedoms.mover(vertex);
    let directions: Vec<DVec3> = freedoms.of(vertex).directions().collect();
    if directions.is_empty() {
        return None;
    }
    let partner = freedoms.partner(vertex);
    let mut tets = mesh.star(vertex).to_vec();
    if let Some((other, _)) = partner {
        tets.extend_from_slice(mesh.star(other));
        tets.sort_unstable();
        tets.dedup();
    }
    let faces = curved_faces(mesh, freedoms, vertex);
    let triangles: Vec<[u32; 3]> = faces.iter().map(|face| face.corners).collect();
    let grades: Vec<Grade> = tets.iter().map(|&t| mesh.grade(t)).collect();
    let star = Star {
        mesh,
        freedoms,
        vertex,
        exact: None,
        points: mesh.surface().points(&triangles),
        faces,
        tets: tets.iter().map(|&t| mesh.corners(t)).collect(),
        regions: tets.iter().map(|&t| mesh.region(t)).collect(),
        sizes: grades.iter().map(|g| g.six_volume).collect(),
    };
    let start = mesh.positions[vertex as usize];
    let qualities: Vec<f64> = grades.iter().map(|g| g.quality).collect();
    let least = smallest(&qualities);
    let to = match star.middle().filter(|_| least < HALF_DIGITS) {
        Some(middle) if let Some(there) = star.qualities(middle, least.max(HALF_DIGITS)) => {
            climb(&star, middle, there, &directions).unwrap_or(middle)
        }
        _ => climb(&star, start, qualities, &directions)?,
    };
    let grades = star.grades(to);
    Some(Move {
        vertex,
        to,
        partner: partner.map(|(other, turn)| (other, turn.apply(to))),
        tets: tets.into_iter().zip(grades).collect(),
        faces: triangles,
    })
}

/// A triangle of the surface that stands for a patch of a curved shape.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct CurvedFace {
    patch: u32,
    /// As it runs, from a vertex that moves on.
    corners: [u32; 3],
}

/// The triangles of the surface at a vertex, and at the one that moves with it, that stand for a curved shape, for a vertex that may be moved on
/// the surface. What was straight beside an edge of facets before is not where other edges and vertices are there since.
fn curved_faces(mesh: &Mesh<'_>, freedoms: &Freedoms, vertex: u32) -> Vec<CurvedFace> {
    let own = match freedoms.of(vertex) {
        Freedom::Along(patch, _) => Some(patch),
        Freedom::Line(_) | Freedom::Plane(..) => None,
        Freedom::Fixed | Freedom::Free => return Vec::new(),
    };
    if mesh.surface().shape().is_none() {
        return Vec::new();
    }
    let mut faces = Vec::new();
    let partner = freedoms.partner(vertex).map(|(other, _)| other);
    for v in std::iter::once(vertex).chain(partner) {
        for &tet in mesh.star(v) {
            let corners = mesh.corners(tet);
            for face in FACES.map(|face| face.map(|i| corners[i])) {
                if !face.contains(&v) {
                    continue;
                }
                let triangle = mesh.surface().triangle(face);
                let patch = own.or_else(|| mesh.surface().curved(face));
                faces.extend(triangle.zip(patch).map(|([a, b, c], patch)| CurvedFace {
                    patch,
                    corners: match v {
                        v if v == a => [a, b, c],
                        v if v == b => [b, c, a],
                        _ => [c, a, b],
                    },
                }));
            }
        }
    }
    // What is between two regions was found from both.
    faces.sort_unstable();
    faces.dedup();
    faces
}

/// The tetrahedra at a vertex that is new.
#[derive(Default)]
pub struct Newcomer {
    tets: Vec<Corners>,
    regions: Vec<u32>,
    sizes: Vec<f64>,
}

impl Newcomer {
    /// Adds one, which may have a size of `most`, six volumes, in any case.
    pub fn add(&mut self, corners: Corners, region: u32, most: f64) {
        self.tets.push(corners);
        self.regions.push(region);
        self.sizes.push(most);
    }

    /// Their corners.
    pub fn corners(&self) -> &[Corners] {
        &self.tets
    }
}

/// The best place found for a vertex that is new and may do so much, from `start` on, and the grades of the tetrahedra at it.
pub fn settle(
    mesh: &Mesh<'_>,
    freedoms: &Freedoms,
    start: DVec3,
    newcomer: Newcomer,
    (freedom, exact): (Freedom, Exact),
) -> (DVec3, Vec<Grade>) {
    let star = Star {
        mesh,
        freedoms,
        vertex: mesh.positions.len() as u32,
        exact: Some(exact),
        faces: Vec::new(),
        points: Vec::new(),
        tets: newcomer.tets,
        regions: newcomer.regions,
        sizes: newcomer.sizes,
    };
    let directions: Vec<DVec3> = freedom.directions().collect();
    let qualities = star.grades(start).map(|g| g.quality).collect();
    let to = climb(&star, start, qualities, &directions).unwrap_or(start);
    let grades = star.grades(to).collect();
    (to, grades)
}

fn smallest(list: &[f64]) -> f64 {
    list.iter().fold(f64::INFINITY, |m, &q| m.min(q))
}

/// The best place found for the vertex, if it is better than `start`, where it is.
fn climb(
    star: &Star<'_, '_>,
    start: DVec3,
    mut qualities: Vec<f64>,
    directions: &[DVec3],
) -> Option<DVec3> {
    let size = {
        let at = star.positions(start);
        let own = star.freedoms.partner(star.vertex).map(|p| p.0);
        let mut nearest = f64::INFINITY;
        for &corners in &star.tets {
            let here = corners
                .iter()
                .find(|&&u| u == star.vertex || Some(u) == own);
            let Some(&here) = here else { continue };
            for u in corners {
                if u != star.vertex && Some(u) != own {
                    nearest = nearest.min((at(u) - at(here)).length_squared());
                }
            }
        }
        nearest.sqrt()
    };
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    let mut p = start;
    let mut least = smallest(&qualities);
    // Halfway to the next corner; a longer step mostly turns a tetrahedron over.
    let mut step = 0.5 * size;
    while least < 1.0 {
        // The functions fall below their slopes, so that shorter steps than this one and lesser slopes do not gain as much.
        let worth = GAIN * least.abs();
        let difference = HALF_DIGITS * size;
        let gradients: Vec<DVec3> = star
            .tets
            .iter()
            .zip(&qualities)
            .filter(|&(_, &q)| q <= least + ACTIVE * least.abs())
            .map(|(&t, &q)| star.gradient((t, q), p, directions, difference))
            .collect();
        let Some(steepest) = shortest_in_hull(&gradients, worth / step) else {
            break;
        };
        let slope = steepest.length();
        let up = steepest / slope;
        // Rounding must not lead away from where the vertex belongs.
        let up: DVec3 = directions.iter().map(|&d| d * d.dot(up)).sum();
        let mut better = None;
        while slope * step > worth {
            let q = star.place(p + up * step);
            if let Some(list) = star.qualities(q, (least + worth).max(HALF_DIGITS)) {
                better = Some((q, list));
                break;
            }
            step *= 0.5;
        }
        let Some((q, list)) = better else { break };
        (p, qualities) = (q, list);
        least = smallest(&qualities);
        step *= 2.0;
    }
    (p != start).then_some(p)
}

/// The shortest vector in the convex hull of some, but for [`GAIN`], if it is longer than `least`. It is in the hull of three of
/// them at most, which are exchanged for better ones while there are any (P. Wolfe, "Finding the nearest point in a polytope",
/// 1976).
fn shortest_in_hull(list: &[DVec3], least: f64) -> Option<DVec3> {
    let along = |x: DVec3| {
        let all = list.iter().copied();
        all.min_by(|a, b| a.dot(x).total_cmp(&b.dot(x)))
    };
    let shorter = |a: &DVec3, b: &DVec3| a.length_squared().total_cmp(&b.length_squared());
    let mut x = list.iter().copied().min_by(shorter)?;
    let mut simplex = ArrayVec::<DVec3, 3>::from_iter([x]);
    while x.length_squared() > least * least {
        let lowest = along(x)?;
        if lowest.dot(x) >= (1.0 - GAIN) * x.length_squared() {
            return Some(x);
        }
        let (nearer, corners) = nearest(&simplex, lowest);
        // Otherwise the origin is inside.
        if nearer.length_squared() >= x.length_squared() {
            break;
        }
        (x, simplex) = (nearer, corners);
    }
    None
}

/// The point nearest to the origin on the edges and triangles at `p` of a simplex with that and other corners, and the
/// corners of the edge or triangle.
fn nearest(others: &[DVec3], p: DVec3) -> (DVec3, ArrayVec<DVec3, 3>) {
    let mut best = (p, ArrayVec::from_iter([p]));
    let mut offer = |x: DVec3, corners: &[DVec3]| {
        if x.length_squared() < best.0.length_squared() {
            best = (x, corners.iter().copied().collect());
        }
    };
    for (i, &a) in others.iter().enumerate() {
        let u = a - p;
        let t = (-p.dot(u) / u.length_squared()).clamp(0.0, 1.0);
        offer(p + u * t, &[p, a]);
        for &b in &others[..i] {
            let (v, normal) = (b - p, u.cross(b - p));
            // Barycentric coordinates of the origin's foot, times the square of the normal.
            let (s, t) = (v.cross(p).dot(normal), p.cross(u).dot(normal));
            let square = normal.length_squared();
            if s > 0.0 && t > 0.0 && s + t < square {
                offer(normal * (p.dot(normal) / square), &[p, a, b]);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_vector_is_found() {
        let shortest = |list: &[DVec3]| shortest_in_hull(list, 1e-3);
        let found = shortest(&[DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, -1.0, 0.0)]);
        assert!((found.unwrap() - DVec3::X).length() < 1e-2);
        let around = [DVec3::X, DVec3::NEG_X, DVec3::Y];
        assert_eq!(shortest(&around), None);
        assert_eq!(shortest(&[DVec3::Z]), Some(DVec3::Z));
        assert_eq!(shortest(&[]), None);
        // Inside of a triangle, one of whose corners is found last.
        let above = [[3.0, 0.0], [-1.0, 2.0], [-1.0, -2.0]].map(|[x, y]| DVec3::new(x, y, 1.0));
        let list = [&above[..], &[DVec3::Z * 7.0]].concat();
        assert!((shortest(&list).unwrap() - DVec3::Z).length() < 1e-12);
        // The origin inside of a tetrahedron, and a vector that is too short.
        let inside = [&above[..], &[DVec3::NEG_Z]].concat();
        assert_eq!(shortest(&inside), None);
        assert_eq!(shortest_in_hull(&above, 1.5), None);
    }
}
