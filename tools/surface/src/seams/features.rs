//! Feature edges: where facets meet, end, or touch something else, and how the guide divides them.

use super::guide::Refined;
use crate::SurfaceError;
use geom::edges::{EdgeUse, Edges};
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::Template;

/// No number.
pub const NONE: u32 = u32::MAX;

/// A point that the guide put on a feature edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along {
    /// Part of the way from the edge's first to its second end, in (0, 1).
    pub t: f64,
    /// Guide vertex.
    pub vertex: u32,
}

/// The feature edges of a template.
pub struct Features {
    /// Template vertices, lower one first.
    pub ends: Vec<[u32; 2]>,
    /// The guide's points on each edge, in order.
    pub points: Vec<Vec<Along>>,
    /// Of each guide vertex, whether it is on a feature edge.
    pub on: Vec<bool>,
    of_ends: FxHashMap<[u32; 2], u32>,
}

impl Features {
    /// Finds the feature edges of a template, and the guide's points on them.
    ///
    /// # Errors
    /// [`SurfaceError::Guide`] when the guide does not divide just these edges.
    pub fn new(template: &Template, index: usize, guide: &Refined) -> Result<Self, SurfaceError> {
        let corners: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        let edges = Edges::new(&corners);
        let ends: Vec<[u32; 2]> = (0..edges.len())
            .filter(|&e| is_feature(edges.around(e), &guide.facets.of_triangle))
            .map(|e| edges.ends[e])
            .collect();
        let of_ends: FxHashMap<[u32; 2], u32> = ends
            .iter()
            .enumerate()
            .map(|(i, &e)| (e, i as u32))
            .collect();

        let fine = Fine::new(guide);
        let mut points: Vec<Option<Vec<Along>>> = vec![None; ends.len()];
        for start in 0..fine.kept {
            for &[_, first] in fine.around(start) {
                let (end, walked) = fine
                    .walk(start, first)
                    .map_err(|place| odd(index, "a new vertex where edges fork", place))?;
                let [a, b] = [start, end].map(|v| guide.vertex_of_point[v as usize]);
                if a > b {
                    continue;
                }
                let place = guide.vertices[start as usize];
                let Some(&edge) = of_ends.get(&[a, b]) else {
                    return Err(odd(index, "an edge that was not there", place));
                };
                let between = [a, b].map(|v| template.vertices[v as usize]);
                let Some(along) = fine.along(between, &walked) else {
                    return Err(odd(index, "an edge whose points are not in order", place));
                };
                points[edge as usize] = Some(along);
            }
        }
        let lost = points.iter().position(Option::is_none);
        if let Some(edge) = lost {
            let place = template.vertices[ends[edge][0] as usize];
            return Err(odd(index, "a lost edge", place));
        }
        Ok(Self {
            ends,
            points: points.into_iter().flatten().collect(),
            on: fine.on(),
            of_ends,
        })
    }

    /// The edge between two template vertices, and whether they are its ends in reverse.
    pub fn find(&self, a: u32, b: u32) -> Option<(usize, bool)> {
        let edge = self.of_ends.get(&[a.min(b), a.max(b)])?;
        Some((*edge as usize, a > b))
    }
}

fn odd(template: usize, what: &'static str, place: DVec3) -> SurfaceError {
    SurfaceError::Guide {
        template,
        what,
        place,
    }
}

/// The feature edges of the guide.
struct Fine<'a> {
    guide: &'a Refined,
    /// The first vertices are those of the template.
    kept: u32,
    /// Both directions of each edge, in order.
    next: Vec<[u32; 2]>,
}

impl<'a> Fine<'a> {
    fn new(guide: &'a Refined) -> Self {
        let fine = Edges::new(&guide.triangles);
        let mut next: Vec<[u32; 2]> = (0..fine.len())
            .filter(|&e| is_feature(fine.around(e), &guide.facet))
            .flat_map(|e| {
                let [a, b] = fine.ends[e];
                [[a, b], [b, a]]
            })
            .collect();
        next.sort_unstable();
        Self {
            guide,
            kept: guide.vertex_of_point.len() as u32,
            next,
        }
    }

    /// Of each vertex, whether it is on a feature edge.
    fn on(&self) -> Vec<bool> {
        let mut on = vec![false; self.guide.vertices.len()];
        self.next.iter().for_each(|e| on[e[0] as usize] = true);
        on
    }

    /// The edges from a vertex.
    fn around(&self, v: u32) -> &[[u32; 2]] {
        let first = self.next.partition_point(|e| e[0] < v);
        let last = self.next.partition_point(|e| e[0] <= v);
        &self.next[first..last]
    }

    /// Walks along new vertices to the next one of the template; gives that, and those on the way. The error is the place
    /// of a fork.
    fn walk(&self, start: u32, first: u32) -> Result<(u32, Vec<u32>), DVec3> {
        let (mut before, mut here) = (start, first);
        let mut walked = Vec::new();
        while here >= self.kept {
            walked.push(here);
            let ways = self.around(here);
            let onward = ways.iter().find(|e| e[1] != before);
            let (2, Some(onward)) = (ways.len(), onward) else {
                return Err(self.guide.vertices[here as usize]);
            };
            (before, here) = (here, onward[1]);
        }
        Ok((here, walked))
    }

    /// How vertices divide the way between two points, if they do so in order.
    fn along(&self, [p, q]: [DVec3; 2], walked: &[u32]) -> Option<Vec<Along>> {
        let along: Vec<Along> = walked
            .iter()
            .map(|&vertex| {
                let d = self.guide.vertices[vertex as usize] - p;
                let t = d.dot(q - p) / (q - p).length_squared();
                Along { t, vertex }
            })
            .collect();
        let ordered = along.windows(2).all(|w| w[0].t < w[1].t);
        let inside = along.iter().all(|x| x.t > 0.0 && x.t < 1.0);
        (ordered && inside).then_some(along)
    }
}

/// All but what runs through the inside of a single facet.
fn is_feature(around: &[EdgeUse], facet: &[u32]) -> bool {
    !matches!(around, [a, b]
        if a.forward != b.forward && facet[a.triangle as usize] == facet[b.triangle as usize])
}
