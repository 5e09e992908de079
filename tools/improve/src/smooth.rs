//! Moves vertices to where the worst tetrahedron at them is best.
//!
//! The smallest quality in the star of a vertex, as a function of its position, is a minimum of smooth
//! functions. The steepest way up is the shortest vector of the convex hull of the active ones'
//! gradients; steps along it are halved until the minimum grows (L. Freitag, M. Jones, P. Plassmann,
//! "An efficient parallel algorithm for mesh smoothing", 1995; L. Freitag, C. Ollivier-Gooch, 1997).
//! A vertex on a seam has its star on both sides of it: what is at its partner is turned back.

use crate::freedom::{Freedom, Freedoms};
use crate::mesh::{Corners, Mesh};
use crate::quality::{Grade, LEAST};
use glam::DVec3;

/// Steps up, at most. The smallest quality is the minimum of several functions, and its peak is reached by ever smaller
/// steps; the next round continues where this one ends.
const STEPS: usize = 6;
/// Halvings of a step, at most: down to about a hundredth of the distance to the other corners, beyond which nothing is
/// won.
const HALVINGS: usize = 5;
/// First step, as a part of the distance to the other corners of the star: a longer one mostly turns a tetrahedron over.
const FIRST: f64 = 0.25;
/// Within this part of the smallest quality above it, others count as active: about as far as a step changes them.
const ACTIVE: f64 = 0.1;
/// The smallest quality has to grow by this part for a step. A smaller one is not worth the work.
const GAIN: f64 = 1e-3;
/// With a smaller quality, small steps lead nowhere, since what comes out has to be at least [`LEAST`].
const FLAT: f64 = 10.0 * LEAST;
/// There is no way up when the shortest vector is less than this part of the longest gradient: steps along it gain less
/// than [`GAIN`].
const NO_WAY: f64 = 1e-2;
/// Difference for gradients, as a part of the distance to the other corners: between the square root of the rounding, where
/// half of the digits are left for nearly flat tetrahedra too, and where the functions are not straight.
const DIFFERENCE: f64 = 1e-6;

/// A vertex, with its partner on a seam, and all tetrahedra that move with it.
struct Star<'m, 'a> {
    mesh: &'m Mesh<'a>,
    freedoms: &'m Freedoms,
    vertex: u32,
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
        Some(list)
    }

    /// The middle of the other corners, if the vertex is free to go there.
    fn middle(&self) -> Option<DVec3> {
        let free = self.freedoms.of(self.vertex) == Freedom::Free;
        let all = self.tets.iter().flatten();
        let others = all.filter(|&&u| u != self.vertex).copied();
        let (sum, count) = others.fold((DVec3::ZERO, 0), |(sum, count), u| {
            (sum + self.mesh.positions[u as usize], count + 1)
        });
        (free && count > 0).then(|| sum / f64::from(count))
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
    let grades: Vec<Grade> = tets.iter().map(|&t| mesh.grade(t)).collect();
    let star = Star {
        mesh,
        freedoms,
        vertex,
        tets: tets.iter().map(|&t| mesh.corners(t)).collect(),
        regions: tets.iter().map(|&t| mesh.region(t)).collect(),
        sizes: grades.iter().map(|g| g.six_volume).collect(),
    };
    let start = mesh.positions[vertex as usize];
    let qualities: Vec<f64> = grades.iter().map(|g| g.quality).collect();
    let least = smallest(&qualities);
    let to = match star.middle().filter(|_| least < FLAT) {
        Some(middle) if let Some(there) = star.qualities(middle, least.max(LEAST)) => {
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
    })
}

/// The best place found for a vertex that is new, from `start` on, and the grades of the tetrahedra at it. They are all
/// in one region, and may have a size of `most`, six volumes, in any case.
pub fn settle(
    mesh: &Mesh<'_>,
    freedoms: &Freedoms,
    start: DVec3,
    tets: &[Corners],
    (region, most): (u32, f64),
) -> (DVec3, Vec<Grade>) {
    let star = Star {
        mesh,
        freedoms,
        vertex: mesh.positions.len() as u32,
        tets: tets.to_vec(),
        regions: vec![region; tets.len()],
        sizes: vec![most; tets.len()],
    };
    let directions: Vec<DVec3> = Freedom::Free.directions().collect();
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
    let mut step = FIRST * size;
    for _ in 0..STEPS {
        if least >= 1.0 {
            break;
        }
        let difference = DIFFERENCE * size;
        let gradients: Vec<DVec3> = star
            .tets
            .iter()
            .zip(&qualities)
            .filter(|&(_, &q)| q <= least + ACTIVE * least.abs())
            .map(|(&t, &q)| star.gradient((t, q), p, directions, difference))
            .collect();
        let Some(up) = shortest_in_hull(&gradients).and_then(DVec3::try_normalize) else {
            break;
        };
        // Rounding must not lead away from where the vertex belongs.
        let up: DVec3 = directions.iter().map(|&d| d * d.dot(up)).sum();
        let mut better = None;
        for _ in 0..HALVINGS {
            let q = star.freedoms.place(star.vertex, p + up * step);
            let above = (least + GAIN * least.abs()).max(LEAST);
            if let Some(list) = star.qualities(q, above) {
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

/// The shortest vector in the convex hull of some, unless it is next to nothing, by Gilbert's algorithm (E.
/// Gilbert, "An iterative procedure for computing the minimum of a quadratic form on a convex set", 1966).
fn shortest_in_hull(list: &[DVec3]) -> Option<DVec3> {
    /// Iterations; more precision than this is of no use.
    const ROUNDS: usize = 20;
    let mut x = list
        .iter()
        .copied()
        .min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
    for _ in 0..ROUNDS {
        let lowest = list
            .iter()
            .copied()
            .min_by(|a, b| a.dot(x).total_cmp(&b.dot(x)))?;
        let gap = x.length_squared() - lowest.dot(x);
        if gap.is_nan() || gap <= 1e-3 * x.length_squared() {
            break;
        }
        let along = lowest - x;
        let t = (-x.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        x += along * t;
    }
    let longest = list.iter().map(|g| g.length_squared()).fold(0.0, f64::max);
    (x.length_squared() > NO_WAY * NO_WAY * longest).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_vector_is_found() {
        let found = shortest_in_hull(&[DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, -1.0, 0.0)]);
        assert!((found.unwrap() - DVec3::X).length() < 1e-2);
        let around = [DVec3::X, DVec3::NEG_X, DVec3::Y];
        assert_eq!(shortest_in_hull(&around), None);
        assert_eq!(shortest_in_hull(&[DVec3::Z]), Some(DVec3::Z));
        assert_eq!(shortest_in_hull(&[]), None);
    }
}
