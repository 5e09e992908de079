//! Triangles with the same three vertices.

use super::surface::Surface;
use crate::HealError;
use crate::words::place;
use geom::edges::{Edges, apex_of};
use glam::DVec3;

/// What [`merge`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Merged {
    /// Triangles dropped because the same solid has them more than once.
    pub dropped: usize,
    /// A corner of one of them.
    pub first: Option<DVec3>,
    /// Triangles that now lie between two solids.
    pub interfaces: usize,
}

/// Merges triangles with the same three vertices. Those of one solid cancel in pairs of opposite
/// orientation, and one of what remains is kept. With `across`, of those of two solids one is kept,
/// with the other solid as its partner.
///
/// # Errors
/// More than two solids at one triangle.
pub fn merge(surface: &mut Surface, edges: &Edges, across: bool) -> Result<Merged, HealError> {
    let mut candidates = candidates(surface, edges, across);
    let mut merged = Merged::default();
    if candidates.is_empty() {
        return Ok(merged);
    }
    candidates.sort_unstable();
    let mut drop = vec![false; surface.triangles.len()];
    let mut partners = Vec::new();
    for run in candidates.chunk_by(|s, t| s.corners == t.corners) {
        if run.len() == 1 {
            continue;
        }
        let mut kept = Vec::new();
        for same in run.chunk_by(|s, t| s.solid == t.solid) {
            let turn = |t: u32| is_even(surface.triangles[t as usize]);
            let balance: i64 = same
                .iter()
                .map(|c| if turn(c.triangle) { 1 } else { -1 })
                .sum();
            same.iter().for_each(|c| drop[c.triangle as usize] = true);
            if let Some(keep) = same
                .iter()
                .map(|c| c.triangle)
                .find(|&t| balance != 0 && turn(t) == (balance > 0))
            {
                drop[keep as usize] = false;
                kept.push(keep);
            }
            let dropped = same.len() - usize::from(balance != 0);
            if dropped > 0 && merged.first.is_none() {
                merged.first = Some(surface.points[run[0].corners[0] as usize]);
            }
            merged.dropped += dropped;
        }
        match kept.as_slice() {
            _ if !across => {}
            [] | [_] => {}
            &[s, t] => {
                let (first, second) = (s.min(t), s.max(t));
                drop[second as usize] = true;
                partners.push((first, surface.solid[second as usize]));
                merged.interfaces += 1;
            }
            [first, .., last] => {
                let [a, b, c] = surface.corners(*first);
                return Err(HealError::BadSurface(format!(
                    "solids overlap: {} of them, among them {} and {}, have the triangle at {}",
                    kept.len(),
                    surface.solid_name(surface.solid[*first as usize]),
                    surface.solid_name(surface.solid[*last as usize]),
                    place((a + b + c) / 3.0)
                )));
            }
        }
    }
    for (t, partner) in partners {
        surface.partner[t as usize] = partner;
    }
    if merged != Merged::default() {
        surface.retain(|t| !drop[t]);
    }
    Ok(merged)
}

/// A triangle that another may coincide with; in the order of corners, solids and triangles.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Candidate {
    /// Vertex ids, increasing.
    corners: [u32; 3],
    solid: u32,
    triangle: u32,
}

/// Triangles with an edge that has another triangle with the same apex, of the same solid unless
/// `across`. Coincident triangles have three of those.
fn candidates(surface: &Surface, edges: &Edges, across: bool) -> Vec<Candidate> {
    let mut list = Vec::new();
    let mut fan = Vec::new();
    for edge in 0..edges.len() {
        fan.clear();
        fan.extend(edges.around(edge).iter().map(|u| {
            let (corners, solid) = (u.triangle as usize, surface.solid[u.triangle as usize]);
            let apex = apex_of(&surface.triangles[corners], u.corner);
            (apex, if across { 0 } else { solid }, u.triangle)
        }));
        fan.sort_unstable();
        let same = fan.chunk_by(|s, t| (s.0, s.1) == (t.0, t.1));
        for run in same.filter(|run| run.len() > 1) {
            list.extend(run.iter().map(|&(.., triangle)| triangle));
        }
    }
    list.sort_unstable();
    list.dedup();
    list.into_iter()
        .map(|triangle| {
            let mut corners = surface.triangles[triangle as usize];
            corners.sort_unstable();
            Candidate {
                corners,
                solid: surface.solid[triangle as usize],
                triangle,
            }
        })
        .collect()
}

/// Whether the vertex ids are an even permutation of their increasing order.
fn is_even([a, b, c]: [u32; 3]) -> bool {
    (a < b) as u8 + (b < c) as u8 + (c < a) as u8 == 2
}
