//! Dividing of edges at the corners that lie beside them.

use super::near::near;
use super::rim::{Rim, half_box};
use crate::soup::surface::Surface;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// A corner at which an edge of a triangle is divided.
#[derive(Clone, Copy, Debug)]
pub struct Stitch {
    /// The corner.
    pub vertex: u32,
    /// The triangle of the file that has the edge, or a part of it.
    pub source: u32,
    /// The distance of the corner from the edge.
    pub gap: f64,
}

/// An edge that was divided.
#[derive(Clone, Debug)]
pub struct Division {
    /// Its ends.
    pub ends: [u32; 2],
    /// The corners that it was divided at, from the first end to the second.
    pub corners: Vec<u32>,
}

/// Where a corner lies beside an edge of the rim.
#[derive(Clone, Copy)]
struct Beside {
    gap: f64,
    /// By position among the open edges.
    edge: u32,
    /// From 0 at the start of the edge to 1 at its end.
    along: f64,
}

/// Divides edges of the rim at corners of it that lie beside them, at most `most` away; the nearest edge for each corner that
/// may not be joined to another one. `None` if too many are
/// near each other.
pub fn split(surface: &mut Surface, rim: &Rim, most: f64) -> Option<(Vec<Stitch>, Vec<Division>)> {
    let nearest = nearest_edges(surface, rim, most)?;
    // Of each triangle and corner: the corners on the edge that begins there.
    let mut on: BTreeMap<u32, [Vec<(f64, u32)>; 3]> = BTreeMap::new();
    let (mut stitches, mut divided) = (Vec::new(), Vec::new());
    for &vertex in &rim.vertices {
        let Some(beside) = nearest.get(&vertex) else {
            continue;
        };
        let edge = rim.open[beside.edge as usize];
        let chains = on.entry(edge.triangle).or_default();
        chains[edge.corner as usize].push((beside.along, vertex));
        stitches.push(Stitch {
            vertex,
            source: surface.source[edge.triangle as usize],
            gap: beside.gap,
        });
    }
    for (t, mut chains) in on {
        for chain in &mut chains {
            chain.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        }
        let chains = chains.map(|chain| chain.into_iter().map(|(_, v)| v).collect());
        let corners = surface.triangles[t as usize];
        let sides = (0..3)
            .zip(&chains)
            .map(|(i, chain): (usize, &Vec<u32>)| Division {
                ends: [corners[i], corners[(i + 1) % 3]],
                corners: chain.clone(),
            });
        divided.extend(sides.filter(|side| !side.corners.is_empty()));
        surface.replace(t, &fans(corners, chains));
    }
    Some((stitches, divided))
}

/// The parts of a triangle whose edges are divided at chains of corners, given for the edge that begins at each corner.
///
/// Each chain is seen from one point: none of the parts lies in a chain, where it would be a fold between what is on
/// either side of it.
pub fn fans(corners: [u32; 3], chains: [Vec<u32>; 3]) -> Vec<[u32; 3]> {
    let Some(first) = (0..3).find(|&i| !chains[i].is_empty()) else {
        return vec![corners];
    };
    let [a, b, c] = [0, 1, 2].map(|i| corners[(first + i) % 3]);
    let [ab, bc, ca] = [0, 1, 2].map(|i| &chains[(first + i) % 3]);
    let fan = |apex: u32, from: u32, chain: &[u32], to: u32| -> Vec<[u32; 3]> {
        let whole = [&[from], chain, &[to]].concat();
        whole.windows(2).map(|w| [apex, w[0], w[1]]).collect()
    };
    let mut parts = fan(c, a, ab, b);
    // The other two edges belong to the last and the first of these.
    let (p, q) = (ab[0], ab[ab.len() - 1]);
    if !bc.is_empty() {
        parts.pop();
        parts.extend(fan(q, b, bc, c));
    }
    if !ca.is_empty() {
        parts.remove(0);
        parts.extend(fan(p, c, ca, a));
    }
    parts
}

/// For each corner of the rim, the nearest edge of it in reach that runs the other way.
fn nearest_edges(surface: &Surface, rim: &Rim, most: f64) -> Option<FxHashMap<u32, Beside>> {
    let ends = |edge: u32| {
        let open = rim.open[edge as usize];
        let t = surface.triangles[open.triangle as usize];
        [0, 1, 2].map(|i| t[(open.corner as usize + i) % 3])
    };
    let point = |v: u32| surface.points[v as usize];
    let count = rim.open.len() as u32;
    let mut boxes = Vec::with_capacity(rim.open.len() + rim.vertices.len());
    for edge in 0..count {
        let [a, b, _] = ends(edge).map(point);
        boxes.push(half_box(a.min(b), a.max(b), rim.edge_reach(edge, most)));
    }
    for &v in &rim.vertices {
        boxes.push(half_box(point(v), point(v), rim.reach(v, most)));
    }
    let runs = directions(surface, rim);
    let waiting = waiting(surface, rim)?;
    let mut nearest: FxHashMap<u32, Beside> = FxHashMap::default();
    let complete = near(
        &boxes,
        |i| u32::from(i < count),
        |edge, i| {
            let vertex = rim.vertices[(i - count) as usize];
            let corners = ends(edge);
            let [a, b, c] = corners.map(point);
            let along = b - a;
            let opposed = runs
                .get(&vertex)
                .is_some_and(|r| r.iter().any(|d| d.dot(along) < 0.0));
            if corners.contains(&vertex) || !opposed || waiting.contains(&vertex) {
                return;
            }
            let off = point(vertex) - a;
            let f = off.dot(along) / along.length_squared();
            let across = off - along * f;
            let gap = across.length();
            let reach = rim.reach(vertex, most).min(rim.edge_reach(edge, most));
            // Towards its apex, a triangle's edge is moved by less than the triangle is high.
            let up = (c - a).reject_from(along);
            let passes =
                gap > rim.edge_reach(edge, 0.0) && across.dot(up) > 0.5 * up.length_squared();
            if !(f > 0.0 && f < 1.0 && gap <= reach)
                || passes
                || !rim.may_close(&[vertex, corners[0], corners[1]], gap)
            {
                return;
            }
            let beside = Beside {
                gap,
                edge,
                along: f,
            };
            let known = nearest.entry(vertex).or_insert(beside);
            if (gap, edge) < (known.gap, known.edge) {
                *known = beside;
            }
        },
    );
    complete.then_some(nearest)
}

/// Corners that may be joined to another one of the rim, and are no corners on edges.
fn waiting(surface: &Surface, rim: &Rim) -> Option<FxHashSet<u32>> {
    let point = |i: u32| surface.points[rim.vertices[i as usize] as usize];
    let boxes: Vec<_> = (0..rim.vertices.len() as u32)
        .map(|i| {
            let reach = rim.reach(rim.vertices[i as usize], f64::INFINITY);
            half_box(point(i), point(i), reach)
        })
        .collect();
    let mut waiting = FxHashSet::default();
    let complete = near(
        &boxes,
        |i| i,
        |i, j| {
            let corners = [i, j].map(|i| rim.vertices[i as usize]);
            if rim.may_join(corners, point(i).distance(point(j))) {
                waiting.extend(corners);
            }
        },
    );
    complete.then_some(waiting)
}

/// The directions in which open edges run through each corner.
fn directions(surface: &Surface, rim: &Rim) -> FxHashMap<u32, Vec<DVec3>> {
    let mut runs: FxHashMap<u32, Vec<DVec3>> = FxHashMap::default();
    for open in &rim.open {
        let t = surface.triangles[open.triangle as usize];
        let ends = [0, 1].map(|i| t[(open.corner as usize + i) % 3]);
        let [a, b] = ends.map(|v| surface.points[v as usize]);
        for v in ends {
            runs.entry(v).or_default().push(b - a);
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_are_seen_from_one_point_each() {
        assert_eq!(fans([0, 1, 2], Default::default()), [[0, 1, 2]]);
        let one = fans([0, 1, 2], [vec![], vec![3, 4], vec![]]);
        assert_eq!(one, [[0, 1, 3], [0, 3, 4], [0, 4, 2]]);
        let all = fans([0, 1, 2], [vec![3, 4], vec![5], vec![6]]);
        assert_eq!(all, [[2, 3, 4], [4, 1, 5], [4, 5, 2], [3, 2, 6], [3, 6, 0]]);
    }
}
