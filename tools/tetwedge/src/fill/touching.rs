//! Edges and points where a body touches a wall.

use glam::DVec3;
use tmesh::Template;

/// Edges of the surface that lie on a wall or on the axis, though no triangle of the wall has them:
/// where the body only touches it.
pub fn touching_edges(template: &Template, vertices: &[u32], triangles: &[u32]) -> Vec<[u32; 2]> {
    let mut on = vec![false; template.vertices.len()];
    for &v in vertices {
        on[v as usize] = true;
    }
    let mut covered: Vec<[u32; 2]> = triangles
        .iter()
        .flat_map(|&t| edges_of(template.triangles[t as usize].vertices))
        .collect();
    covered.sort_unstable();
    let mut found: Vec<[u32; 2]> = template
        .triangles
        .iter()
        .flat_map(|t| edges_of(t.vertices))
        .filter(|e| on[e[0] as usize] && on[e[1] as usize] && covered.binary_search(e).is_err())
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

fn edges_of([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
}

/// Whether a point lies on one of the segments, within `tolerance` (model units).
pub fn on_segments(p: DVec3, segments: &[[DVec3; 2]], tolerance: f64) -> bool {
    segments.iter().any(|&[a, b]| {
        let along = b - a;
        let t = (p - a).dot(along) / along.length_squared();
        t > 0.0 && t < 1.0 && (a + along * t - p).length() <= tolerance
    })
}
