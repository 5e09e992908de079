//! Points within a section, so that its triangles follow the seam.

use crate::cell::{Cell, Class, Part};
use crate::error::CutError;
use crate::graph::STRAIGHT;
use crate::section::{Known, Piece, Section};
use crate::surface::Surface;
use geom::cdt::{Broken, Patch, narrow};
use glam::DVec2;
use rustc_hash::FxHashMap;
use tmesh::{Frame, Triangle};

/// Adds points to a section until its triangles follow the seam: the middles of edges that are away from it, then
/// points that take narrow triangles out. Returns the points, which no face of the surface has.
///
/// # Errors
/// A section that is not a clean figure.
pub fn follow(
    surface: &mut Surface,
    cell: &Cell,
    part: Part,
    frame: &Frame,
) -> Result<Vec<u32>, CutError> {
    // Wedge and hub are closed apart.
    let is_own = |surface: &Surface, v: &u32| {
        let side = cell.hub().map_or(0, |h| surface.classes[*v as usize].of(h));
        if part.of_hub { side <= 0 } else { side >= 0 }
    };
    let faces = surface.faces.iter().copied();
    let faces: Vec<Triangle> = faces
        .filter(|f| f.vertices.iter().all(|v| is_own(surface, v)))
        .collect();
    let mut added = Vec::new();
    let mut is_rounded = false;
    // What turns the axis over takes its points elsewhere.
    let may_divide_axis = cell.joins.iter().all(|join| !join.step.flipped());
    for _ in 0..f64::MANTISSA_DIGITS {
        let corners = surface.corners.iter().copied();
        let piece = Piece {
            surface,
            faces: &faces,
            corners: corners.filter(|v| is_own(surface, v)).collect(),
        };
        let section = Section::new(&piece, cell, part);
        let cap = section.cap(&piece, cell, frame, &Known::default())?;
        let look = Look::new(surface, cell, &section, &cap);
        let mut new = look.middles(may_divide_axis);
        if new.is_empty() && may_divide_axis && look.is_bent() {
            new = look.borders();
        }
        if new.is_empty() && !is_rounded && look.is_bent() {
            is_rounded = true;
            new = look.rounded().unwrap_or_default();
        }
        if new.is_empty() {
            break;
        }
        for q in new {
            let (p, class) = cell.classify(part.at(&cell.faces, q));
            let inside = Class::INSIDE.with(part.face, 0);
            // The wall of the hub has been divided where it meets the seam.
            let border = cell.hub().map_or(inside, |hub| inside.with(hub, 0));
            let is_own = [inside, border].iter().any(|c| c.bound() == class.bound());
            if is_own || class.is_axis() && may_divide_axis {
                let v = surface.add(p, class);
                surface.corners.push(v);
                added.push(v);
            }
        }
    }
    Ok(added)
}

/// A triangulated section.
struct Look<'a> {
    cell: &'a Cell,
    section: &'a Section,
    cap: &'a [Triangle],
    at: FxHashMap<u32, DVec2>,
}

impl<'a> Look<'a> {
    fn new(surface: &Surface, cell: &'a Cell, section: &'a Section, cap: &'a [Triangle]) -> Self {
        let place = |&v: &u32| (v, section.place(surface, cell, v));
        Self {
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

    /// How far an edge is from the seam, in parts of its length.
    fn bulge(&self, ends: [u32; 2]) -> f64 {
        let [a, b] = ends.map(|v| self.at[&v]);
        self.cell
            .bulge(|s| self.section.part.at(&self.cell.faces, a.lerp(b, s)))
    }

    /// Where an edge within the section is to be divided: at a crease of the seam, else in the middle.
    fn middle(&self, ends: [u32; 2]) -> DVec2 {
        let [a, b] = ends.map(|v| self.at[&v]);
        let at = |s: f64| self.section.part.at(&self.cell.faces, a.lerp(b, s));
        a.lerp(b, self.cell.crease(at).unwrap_or(0.5))
    }

    /// Whether any edge inside is off the seam by more than rounding makes of it.
    fn is_bent(&self) -> bool {
        let inner = self.cap.iter().flat_map(edges).filter(|e| !self.is_rim(*e));
        inner
            .into_iter()
            .any(|e| self.bulge(e) > f64::EPSILON.sqrt())
    }

    /// The middles of edges that are away from the seam, as coordinates of the part. In the circle over an edge where the section ends
    /// there is none: that edge is divided instead, if nothing else holds it (Ruppert, as below). Edges from its end that pass
    /// beside it would be divided without end otherwise, each time nearer to it. `may_divide_axis`: whether those on the axis may be.
    fn middles(&self, may_divide_axis: bool) -> Vec<DVec2> {
        let mut bulges: FxHashMap<[u32; 2], f64> = FxHashMap::default();
        for ends in self.cap.iter().flat_map(edges) {
            bulges
                .entry(ends)
                .or_insert_with(|| match self.is_rim(ends) {
                    true => 0.0,
                    false => self.bulge(ends),
                });
        }
        let mut away: Vec<(f64, [u32; 2])> = bulges
            .iter()
            .filter(|(_, bulge)| **bulge > STRAIGHT)
            .map(|(&[v, w], _)| (self.at[&v].distance(self.at[&w]), [v, w]))
            .collect();
        away.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let ends = self.ends();
        let is_free = |ends: &[u32; 2]| {
            let on_axis = ends.iter().all(|v| self.at[v].x == 0.0);
            !self.is_rim(*ends) && (may_divide_axis || !on_axis)
        };
        // The longest first; what is near to one of them is divided by it, and looked at in the next round.
        let mut found: Vec<DVec2> = Vec::new();
        for (length, [v, w]) in away {
            let mut middle = self.middle([v, w]);
            let in_circle = |ends: &&[u32; 2]| {
                let [a, b] = ends.map(|v| self.at[&v]);
                **ends != [v, w] && (a - middle).dot(b - middle) < 0.0
            };
            match ends.iter().find(in_circle) {
                Some(end) if is_free(end) => middle = self.middle(*end),
                Some(_) => continue,
                None => {}
            }
            if found.iter().all(|q| q.distance(middle) >= length) {
                found.push(middle);
            }
        }
        found
    }

    /// The edges where the section ends, or a region within it.
    fn ends(&self) -> Vec<[u32; 2]> {
        let mut all: Vec<[u32; 2]> = self.cap.iter().flat_map(edges).collect();
        all.sort_unstable();
        let same = all.chunk_by(|a, b| a == b);
        let ends = same.filter(|same| same.len() == 1 || self.is_rim(same[0]));
        ends.map(|same| same[0]).collect()
    }

    /// The middles of edges along the axis and the hub, which nothing else holds, in whose circle the section has the circumcentre of
    /// a narrow triangle or a corner of one beside them (J. Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional mesh
    /// generation", 1995).
    fn borders(&self) -> Vec<DVec2> {
        let corners = |t: &Triangle| t.vertices.map(|v| self.at[&v]);
        let centres = self.cap.iter().filter_map(|t| Some(narrow(corners(t))?.1));
        let centres: Vec<DVec2> = centres.filter(|q| self.is_inside(*q)).collect();
        let mut uses: FxHashMap<[u32; 2], Vec<&Triangle>> = FxHashMap::default();
        for t in self.cap {
            for ends in edges(t) {
                uses.entry(ends).or_default().push(t);
            }
        }
        let open = uses
            .iter()
            .filter(|(ends, uses)| uses.len() == 1 && !self.is_rim(**ends));
        let mut found: Vec<([u32; 2], DVec2)> = open
            .filter_map(|(ends, uses)| {
                let apex = uses[0].vertices.iter().find(|v| !ends.contains(v))?;
                let [a, b] = ends.map(|v| self.at[&v]);
                let in_circle = |q: &DVec2| (a - *q).dot(b - *q) < 0.0;
                let is_crowded = in_circle(&self.at[apex]) || centres.iter().any(in_circle);
                is_crowded.then_some((*ends, a.midpoint(b)))
            })
            .collect();
        found.sort_unstable_by_key(|(ends, _)| *ends);
        found.into_iter().map(|(_, q)| q).collect()
    }

    fn is_inside(&self, q: DVec2) -> bool {
        self.cap.iter().any(|t| {
            let [a, b, c] = t.vertices.map(|v| self.at[&v]);
            let side = |a: DVec2, b: DVec2| (b - a).perp_dot(q - a);
            let sides = [side(a, b), side(b, c), side(c, a)];
            sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0)
        })
    }

    /// Points that take narrow triangles out; none of them is in the circle over an edge where the section ends.
    fn rounded(&self) -> Result<Vec<DVec2>, Broken> {
        let points = &self.section.points;
        let number = |v: u32| points.binary_search(&v).map_or(0, |i| i as u32);
        let mut uses: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        for ends in self.cap.iter().flat_map(edges) {
            *uses.entry(ends).or_default() += 1;
        }
        let is_end = |[v, w]: [u32; 2]| {
            let ends = [v.min(w), v.max(w)];
            uses[&ends] == 1 || self.is_rim(ends)
        };
        let mut outline: Vec<[u32; 2]> = (self.cap.iter())
            .flat_map(|t| {
                let [a, b, c] = t.vertices;
                let [p, q, r] = t.vertices.map(|v| self.at[&v]);
                match (q - p).perp_dot(r - p) > 0.0 {
                    true => [[a, b], [b, c], [c, a]],
                    false => [[b, a], [c, b], [a, c]],
                }
            })
            .filter(|ends| is_end(*ends))
            .map(|ends| ends.map(number))
            .collect();
        outline.sort_unstable();
        let places: Vec<DVec2> = points.iter().map(|v| self.at[v]).collect();
        let size = places.iter().fold(0.0_f64, |m, q| m.max(q.length()));
        let mut patch = Patch {
            fixed: places.len(),
            points: places,
            outline,
            rounding: f64::EPSILON.sqrt() * size,
            largest: f64::INFINITY,
        };
        let triangles = patch.triangulate()?;
        let inner = triangles
            .into_iter()
            .flatten()
            .filter(|i| *i as usize >= patch.fixed);
        let mut inner: Vec<u32> = inner.collect();
        inner.sort_unstable();
        inner.dedup();
        Ok(inner
            .into_iter()
            .map(|i| patch.points[i as usize])
            .collect())
    }
}

fn edges(t: &Triangle) -> [[u32; 2]; 3] {
    let [a, b, c] = t.vertices;
    [[a, b], [b, c], [c, a]].map(|[v, w]| [v.min(w), v.max(w)])
}
