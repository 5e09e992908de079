//! Points on the folds of the input, for who moves a remeshed surface further.

use super::remeshed::Remeshed;
use crate::input::{Rules, Surface};
use crate::mesh::{NONE, Sample};
use crate::shape::{Allowance, Patches};
use geom::measure::triangle_area;
use geom::tree::Tree;

/// Points to a length of edges wanted. What is farthest from a surface are the folds that it cuts off. Between two points it could be farther
/// off by what a chord of a quarter of such an edge is, a sixteenth of what is hidden there in any case.
const POINTS: f64 = 4.0;

/// Adds to the samples of curved patches points on folds that are longer than edges are to be: remeshing itself looks at their ends and middles.
/// The surface may be as far from them as it may be there, or is. As many points to an area as a square of their distance has one: needles side by side
/// have as many folds as there are needles. n log n.
pub fn sample_folds(
    remeshed: &mut Remeshed,
    (surface, rules): (&Surface, &Rules<'_>),
    patches: &Patches,
    allowance: &Allowance,
) {
    // A tree for each patch: what is nearest among few of many triangles is found after most others.
    let mut made: Vec<Vec<u32>> = vec![Vec::new(); patches.planes.len()];
    for (t, &patch) in (0..).zip(&remeshed.patches) {
        if patch != NONE {
            made[patch as usize].push(t);
        }
    }
    let corners = |of: &Vec<u32>| Tree::new(of.iter().map(|&t| remeshed.surface.corners(t)));
    let trees: Vec<Tree> = made.iter().map(corners).collect();
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
        let length = start.distance(end);
        let areas = [s, t].map(|u| {
            let [a, b, c] = surface.corners(u.triangle);
            triangle_area(a, b, c)
        });
        // Half of the way to the next folds on both sides.
        let width = (areas[0] + areas[1]) / length;
        let apart = size / POINTS;
        let parts = (length / apart * (width / apart).min(1.0)).ceil();
        let inner = (1..).map(f64::from).take_while(|&i| i < parts);
        for point in inner.map(|i| start.lerp(end, i / parts)) {
            if let Some(near) = trees[p as usize].nearest(point, f64::INFINITY) {
                let reach = reach.max(near.distance);
                let t = made[p as usize][near.triangle as usize];
                remeshed.samples[t as usize].push(Sample { point, reach });
            }
        }
    }
}
