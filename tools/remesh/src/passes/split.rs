//! Splitting edges that are too long.

use crate::mesh::{Change, Mesh};
use crate::shape::Near;

/// Splits an edge near its middle, if that keeps to the rules.
pub fn split(mesh: &mut Mesh<'_>, [a, b]: [u32; 2]) -> bool {
    // Along an edge between vertices that are held, the body may touch another piece of it, which nobody would split.
    if mesh.held[a as usize] && mesh.held[b as usize] {
        return false;
    }
    let at_edge = mesh.at_edge(a, b);
    let Some(&first) = at_edge.first() else {
        return false;
    };
    let curve = mesh.curve(a, b);
    let patch = mesh.patch[first as usize];
    let middle = 0.5 * (mesh.points[a as usize] + mesh.points[b as usize]);
    let near = match curve {
        Some(curve) => mesh.envelope.nearest(Near::Curve(curve), middle),
        None if mesh.planes[patch as usize].is_some() => Some(middle),
        None => mesh.envelope.nearest(Near::Patch(patch), middle),
    };
    let bound = mesh.bound[a as usize] & mesh.bound[b as usize];
    let Some(place) = near.and_then(|p| mesh.rules.put(bound, p)) else {
        return false;
    };
    let size = 0.5 * (mesh.size[a as usize] + mesh.size[b as usize]);
    let wanted = mesh
        .envelope
        .at(patch, place)
        .map_or(size, |at| at.1.min(size));
    let new = mesh.add(place, bound, wanted);
    let halves = at_edge.iter().flat_map(|&t| {
        let corners = mesh.triangles[t as usize];
        let half = |from: u32| {
            (
                corners.map(|v| if v == from { new } else { v }),
                mesh.patch[t as usize],
            )
        };
        [half(a), half(b)]
    });
    let key = |a: u32, b: u32| [a.min(b), a.max(b)];
    let mut change = Change {
        new: halves.collect(),
        gone: at_edge.clone(),
        ..Change::default()
    };
    if let Some(curve) = curve {
        change.chords_gone = vec![key(a, b)];
        change.chords = vec![(key(a, new), curve), (key(b, new), curve)];
    }
    match mesh.fit(&change) {
        Some(fitted) => {
            mesh.apply(&change, fitted);
            true
        }
        None => {
            mesh.drop_last();
            false
        }
    }
}
