//! Nodes and segments of a complex that bound no facet.

use crate::words::place;
use glam::DVec3;
use interchange::text::counted;
use rustc_hash::FxHashSet;

/// Says which nodes and segments are not in any triangle of the facets, and so are neither in the surface nor among the
/// vertices and edges of a mesh that is made of it: electrodes, sources and the like. Segments have the lower node first.
pub fn notices(
    points: &[DVec3],
    segments: impl Iterator<Item = [u32; 2]>,
    triangles: &[[u32; 3]],
) -> Vec<String> {
    let mut is_used = vec![false; points.len()];
    triangles
        .iter()
        .flatten()
        .for_each(|&v| is_used[v as usize] = true);
    let sides = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: FxHashSet<[u32; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    let mut loose: Vec<[u32; 2]> = segments.filter(|s| !edges.contains(s)).collect();
    loose.sort_unstable();
    loose.dedup();
    for v in loose.iter().flatten() {
        is_used[*v as usize] = true;
    }
    let at = |v: usize| place(points[v]);
    let alone = || (0..points.len()).filter(|&v| !is_used[v]);
    let nodes = alone().next().map(|first| {
        let count = counted(alone().count(), "node", "nodes");
        format!(
            "{count} of no facet with an area, the first at {}: not in the mesh",
            at(first)
        )
    });
    let lines = loose.first().map(|&[a, b]| {
        let count = counted(loose.len(), "segment", "segments");
        let [a, b] = [a, b].map(|v| at(v as usize));
        format!("{count} of no facet with an area, the first from {a} to {b}: not in the mesh")
    });
    nodes.into_iter().chain(lines).collect()
}
