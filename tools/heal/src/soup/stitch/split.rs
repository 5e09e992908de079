//! Dividing of edges at the corners that lie beside them.

use super::near::near;
use super::rim::{Rim, half_box};
use crate::facet::triangles_of;
use crate::soup::surface::Surface;
use geom::measure::double_area_vector;
use glam::DVec3;
use rustc_hash::FxHashMap;
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

/// Where a corner lies beside an edge of the rim.
#[derive(Clone, Copy)]
struct Beside {
    gap: f64,
    /// By position among the open edges.
    edge: u32,
    /// From 0 at the start of the edge to 1 at its end.
    along: f64,
}

/// Divides edges of the rim at corners of it that lie beside them; the nearest one for each corner. `None` if too many are
/// near each other.
pub fn split(surface: &mut Surface, rim: &Rim, equal: f64) -> Option<Vec<Stitch>> {
    let nearest = nearest_edges(surface, rim, equal)?;
    // Of each triangle and corner: the corners on the edge that begins there.
    let mut on: BTreeMap<u32, [Vec<(f64, u32)>; 3]> = BTreeMap::new();
    let mut stitches = Vec::new();
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
    for (t, chains) in on {
        let corners = surface.triangles[t as usize];
        let whole = (0..3).find(|&i| chains[i].is_empty()).unwrap_or(0);
        let mut polygon = Vec::new();
        // The edge that begins at the first corner is whole, if there is one, so that a fan has no flat triangle there.
        for i in (0..3).map(|i| (whole + 1 + i) % 3) {
            let mut chain = chains[i].clone();
            chain.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            polygon.push(corners[i]);
            polygon.extend(chain.into_iter().map(|(_, v)| v));
        }
        let parts = triangles_of(&surface.points, &polygon);
        surface.replace(t, &parts);
    }
    Some(stitches)
}

/// For each corner of the rim, the nearest edge of it in reach that runs the other way.
fn nearest_edges(surface: &Surface, rim: &Rim, equal: f64) -> Option<FxHashMap<u32, Beside>> {
    let ends = |edge: u32| {
        let open = rim.open[edge as usize];
        let t = surface.triangles[open.triangle as usize];
        [0, 1, 2].map(|i| t[(open.corner as usize + i) % 3])
    };
    let point = |v: u32| surface.points[v as usize];
    // An edge is moved by less than its triangle is high.
    let reach = |edge: u32| {
        let [a, b, c] = ends(edge).map(point);
        let base = (b - a).length();
        let height = double_area_vector(a, b, c).length() / base;
        (0.5 * height.min(base)).max(equal)
    };
    let count = rim.open.len() as u32;
    let reaches: Vec<f64> = (0..count).map(reach).collect();
    let mut boxes = Vec::with_capacity(rim.open.len() + rim.vertices.len());
    for edge in 0..count {
        let [a, b, _] = ends(edge).map(point);
        boxes.push(half_box(a.min(b), a.max(b), reaches[edge as usize]));
    }
    for &v in &rim.vertices {
        boxes.push(half_box(point(v), point(v), rim.reach[v as usize]));
    }
    let runs = directions(surface, rim);
    let mut nearest: FxHashMap<u32, Beside> = FxHashMap::default();
    let complete = near(
        &boxes,
        |i| u32::from(i < count),
        |edge, i| {
            let vertex = rim.vertices[(i - count) as usize];
            let corners = ends(edge);
            let [a, b, _] = corners.map(point);
            let along = b - a;
            let opposed = runs
                .get(&vertex)
                .is_some_and(|r| r.iter().any(|d| d.dot(along) < 0.0));
            if corners.contains(&vertex) || !opposed {
                return;
            }
            let off = point(vertex) - a;
            let f = off.dot(along) / along.length_squared();
            let gap = (off - along * f).length();
            let reach = rim.reach[vertex as usize].min(reaches[edge as usize]);
            if !(f > 0.0 && f < 1.0 && gap <= reach) {
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
