//! The section of a body as chains: curves between the points where more than two of its edges meet,
//! or where it meets the axis or another cutting face, and closed curves.

use super::edges::{Section, SectionEdge};
use crate::cell::Cell;
use crate::surface::Surface;
use glam::DVec2;
use rustc_hash::FxHashMap;

/// A place on a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Index of the edge within the chain.
    pub edge: usize,
    /// Share of the way along it.
    pub at: f64,
}

/// A curve of a section with the same two regions along all of it.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Points in order; of a closed curve the first one is repeated at the end.
    pub points: Vec<u32>,
    /// Index of the section's edge from each point to the next.
    pub edges: Vec<usize>,
    /// Distance from the axis and height of each point.
    pub at: Vec<DVec2>,
    /// Regions to the left and to the right; the lower one is to the left.
    pub kind: [u32; 2],
}

impl Chain {
    /// Whether it has no ends.
    pub fn is_closed(&self) -> bool {
        self.points.first() == self.points.last()
    }

    /// Walks it the other way.
    pub fn reverse(&mut self) {
        self.points.reverse();
        self.edges.reverse();
        self.at.reverse();
        self.kind.reverse();
    }

    /// Starts a closed curve at another of its points.
    pub fn start_at(&mut self, first: usize) {
        let n = self.edges.len();
        self.points.truncate(n);
        self.at.truncate(n);
        self.points.rotate_left(first % n);
        self.edges.rotate_left(first % n);
        self.at.rotate_left(first % n);
        self.points.push(self.points[0]);
        self.at.push(self.at[0]);
    }

    /// The place on the curve nearest to a point, and its distance.
    pub fn nearest(&self, p: DVec2) -> (Place, f64) {
        let mut best = (Place { edge: 0, at: 0.0 }, f64::INFINITY);
        for (edge, w) in self.at.windows(2).enumerate() {
            let (at, distance) = project(p, w[0], w[1]);
            if distance < best.1 {
                best = (Place { edge, at }, distance);
            }
        }
        best
    }
}

/// The place on a segment nearest to a point, as a share of the way from `a` to `b`, and the distance.
pub fn project(p: DVec2, a: DVec2, b: DVec2) -> (f64, f64) {
    let along = b - a;
    let length = along.length_squared();
    let at = match length > 0.0 {
        true => ((p - a).dot(along) / length).clamp(0.0, 1.0),
        false => 0.0,
    };
    (at, (a + along * at).distance(p))
}

/// The chains of a section, and the points where chains end or that no edge has.
pub fn chains(surface: &Surface, cell: &Cell, section: &Section) -> (Vec<Chain>, Vec<u32>) {
    let mut around: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
    for (i, e) in section.edges.iter().enumerate() {
        for v in e.ends {
            around.entry(v).or_default().push(i);
        }
    }
    let edges = |v: u32| around.get(&v).map_or(&[][..], |list| list.as_slice());
    let is_node = |v: u32| {
        let [e, f] = edges(v) else {
            return true;
        };
        let [e, f] = [*e, *f].map(|i| &section.edges[i]);
        let class = surface.classes[v as usize];
        let passes = kind_from(e, v) == [f.left, f.right] && f.ends[1] == v
            || kind_from(e, v) == [f.right, f.left] && f.ends[0] == v;
        class.is_fixed() || !passes
    };
    let nodes: Vec<u32> = (section.points.iter().copied())
        .filter(|&v| is_node(v))
        .collect();
    let mut used = vec![false; section.edges.len()];
    let mut found = Vec::new();
    let mut trace = |start: u32, first: usize| {
        if used[first] {
            return;
        }
        let mut chain = Chain {
            points: vec![start],
            edges: Vec::new(),
            at: Vec::new(),
            kind: kind_from(&section.edges[first], start),
        };
        let (mut v, mut e) = (start, first);
        loop {
            used[e] = true;
            chain.edges.push(e);
            let ends = section.edges[e].ends;
            v = if ends[0] == v { ends[1] } else { ends[0] };
            chain.points.push(v);
            let next = edges(v).iter().find(|f| !used[**f]);
            match next {
                Some(&f) if v != start && !is_node(v) => e = f,
                _ => break,
            }
        }
        // Both sections share what lies on the axis, and on a line that divides a face into both.
        let class = |v: &u32| surface.classes[*v as usize];
        let on_fold = |v: &u32| cell.is_on_fold(section.part.face, class(v));
        if chain.points.iter().all(|v| class(v).is_axis()) || chain.points.iter().all(on_fold) {
            return;
        }
        let place = |v: &u32| section.place(surface, cell, *v);
        chain.at = chain.points.iter().map(place).collect();
        if chain.kind[0] > chain.kind[1] {
            chain.reverse();
        }
        found.push(chain);
    };
    for &v in &nodes {
        edges(v).iter().for_each(|&e| trace(v, e));
    }
    for (i, e) in section.edges.iter().enumerate() {
        trace(e.ends[0], i);
    }
    (found, nodes)
}

/// Regions to the left and right of an edge, walked from one of its ends.
fn kind_from(edge: &SectionEdge, start: u32) -> [u32; 2] {
    match edge.ends[0] == start {
        true => [edge.left, edge.right],
        false => [edge.right, edge.left],
    }
}
