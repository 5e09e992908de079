//! Curves that sharp edges are chords of.

use crate::shape::smooth::facets::{Facets, is_straight};
use crate::shape::smooth::heights::{Border, Heights};
use crate::shape::table::Table;
use geom::edges::EdgeUse;
use geom::smooth::SMOOTH_COSINE;
use glam::DVec3;

/// A sharp edge, as it was drawn: edges that only divide it are one.
struct Chord {
    /// Its edges in order, where each of them starts and ends along it, and whether it runs that way itself.
    edges: Vec<(u32, [f64; 2], bool)>,
    /// The vertices that it ends at.
    ends: [u32; 2],
    length: f64,
    /// Whether all its edges are sharper than any that a smooth surface is drawn with.
    is_certain: bool,
}

/// Sharp edges with the vertices that they join.
struct SharpEdges<'a> {
    facets: &'a Facets<'a>,
    at_vertex: Table,
}

/// Lets the borders of facets follow the curves that they are chords of: the circle through the corners of a polyline
/// at one of its ends, the narrower one.
pub fn follow(facets: &Facets<'_>, is_smooth: &[bool], heights: &mut [Heights]) {
    let sharp: Vec<u32> = (0..facets.edges.len() as u32)
        .filter(|e| !is_smooth[*e as usize])
        .collect();
    let at = |&e: &u32| facets.edges.ends[e as usize].map(|v| (v, e));
    let pairs: Vec<(u32, u32)> = sharp.iter().flat_map(at).collect();
    let edges = SharpEdges {
        facets,
        at_vertex: Table::new(facets.vertices.len(), pairs.into_iter()),
    };
    let chords = edges.chords(&sharp);
    let both = chords.iter().enumerate();
    let ends: Vec<(u32, u32)> = both
        .flat_map(|(i, c)| c.ends.map(|v| (v, i as u32)))
        .collect();
    let at_end = Table::new(facets.vertices.len(), ends.into_iter());
    for chord in &chords {
        let [k, l] = chord
            .ends
            .map(|v| edges.curvature(&chords, at_end.of(v), v));
        let curvature = if k.length_squared() > l.length_squared() {
            k
        } else {
            l
        };
        edges.bend(chord, curvature, heights);
    }
}

impl SharpEdges<'_> {
    /// Joins edges at vertices where they only go straight on. Linear.
    fn chords(&self, sharp: &[u32]) -> Vec<Chord> {
        let mut seen = vec![false; self.facets.edges.len()];
        let mut chords = Vec::new();
        for &first in sharp {
            if seen[first as usize] {
                continue;
            }
            let [start, _] = self.facets.edges.ends[first as usize];
            // Back to where the chord starts, then along it.
            let (mut edge, mut from) = (first, start);
            while let Some(next) = self.straight_on(edge, from) {
                if next == first {
                    break;
                }
                (edge, from) = (next, self.other_end(next, from));
            }
            let mut chord = Chord {
                edges: Vec::new(),
                ends: [from; 2],
                length: 0.0,
                is_certain: true,
            };
            let mut next = Some(edge);
            while let Some(edge) = next.filter(|e| !seen[*e as usize]) {
                seen[edge as usize] = true;
                let forward = self.facets.edges.ends[edge as usize][0] == chord.ends[1];
                let end = self.other_end(edge, chord.ends[1]);
                let [p, q] = [chord.ends[1], end].map(|v| self.facets.vertices[v as usize]);
                let start = chord.length;
                chord.length += (q - p).length();
                chord.edges.push((edge, [start, chord.length], forward));
                chord.is_certain &= !self.facets.may_be_smooth(edge as usize);
                chord.ends[1] = end;
                next = self.straight_on(edge, end);
            }
            chords.push(chord);
        }
        chords
    }

    fn other_end(&self, edge: u32, vertex: u32) -> u32 {
        let [a, b] = self.facets.edges.ends[edge as usize];
        if a == vertex { b } else { a }
    }

    /// The edge that goes straight on beyond one of the ends of another.
    fn straight_on(&self, edge: u32, vertex: u32) -> Option<u32> {
        let &[e, f] = self.at_vertex.of(vertex) else {
            return None;
        };
        let here = self.facets.vertices[vertex as usize];
        let away = |edge: u32| {
            let end = self.facets.vertices[self.other_end(edge, vertex) as usize];
            (end - here).normalize_or_zero()
        };
        is_straight(away(e), away(f)).then_some(if e == edge { f } else { e })
    }

    /// Curvature vector of the polyline at a vertex where two chords meet, zero where it has a corner. Of more than two,
    /// those that are sharp for certain are the border of a face, and the others are inside of it or end there.
    fn curvature(&self, chords: &[Chord], there: &[u32], vertex: u32) -> DVec3 {
        let certain: Vec<u32> = (there.iter().copied())
            .filter(|c| chords[*c as usize].is_certain)
            .collect();
        let ((&[e, f], _) | (_, &[e, f])) = (there, &certain[..]) else {
            return DVec3::ZERO;
        };
        let here = self.facets.vertices[vertex as usize];
        let [a, b] = [e, f].map(|i| {
            let [p, q] = chords[i as usize].ends;
            let end = if p == vertex { q } else { p };
            self.facets.vertices[end as usize] - here
        });
        let (m, n) = (a.normalize_or_zero(), b.normalize_or_zero());
        if -m.dot(n) < SMOOTH_COSINE {
            return DVec3::ZERO;
        }
        (m + n) * (2.0 / (a.length() + b.length()))
    }

    /// Lets facets along a chord follow a curve of this curvature.
    fn bend(&self, chord: &Chord, curvature: DVec3, heights: &mut [Heights]) {
        let facets = self.facets;
        for &(edge, [from, to], forward) in &chord.edges {
            for u in facets.edges.around(edge as usize) {
                let height = -0.125 * (to - from).powi(2) * curvature.dot(facets.normal(u));
                let heights = &mut heights[u.triangle as usize];
                follow_side(heights, u, height);
                let along = if u.forward == forward {
                    [from, to]
                } else {
                    [to, from]
                };
                heights.border[u.corner as usize] = Border {
                    along: along.map(|at| at as f32),
                    length: chord.length as f32,
                    curvature: curvature.length() as f32,
                    fitted: 0.0,
                };
            }
        }
    }
}

/// Raises a triangle to the height of a curve above one of its sides, which is as uncertain as it is higher.
fn follow_side(heights: &mut Heights, u: &EdgeUse, height: f64) {
    let side = &mut heights.side[u.corner as usize];
    let old = f64::from(*side);
    if height.abs() > old.abs() {
        *side = height as f32;
        heights.slack = heights.slack.max((height - old).abs() as f32);
    }
}
