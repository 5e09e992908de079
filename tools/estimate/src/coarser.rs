//! What becomes of edges that are drawn finer than they are asked for, where surfaces are remeshed.

use crate::wedge::Wedge;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// An edge of a wedge.
pub struct Edge {
    /// Its vertices.
    pub ends: [u32; 2],
    /// Its length, model units.
    pub length: f64,
    /// The length asked for, model units.
    pub wanted: f64,
}

/// How long edges will be at both ends of each that there is: as long as wanted where they go on as part of a curve, if chords of an arc
/// of the same curvature turn by no more than wanted then; as long as they are elsewhere. Linear.
pub fn coarser(wedge: &Wedge<'_>, edges: &[Edge], turn: f64) -> Vec<[f64; 2]> {
    let mut at: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for edge in edges {
        let [a, b] = edge.ends;
        at.entry(a).or_default().push(b);
        at.entry(b).or_default().push(a);
    }
    let normals = normals(wedge);
    let place = |v: u32| wedge.template.vertices[v as usize];
    let length = |edge: &Edge, from: u32, v: u32| {
        let ahead = place(v) - place(from);
        let others = at[&v].iter().filter(|&&w| w != from);
        let others = others.map(|&w| ahead.angle_between(place(w) - place(v)));
        // It goes on behind a cut face as its image there does.
        let faces = (0..u8::BITS).filter(|face| wedge.faces[v as usize] & 1 << face != 0);
        let behind = faces.map(|face| {
            let normal = normals[face as usize];
            ahead.angle_between(2.0 * ahead.dot(normal) * normal - ahead)
        });
        let least = others.chain(behind).fold(f64::INFINITY, f64::min);
        match least <= turn {
            true => (edge.length * turn / least)
                .min(edge.wanted)
                .max(edge.length),
            false => edge.length,
        }
    };
    edges
        .iter()
        .map(|edge| {
            let [a, b] = edge.ends;
            [length(edge, b, a), length(edge, a, b)]
        })
        .collect()
}

/// Unit normals of the planes of the cut faces.
fn normals(wedge: &Wedge<'_>) -> [DVec3; u8::BITS as usize] {
    let mut sums = [DVec3::ZERO; u8::BITS as usize];
    for t in (0..wedge.is_cut.len() as u32).filter(|&t| wedge.is_cut[t as usize]) {
        let vertices = wedge.template.triangles[t as usize].vertices;
        let faces = vertices.map(|v| wedge.faces[v as usize]);
        let faces = faces.into_iter().fold(u8::MAX, |x, y| x & y);
        let [a, b, c] = wedge.corners(t);
        let vector = geom::measure::double_area_vector(a, b, c);
        for (face, sum) in sums.iter_mut().enumerate() {
            if faces & 1 << face != 0 {
                // Both sides of a wall may be there, or have material behind it.
                *sum += vector * if vector.dot(*sum) < 0.0 { -1.0 } else { 1.0 };
            }
        }
    }
    sums.map(DVec3::normalize_or_zero)
}
