//! Points within a section, so that its triangles follow the seam.

use crate::cell::{Cell, Class, Part};
use crate::error::CutError;
use crate::section::{Known, Piece, Section};
use crate::surface::Surface;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use tmesh::{Frame, Triangle};

/// How far the middle of an edge within a section may be from the seam, in parts of the edge's length: triangles
/// meet at a quarter of a radian at most, half of what is a feature for the stages that follow.
const BULGE: f64 = 1.0 / 32.0;

/// Largest circumradius over shortest side of a triangle that is not flat against its neighbours, as elements have by default.
const RATIO: f64 = 1.4;

/// Rounds of points: each at least halves what is too long.
const ROUNDS: usize = 24;

/// Adds points to a section until its triangles follow the seam: the middles of edges that are away from it, then
/// the circumcentres of narrow triangles beside edges that are not flat. Returns the points, which no face of the
/// surface has.
///
/// # Errors
/// A section that is not a clean figure.
pub fn follow(
    surface: &mut Surface,
    cell: &Cell,
    part: Part,
    frame: &Frame,
) -> Result<Vec<u32>, CutError> {
    let faces = surface.faces.clone();
    let sided: Vec<Triangle> = match cell.hub() {
        // The hub's wall is closed from outside.
        Some(hub) if part.face == hub => {
            let is_outer = |v: &u32| surface.classes[*v as usize].of(hub) >= 0;
            (faces.into_iter())
                .filter(|f| f.vertices.iter().all(is_outer))
                .collect()
        }
        _ => faces,
    };
    let mut added = Vec::new();
    for _ in 0..ROUNDS {
        let new = {
            let piece = Piece {
                surface,
                faces: &sided,
                corners: surface.corners.clone(),
            };
            let section = Section::new(&piece, cell, part);
            let cap = section.cap(&piece, cell, frame, &Known::default())?;
            Look::new(surface, cell, &section, &cap).points()
        };
        let before = added.len();
        for q in new {
            let (p, class) = cell.classify(part.at(&cell.faces, q));
            if class.bound() == Class::INSIDE.with(part.face, 0).bound() {
                let v = surface.add(p, class);
                surface.corners.push(v);
                added.push(v);
            }
        }
        if added.len() == before {
            break;
        }
    }
    Ok(added)
}

/// A triangulated section.
struct Look<'a> {
    surface: &'a Surface,
    cell: &'a Cell,
    section: &'a Section,
    cap: &'a [Triangle],
    at: FxHashMap<u32, DVec2>,
}

impl<'a> Look<'a> {
    fn new(
        surface: &'a Surface,
        cell: &'a Cell,
        section: &'a Section,
        cap: &'a [Triangle],
    ) -> Self {
        let place = |&v: &u32| (v, section.place(surface, cell, v));
        Self {
            surface,
            cell,
            section,
            cap,
            at: section.points.iter().map(place).collect(),
        }
    }

    fn is_rim(&self, ends: [u32; 2]) -> bool {
        let edges = &self.section.edges;
        edges.binary_search_by_key(&ends, |e| e.ends).is_ok()
    }

    /// How far the middle of an edge is from the seam, in parts of its length.
    fn bulge(&self, ends: [u32; 2]) -> f64 {
        let [p, q] = ends.map(|v| self.surface.points[v as usize]);
        let [a, b] = ends.map(|v| self.at[&v]);
        let middle: DVec3 = self.section.part.at(&self.cell.faces, a.midpoint(b));
        self.cell.bulge([p, q], middle)
    }

    /// Where points are missing, as coordinates of the part.
    fn points(&self) -> Vec<DVec2> {
        let edges = |t: &Triangle| {
            let [a, b, c] = t.vertices;
            [[a, b], [b, c], [c, a]].map(|[v, w]| [v.min(w), v.max(w)])
        };
        let mut bulges: FxHashMap<[u32; 2], f64> = FxHashMap::default();
        for ends in self.cap.iter().flat_map(edges) {
            bulges
                .entry(ends)
                .or_insert_with(|| match self.is_rim(ends) {
                    true => 0.0,
                    false => self.bulge(ends),
                });
        }
        let mut found: Vec<([u32; 2], DVec2)> = bulges
            .iter()
            .filter(|(_, bulge)| **bulge > BULGE)
            .map(|(&[v, w], _)| ([v, w], self.at[&v].midpoint(self.at[&w])))
            .collect();
        if !found.is_empty() {
            found.sort_unstable_by_key(|(ends, _)| *ends);
            return found.into_iter().map(|(_, q)| q).collect();
        }
        // Flat: off by no more than rounding makes of it.
        let is_bent = |t: &&Triangle| edges(t).iter().any(|e| bulges[e] > f64::EPSILON.sqrt());
        let mut centres: Vec<(DVec2, f64)> = Vec::new();
        for t in self.cap.iter().filter(is_bent) {
            let corners = t.vertices.map(|v| self.at[&v]);
            let sides = [0, 1, 2].map(|k| corners[k].distance(corners[(k + 1) % 3]));
            let shortest = sides.into_iter().fold(f64::INFINITY, f64::min);
            let Some(centre) = circumcentre(corners) else {
                continue;
            };
            let radius = centre.distance(corners[0]);
            if radius <= RATIO * shortest || !self.is_inside(centre) || self.is_at_rim(centre) {
                continue;
            }
            let apart =
                |&(other, reach): &(DVec2, f64)| centre.distance(other) >= radius.min(reach);
            if centres.iter().all(apart) {
                centres.push((centre, radius));
            }
        }
        centres.into_iter().map(|(centre, _)| centre).collect()
    }

    fn is_inside(&self, q: DVec2) -> bool {
        self.cap.iter().any(|t| {
            let [a, b, c] = t.vertices.map(|v| self.at[&v]);
            let side = |a: DVec2, b: DVec2| (b - a).perp_dot(q - a);
            let sides = [side(a, b), side(b, c), side(c, a)];
            sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0)
        })
    }

    /// Whether a point is in the circle over an edge where the section ends.
    fn is_at_rim(&self, q: DVec2) -> bool {
        self.section.edges.iter().any(|e| {
            let [a, b] = e.ends.map(|v| self.at[&v]);
            (a - q).dot(b - q) <= 0.0
        })
    }
}

fn circumcentre([a, b, c]: [DVec2; 3]) -> Option<DVec2> {
    let (u, v) = (b - a, c - a);
    let area = 2.0 * u.perp_dot(v);
    let (x, y) = (u.length_squared(), v.length_squared());
    let centre = a + DVec2::new(v.y * x - u.y * y, u.x * y - v.x * x) / area;
    centre.is_finite().then_some(centre)
}
