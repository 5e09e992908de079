//! Where a surface meets a part of a cutting face.

use crate::cell::{Cell, Part};
use crate::surface::Surface;
use geom::predicate::orientation;
use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{RegionMap, Triangle};

/// Some faces of a surface, and the corners of the cell that belong to them.
pub struct Piece<'a> {
    /// The points.
    pub surface: &'a Surface,
    /// The faces.
    pub faces: &'a [Triangle],
    /// Points where cutting faces meet; no face of the surface has them unless it passes there.
    pub corners: Vec<u32>,
}

/// An edge of a section with the regions on either side of it within the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SectionEdge {
    /// Point ids, lower one first.
    pub ends: [u32; 2],
    /// Region to the left, seen as the part's coordinates are drawn.
    pub left: u32,
    /// Region to the right.
    pub right: u32,
}

/// Where a surface meets a part of a cutting face.
#[derive(Clone, Debug)]
pub struct Section {
    /// The part.
    pub part: Part,
    /// Points of the surface on the part, increasing.
    pub points: Vec<u32>,
    /// Edges, in order of their ends.
    pub edges: Vec<SectionEdge>,
}

impl Section {
    /// Collects the points and edges of a surface on a part.
    pub fn new(piece: &Piece<'_>, cell: &Cell, part: Part) -> Self {
        let on: Vec<bool> = piece
            .surface
            .points
            .iter()
            .zip(&piece.surface.classes)
            .map(|(&p, &class)| part.contains(&cell.faces, p, class))
            .collect();
        let mut points = FxHashSet::default();
        let mut fans: FxHashMap<[u32; 2], Vec<(u32, bool)>> = FxHashMap::default();
        for (i, face) in piece.faces.iter().enumerate() {
            for k in 0..3 {
                let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
                if !on[v as usize] {
                    continue;
                }
                points.insert(v);
                if on[w as usize] {
                    let (key, forward) = if v < w {
                        ([v, w], true)
                    } else {
                        ([w, v], false)
                    };
                    fans.entry(key).or_default().push((i as u32, forward));
                }
            }
        }
        points.extend(piece.corners.iter().filter(|&&v| on[v as usize]));
        let mut points: Vec<u32> = points.into_iter().collect();
        points.sort_unstable();
        let out = part.faces_out(&cell.faces);
        let mut edges: Vec<SectionEdge> = fans
            .into_iter()
            .map(|(ends, fan)| edge(piece, out, ends, &fan))
            .collect();
        edges.sort_unstable_by_key(|e| e.ends);
        Self {
            part,
            points,
            edges,
        }
    }

    /// Coordinates of a point of the part.
    pub fn place(&self, surface: &Surface, cell: &Cell, v: u32) -> DVec2 {
        self.part.place(&cell.faces, surface.points[v as usize])
    }

    /// Gives regions other names.
    pub fn rename(&mut self, regions: &RegionMap) {
        for e in &mut self.edges {
            (e.left, e.right) = (regions.get(e.left), regions.get(e.right));
        }
    }
}

/// The regions beside an edge: those that its outermost faces turn towards the part. `out`: whether the part's
/// coordinates are drawn as seen from outside.
fn edge(piece: &Piece<'_>, out: bool, ends: [u32; 2], fan: &[(u32, bool)]) -> SectionEdge {
    let [a, b] = ends.map(|v| piece.surface.points[v as usize]);
    let apex = |f: u32| {
        let v = piece.faces[f as usize]
            .vertices
            .into_iter()
            .find(|v| !ends.contains(v));
        piece.surface.points[v.unwrap_or(ends[0]) as usize]
    };
    // All apexes lie on one side of the part, so pairwise order is a total one. A positive
    // orientation puts q to the left of p seen from outside.
    let sign = if out { 1.0 } else { -1.0 };
    let (mut leftmost, mut rightmost) = (fan[0], fan[0]);
    for &use_ in &fan[1..] {
        if sign * orientation(a, b, apex(leftmost.0), apex(use_.0)) > 0.0 {
            leftmost = use_;
        }
        if sign * orientation(a, b, apex(rightmost.0), apex(use_.0)) < 0.0 {
            rightmost = use_;
        }
    }
    let towards = |(f, forward): (u32, bool), left: bool| {
        let face = &piece.faces[f as usize];
        if (forward == out) == left {
            face.front
        } else {
            face.back
        }
    };
    SectionEdge {
        ends,
        left: towards(leftmost, true),
        right: towards(rightmost, false),
    }
}
