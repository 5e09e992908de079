//! Facets, and the corners that they are drawn between.

use super::sheets::{Reading, Sheets};
use geom::cdt::{Segment, triangulate};
use geom::flat::{Plane, Regions};
use geom::measure::{double_area_vector, triangle_area};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// Cosine of the angle from which on a line has a corner however short its parts are: a degree. Where they are longer, the
/// distance decides.
const STRAIGHT: f64 = 0.999_847_695_156_391_2;

/// The facets of a surface.
pub struct Drawing {
    /// Facet of each triangle.
    pub facet: Vec<u32>,
    /// The plane of each facet.
    pub planes: Vec<Plane>,
    /// Of each vertex, whether the outline of a facet has a corner there. Others are inside of a facet or on a straight edge.
    pub is_corner: Vec<bool>,
    /// Whether each edge is not just inside of one facet.
    is_drawn: Vec<bool>,
    /// How far what is in one plane, or in one line, may be off it.
    tolerance: f64,
}

/// The same surface, divided between corners alone.
pub struct Redrawn {
    /// Vertex ids, which are corners.
    pub triangles: Vec<[u32; 3]>,
    /// Facet of each, increasing.
    pub facet: Vec<u32>,
}

/// An edge of facets from corner to corner, and the edge of the mesh that it begins with.
struct Chord {
    ends: [u32; 2],
    first: u32,
}

impl Drawing {
    /// Finds facets, largest triangles first, which know their planes best, and corners. n log n.
    pub fn new(sheets: &Sheets<'_>, reading: Reading) -> Self {
        let count = sheets.triangles.len() as u32;
        let area = |t: u32| {
            let [a, b, c] = sheets.corners(t);
            double_area_vector(a, b, c).length_squared()
        };
        let areas: Vec<f64> = (0..count).map(area).collect();
        let mut order: Vec<u32> = (0..count).collect();
        order.sort_by(|&s, &t| areas[t as usize].total_cmp(&areas[s as usize]));
        let mut known: Option<(u32, Plane)> = None;
        let facets = Regions::grow(&sheets.across(), order, |seed, next| {
            let plane = match known {
                Some((of, plane)) if of == seed => plane,
                _ => known.insert((seed, Plane::of(sheets.corners(seed)))).1,
            };
            // As in `Patches`: however it is wound.
            let cosine = sheets.normals[next as usize].dot(plane.normal).abs();
            plane.normal != DVec3::ZERO
                && cosine >= reading.feature
                && plane.off(sheets.corners(next)) <= reading.flat
        });
        let planes = facets.seeds.iter().map(|&s| Plane::of(sheets.corners(s)));
        let mut drawing = Self {
            planes: planes.collect(),
            facet: facets.of,
            is_corner: Vec::new(),
            is_drawn: Vec::new(),
            tolerance: reading.flat,
        };
        let is_drawn = |edge: usize| !sheets.is_within(edge, &drawing.facet);
        drawing.is_drawn = (0..sheets.edges.len()).map(is_drawn).collect();
        drawing.is_corner = drawing.corners(sheets, reading);
        drawing
    }

    /// Of each vertex, the first two edges of outlines at it, and their number.
    fn drawn_at(&self, sheets: &Sheets<'_>) -> Vec<([u32; 2], u32)> {
        let mut at = vec![([0; 2], 0); sheets.points.len()];
        for (edge, ends) in (0..).zip(&sheets.edges.ends) {
            if self.is_drawn[edge as usize] {
                for &v in ends {
                    let (first, count) = &mut at[v as usize];
                    if let Some(slot) = first.get_mut(*count as usize) {
                        *slot = edge;
                    }
                    *count += 1;
                }
            }
        }
        at
    }

    fn corners(&self, sheets: &Sheets<'_>, reading: Reading) -> Vec<bool> {
        let facets = |edge: u32| {
            let around = sheets.edges.around(edge as usize).iter();
            let mut facets: Vec<u32> = around.map(|u| self.facet[u.triangle as usize]).collect();
            facets.sort_unstable();
            facets
        };
        let is_corner = |(v, &([e, f], count)): (u32, &([u32; 2], u32))| match count {
            0 => false,
            2 => {
                let here = sheets.points[v as usize];
                let [a, b] = [e, f].map(|e| sheets.points[other_end(sheets, e, v) as usize]);
                let (p, q) = (here - a, b - here);
                let off = p.cross((b - a).normalize_or_zero()).length();
                let bent = p.dot(q) < STRAIGHT * p.length() * q.length();
                bent || off > reading.flat || facets(e) != facets(f)
            }
            _ => true,
        };
        (0..).zip(&self.drawn_at(sheets)).map(is_corner).collect()
    }

    /// Divides the facets between corners. What cannot be, since what is in one plane but for its tolerance crosses itself
    /// there, stays as it is, and all its vertices become corners. n log n.
    pub fn redraw(&mut self, sheets: &Sheets<'_>) -> Redrawn {
        let mut of_facet: Vec<Vec<u32>> = vec![Vec::new(); self.planes.len()];
        for (t, &facet) in (0..).zip(&self.facet) {
            of_facet[facet as usize].push(t);
        }
        let mut stays = vec![false; self.planes.len()];
        loop {
            let outlines = self.outlines(sheets);
            let mut redrawn = Redrawn {
                triangles: Vec::new(),
                facet: Vec::new(),
            };
            let mut failed = false;
            for (facet, members) in (0..).zip(&of_facet) {
                let corners = || members.iter().flat_map(|&t| sheets.triangles[t as usize]);
                if !stays[facet as usize] && !corners().all(|v| self.is_corner[v as usize]) {
                    let outline = &outlines[facet as usize];
                    match self.divide(sheets, facet, members, outline) {
                        Some(made) => redrawn.triangles.extend(made),
                        None => {
                            (stays[facet as usize], failed) = (true, true);
                            corners().for_each(|v| self.is_corner[v as usize] = true);
                        }
                    }
                } else {
                    let own = members.iter().map(|&t| sheets.triangles[t as usize]);
                    redrawn.triangles.extend(own);
                }
                redrawn.facet.resize(redrawn.triangles.len(), facet);
            }
            if !failed {
                return redrawn;
            }
        }
    }

    /// The chords around each facet, which is to the left of them.
    fn outlines(&self, sheets: &Sheets<'_>) -> Vec<Vec<[u32; 2]>> {
        let mut outlines = vec![Vec::new(); self.planes.len()];
        for Chord { ends, first } in self.chords(sheets) {
            for u in sheets.edges.around(first as usize) {
                let t = u.triangle as usize;
                let facet = self.facet[t] as usize;
                let along = sheets.triangles[t][u.corner as usize] == ends[0];
                let upright = sheets.normals[t].dot(self.planes[facet].normal) >= 0.0;
                let [a, b] = ends;
                outlines[facet].push(if along == upright { [a, b] } else { [b, a] });
            }
        }
        outlines
    }

    fn chords(&self, sheets: &Sheets<'_>) -> Vec<Chord> {
        let at = self.drawn_at(sheets);
        let mut seen = vec![false; sheets.edges.len()];
        let mut chords = Vec::new();
        for (edge, ends) in (0..).zip(&sheets.edges.ends) {
            let Some(&start) = ends.iter().find(|v| self.is_corner[**v as usize]) else {
                continue;
            };
            if !self.is_drawn[edge as usize] || seen[edge as usize] {
                continue;
            }
            let (mut last, mut end) = (edge, start);
            loop {
                seen[last as usize] = true;
                end = other_end(sheets, last, end);
                let ([e, f], _) = at[end as usize];
                if self.is_corner[end as usize] {
                    break;
                }
                last = if e == last { f } else { e };
            }
            chords.push(Chord {
                ends: [start, end],
                first: edge,
            });
        }
        chords
    }

    /// Divides a facet; `None` where what comes out is not the facet.
    fn divide(
        &self,
        sheets: &Sheets<'_>,
        facet: u32,
        members: &[u32],
        outline: &[[u32; 2]],
    ) -> Option<Vec<[u32; 3]>> {
        let plane = self.planes[facet as usize];
        let (x, y) = plane.normal.any_orthonormal_pair();
        let mut vertices: Vec<u32> = (members.iter())
            .flat_map(|&t| sheets.triangles[t as usize])
            .filter(|&v| self.is_corner[v as usize])
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let numbers = (0..).zip(&vertices).map(|(i, &v)| (v, i));
        let number: FxHashMap<u32, u32> = numbers.collect();
        let place = |&v: &u32| {
            let p = sheets.points[v as usize] - plane.origin;
            [p.dot(x), p.dot(y)]
        };
        let points: Vec<[f64; 2]> = vertices.iter().map(place).collect();
        let mut sides: BTreeMap<[u32; 2], [bool; 2]> = BTreeMap::new();
        for &[a, b] in outline {
            let (low, high) = (a.min(b), a.max(b));
            sides.entry([low, high]).or_default()[usize::from(a != low)] = true;
        }
        let label = |inside: bool| Some(u32::from(inside));
        let segments: Option<Vec<Segment>> = (sides.iter())
            .map(|(ends, [left, right])| {
                Some(Segment {
                    ends: [*number.get(&ends[0])?, *number.get(&ends[1])?],
                    left: label(*left),
                    right: label(*right),
                })
            })
            .collect();
        let made = triangulate(&points, &segments?, 0).ok()?;
        let made: Vec<[u32; 3]> = (made.iter())
            .map(|(t, _)| t.map(|i| vertices[i as usize]))
            .collect();
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| sheets.points[v as usize]);
            triangle_area(a, b, c)
        };
        let new: f64 = made.iter().map(area).sum();
        let own = members.iter().map(|&t| area(&sheets.triangles[t as usize]));
        let old: f64 = own.sum();
        let length = |[a, b]: &[u32; 2]| {
            let [a, b] = [a, b].map(|&v| sheets.points[v as usize]);
            a.distance(b)
        };
        // Half of the digits: what is lost by rounding is far below, and a triangle that is wrong far above. And straight
        // edges are as straight as facets are flat.
        let bent = sides.keys().map(length).sum::<f64>() * self.tolerance;
        ((new - old).abs() <= f64::EPSILON.sqrt() * old + bent).then_some(made)
    }
}

/// The other end of an edge.
fn other_end(sheets: &Sheets<'_>, edge: u32, vertex: u32) -> u32 {
    let [a, b] = sheets.edges.ends[edge as usize];
    if a == vertex { b } else { a }
}
