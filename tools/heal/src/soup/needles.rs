//! Triangles without area whose corners differ: needles and caps.

use super::surface::Surface;
use geom::edges::Edges;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Removes triangles that are no higher than `rounding` above their longest edge. Returns how many
/// there were and are no more, and a corner of the first; `None` when the surface is as it was.
///
/// A needle's short edge is contracted. A cap's longest edge, which its apex lies on, is turned: the
/// triangle beyond the edge is divided at the apex. Nothing moves by more than `rounding`. Those
/// that cannot be removed without spoiling the surface are left. Linear.
pub fn remove(surface: &mut Surface, rounding: f64) -> Option<(usize, DVec3)> {
    let flat = flat_ones(surface, rounding);
    let first = surface.corners(flat.first()?.0)[0];
    let before = flat.len();
    let mut changed = contract_needles(surface, rounding);
    let mut left = flat_ones(surface, rounding).len();
    // Caps that lean on each other take a round each. Where coordinates are hardly known, turning may leave
    // as many as it removes.
    while left > 0 && turn_caps(surface, rounding) > 0 {
        changed = true;
        let now = flat_ones(surface, rounding).len();
        if now >= left {
            break;
        }
        left = now;
    }
    changed.then(|| (before.saturating_sub(left), first))
}

/// Triangles lower than `rounding`, each with its corner opposite to the longest edge.
fn flat_ones(surface: &Surface, rounding: f64) -> Vec<(u32, usize)> {
    (0..surface.triangles.len() as u32)
        .filter_map(|t| {
            let p = surface.corners(t);
            let length = |i: usize| (p[(i + 2) % 3] - p[(i + 1) % 3]).length();
            let apex = (1..3).fold(0, |best, i| if length(i) > length(best) { i } else { best });
            let area = (p[1] - p[0]).cross(p[2] - p[0]).length();
            (area <= rounding * length(apex)).then_some((t, apex))
        })
        .collect()
}

/// Contracts short edges of needles; whether there were any.
fn contract_needles(surface: &mut Surface, rounding: f64) -> bool {
    let mut new_id: FxHashMap<u32, u32> = FxHashMap::default();
    let mut kept: FxHashSet<u32> = FxHashSet::default();
    for (t, _) in flat_ones(surface, rounding) {
        let corners = surface.triangles[t as usize];
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let apart = (surface.points[a as usize] - surface.points[b as usize]).length();
            // No chains: a point that others were joined to stays where it is.
            if apart <= rounding
                && ![a, b].iter().any(|v| new_id.contains_key(v))
                && ![a, b].iter().any(|v| kept.contains(v))
            {
                new_id.insert(a.max(b), a.min(b));
                kept.insert(a.min(b));
            }
        }
    }
    if new_id.is_empty() {
        return false;
    }
    for t in &mut surface.triangles {
        *t = t.map(|v| new_id.get(&v).copied().unwrap_or(v));
    }
    surface.drop_collapsed();
    true
}

/// Turns the longest edges of caps; returns of how many.
fn turn_caps(surface: &mut Surface, rounding: f64) -> usize {
    let flat = flat_ones(surface, rounding);
    if flat.is_empty() {
        return 0;
    }
    let edges = Edges::new(&surface.triangles);
    let mut known: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    for (e, ends) in edges.ends.iter().enumerate() {
        known.insert(*ends, e);
    }
    let key = |a: u32, b: u32| [a.min(b), a.max(b)];
    let is_flat: FxHashSet<u32> = flat.iter().map(|f| f.0).collect();
    // Triangles and edges changed in this round: their fans are out of date.
    let mut touched: FxHashSet<u32> = FxHashSet::default();
    let mut made: FxHashSet<[u32; 2]> = FxHashSet::default();
    let mut turned = 0;
    for &(t, apex) in &flat {
        let corners = surface.triangles[t as usize];
        let (c, a, b) = (
            corners[apex],
            corners[(apex + 1) % 3],
            corners[(apex + 2) % 3],
        );
        let Some(&edge) = known.get(&key(a, b)) else {
            continue;
        };
        let [u, v] = edges.around(edge) else { continue };
        let s = if u.triangle == t {
            v.triangle
        } else {
            u.triangle
        };
        let beyond = surface.triangles[s as usize];
        let Some(&d) = beyond.iter().find(|x| **x != a && **x != b) else {
            continue;
        };
        let new = key(c, d);
        // A flat triangle beyond goes first, by the edge that it has with a proper one.
        if is_flat.contains(&s)
            || touched.contains(&s)
            || touched.contains(&t)
            || c == d
            || known.contains_key(&new)
            || !made.insert(new)
        {
            continue;
        }
        touched.extend([s, t]);
        surface.triangles[s as usize] = beyond.map(|x| if x == b { c } else { x });
        surface.triangles[t as usize] = beyond.map(|x| if x == a { c } else { x });
        surface.group[t as usize] = surface.group[s as usize];
        surface.solid[t as usize] = surface.solid[s as usize];
        surface.partner[t as usize] = surface.partner[s as usize];
        turned += 1;
    }
    turned
}
