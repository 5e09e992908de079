//! Dividing edges that bend where the seam passes them.

use crate::cell::{Cell, Face};
use crate::graph::{Graph, STRAIGHT, samples};
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{Template, Triangle};

/// Divides the edges of a surface that are near the faces of a cell which begin at the axis, or near the hub's, and are bent when
/// they are straightened, until each passes every face at one point. Model units; the surface is not yet straightened.
pub fn divide(surface: &mut Template, graph: &Graph, cell: &Cell) -> usize {
    let faces: Vec<&Face> = cell.faces.iter().filter(|f| !f.is_across()).collect();
    let before = surface.vertices.len();
    // An edge that is halved as often as a number has digits has no length left.
    for _ in 0..f64::MANTISSA_DIGITS {
        let mut middle: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        let mut looked: FxHashMap<[u32; 2], ()> = FxHashMap::default();
        for t in &surface.triangles {
            for k in 0..3 {
                let (v, w) = (t.vertices[k], t.vertices[(k + 1) % 3]);
                let key = [v.min(w), v.max(w)];
                if looked.insert(key, ()).is_some() {
                    continue;
                }
                let ends = key.map(|v| surface.vertices[v as usize]);
                if let Some(at) = place(graph, &faces, ends) {
                    middle.insert(key, surface.vertices.len() as u32);
                    surface.vertices.push(ends[0].lerp(ends[1], at));
                }
            }
        }
        if middle.is_empty() {
            break;
        }
        let triangles = std::mem::take(&mut surface.triangles);
        for t in triangles {
            split(&t, &middle, &surface.vertices, &mut surface.triangles);
        }
    }
    surface.vertices.len() - before
}

/// Where an edge has to be divided, as a share of the way along it.
fn place(graph: &Graph, faces: &[&Face], [p, q]: [DVec3; 2]) -> Option<f64> {
    let at = |s: f64| p.lerp(q, s);
    let [a, b] = [p, q].map(|p| graph.straighten(p));
    let off = samples().map(|s| graph.straighten(at(s)).distance(a.lerp(b, s)));
    let off = off.fold(0.0, f64::max);
    if off <= STRAIGHT * p.distance(q) {
        return None;
    }
    let near = |face: &&Face| {
        let (x, y) = (face.distance(a), face.distance(b));
        x.signum() != y.signum() || x.abs().min(y.abs()) <= 2.0 * off
    };
    if !faces.iter().any(near) {
        return None;
    }
    // Where the graph has a crease, the edge is divided just there.
    Some(graph.crease(at).unwrap_or(0.5))
}

/// The parts of a triangle some of whose edges have a point between their ends.
fn split(
    t: &Triangle,
    middle: &FxHashMap<[u32; 2], u32>,
    vertices: &[DVec3],
    parts: &mut Vec<Triangle>,
) {
    let of = |v: u32, w: u32| middle.get(&[v.min(w), v.max(w)]).copied();
    let [a, b, c] = t.vertices;
    let mut push = |vertices: [u32; 3]| parts.push(Triangle { vertices, ..*t });
    let apart = |v: u32, w: u32| vertices[v as usize].distance(vertices[w as usize]);
    // The shorter of the two lines that divide a quadrangle.
    let quad = |p: u32, q: u32, r: u32, s: u32| match apart(p, r) <= apart(q, s) {
        true => [[p, q, r], [p, r, s]],
        false => [[p, q, s], [q, r, s]],
    };
    match [of(a, b), of(b, c), of(c, a)] {
        [None, None, None] => push([a, b, c]),
        [Some(x), Some(y), Some(z)] => {
            [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
                .into_iter()
                .for_each(push);
        }
        points => {
            // Turned so that the first edge is divided and the last one is not.
            let first = (0..3).find(|&i| points[i].is_some() && points[(i + 2) % 3].is_none());
            let i = first.unwrap_or(0);
            let [a, b, c] = [0, 1, 2].map(|k| t.vertices[(i + k) % 3]);
            match (points[i], points[(i + 1) % 3]) {
                (Some(x), Some(y)) => {
                    push([x, b, y]);
                    quad(a, x, y, c).into_iter().for_each(push);
                }
                (Some(x), None) => {
                    [[a, x, c], [x, b, c]].into_iter().for_each(push);
                }
                _ => push([a, b, c]),
            }
        }
    }
}
