//! Joining of corners that are nearer to each other than to any neighbour.

use super::near::near;
use super::rim::{Rim, half_box};
use crate::soup::surface::Surface;
use geom::sets::DisjointSets;
use rustc_hash::FxHashMap;

/// What corners of the rim may be joined to.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum To {
    /// Other corners of the rim.
    Rim,
    /// Any corners: those of a triangle that is there twice are not on the rim where it is closed without it.
    All,
}

/// Joins corners of the rim that are at most `most` apart, nearest ones first, to the one among those joined that most triangles have: pairs (corner,
/// the corner that it becomes). `None` if too many are near each other.
pub fn joins(surface: &Surface, rim: &Rim, to: To, most: f64) -> Option<Vec<(u32, u32)>> {
    let mut corners = rim.vertices.clone();
    let of_rim = corners.len();
    if to == To::All {
        let mut used: Vec<u32> = surface.triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        corners.extend(
            used.iter()
                .filter(|v| rim.vertices.binary_search(v).is_err()),
        );
    }
    let point = |i: u32| surface.points[corners[i as usize] as usize];
    let reach = |i: u32| rim.reach(corners[i as usize], most);
    let boxes: Vec<_> = (0..corners.len() as u32)
        .map(|i| half_box(point(i), point(i), reach(i)))
        .collect();
    let mut found = Vec::new();
    let others = of_rim as u32;
    let complete = near(
        &boxes,
        |i| i.min(others),
        |i, j| {
            let apart = point(i).distance(point(j));
            let ends = [i, j].map(|i| corners[i as usize]);
            if apart <= reach(i).min(reach(j)) && rim.may_close(&ends, apart) {
                found.push((apart, i, j));
            }
        },
    );
    if !complete {
        return None;
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut sets = DisjointSets::new(corners.len());
    for (_, i, j) in found {
        let (p, q) = (sets.find(i), sets.find(j));
        // No chains: those that stand for both sets are near each other as well.
        if p != q && point(p).distance(point(q)) <= reach(p).min(reach(q)) {
            sets.join(p, q);
        }
    }
    Some(most_used(surface, &corners, &mut sets))
}

/// The corner that those of a set become: the one that most triangles have, and of those the first.
fn most_used(surface: &Surface, corners: &[u32], sets: &mut DisjointSets) -> Vec<(u32, u32)> {
    let mut uses = vec![0_u32; surface.points.len()];
    for &v in surface.triangles.iter().flatten() {
        uses[v as usize] += 1;
    }
    let key = |v: u32| (uses[v as usize], std::cmp::Reverse(v));
    let mut kept: FxHashMap<u32, u32> = FxHashMap::default();
    for (i, &v) in (0..).zip(corners) {
        let best = kept.entry(sets.find(i)).or_insert(v);
        if key(v) > key(*best) {
            *best = v;
        }
    }
    let becomes = (0..).zip(corners).map(|(i, &v)| (v, kept[&sets.find(i)]));
    becomes.filter(|(v, w)| v != w).collect()
}
