//! Splitting of segments at nodes that lie on them, so that facets fit together.

use geom::tree::{Search, pairs};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// For segments on which other segments' nodes lie, to within `tolerance`: the chain of nodes they
/// become, from the lower to the higher node id. `None` when far too many segments and nodes are
/// close to each other.
pub fn split_segments(
    points: &[DVec3],
    segments: &[Vec<[u32; 2]>],
    tolerance: f64,
) -> Option<FxHashMap<[u32; 2], Vec<u32>>> {
    let mut all: Vec<[u32; 2]> = segments.iter().flatten().copied().collect();
    all.sort_unstable();
    all.dedup();
    let mut nodes: Vec<u32> = all.iter().flatten().copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    // Boxes of nodes, grown by the tolerance, against boxes of segments.
    let of_segments = all.iter().map(|ends| {
        let [p, q] = ends.map(|v| points[v as usize]);
        [p.min(q), p.max(q)]
    });
    let of_nodes = nodes.iter().map(|&v| {
        let p = points[v as usize];
        [p - tolerance, p + tolerance]
    });
    let count = all.len() as u32;
    let group = |t: u32| u32::from(t < count);
    let mut on: FxHashMap<u32, Vec<(f64, u32)>> = FxHashMap::default();
    let search = pairs(of_segments.chain(of_nodes), group, |s, t| {
        let (segment, node) = (s.min(t), nodes[(s.max(t) - count) as usize]);
        let [a, b] = all[segment as usize];
        if node != a && node != b {
            let (p, q) = (points[a as usize], points[b as usize]);
            let (along, off) = (q - p, points[node as usize] - p);
            let f = off.dot(along) / along.length_squared();
            if f > 0.0 && f < 1.0 && (off - along * f).length() <= tolerance {
                on.entry(segment).or_default().push((f, node));
            }
        }
        true
    });
    if search == Search::GaveUp {
        return None;
    }
    let chains = on.into_iter().map(|(segment, mut inner)| {
        inner.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        let [a, b] = all[segment as usize];
        let chain = std::iter::once(a)
            .chain(inner.into_iter().map(|(_, v)| v))
            .chain([b]);
        ([a, b], chain.collect())
    });
    Some(chains.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_on_a_segment_split_it_in_order() {
        let points: Vec<DVec3> = [0.0, 3.0, 2.0, 1.0, 1.5]
            .iter()
            .map(|&x| DVec3::new(x, 2.0 * x, if x == 1.5 { 0.1 } else { 0.0 }))
            .collect();
        let segments = [vec![[0, 1]], vec![[2, 3], [3, 4]]];
        let chains = split_segments(&points, &segments, 1e-9).unwrap();
        assert_eq!(chains.len(), 1);
        assert_eq!(chains[&[0, 1]], [0, 3, 2, 1]);
    }
}
