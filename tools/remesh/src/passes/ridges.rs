//! Points on the folds of the input, for who moves a remeshed surface further.

use super::remesh::Remeshed;
use crate::input::{Rules, Surface};
use crate::mesh::Sample;
use crate::shape::{Allowance, Patches};
use geom::tree::Tree;

/// Points to a length of edges wanted. What is farthest from a surface are the folds that it cuts off. Between two points it could be farther
/// off by what a chord of a quarter of such an edge is, a sixteenth of what is hidden there in any case.
const POINTS: f64 = 4.0;

/// Adds to the samples of curved patches points on folds that are longer than edges are to be: remeshing itself looks at their ends and middles.
/// The surface may be as far from them as it may be there, or is. n log n.
pub fn sample_folds(
    remeshed: &mut Remeshed,
    (surface, rules): (&Surface, &Rules<'_>),
    patches: &Patches,
    allowance: &Allowance,
) {
    let made = &remeshed.surface;
    let corners = (0..made.triangles.len() as u32).map(|t| made.corners(t));
    let tree = Tree::new(corners);
    for (edge, &[a, b]) in patches.edges.ends.iter().enumerate() {
        let Some([s, t]) = patches.smooth(surface, rules, edge) else {
            continue;
        };
        let [p, q] = [s, t].map(|u| patches.of[u.triangle as usize]);
        if p != q || patches.planes[p as usize].is_some() {
            continue;
        }
        let reach = [s, t].map(|u| allowance.reach[u.triangle as usize]);
        let reach = reach[0].max(reach[1]);
        let size = allowance.size[a as usize].min(allowance.size[b as usize]);
        let [start, end] = [a, b].map(|v| surface.points[v as usize]);
        let parts = (POINTS * start.distance(end) / size).ceil();
        let inner = (1..).map(f64::from).take_while(|&i| i < parts);
        for point in inner.map(|i| start.lerp(end, i / parts)) {
            let wanted = |t: u32| remeshed.patches[t as usize] == p;
            if let Some(near) = tree.nearest_of(point, f64::INFINITY, wanted) {
                let reach = reach.max(near.distance);
                remeshed.samples[near.triangle as usize].push(Sample { point, reach });
            }
        }
    }
}
