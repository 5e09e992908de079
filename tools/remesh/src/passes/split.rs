//! Splitting edges that are too long.

use crate::mesh::{Change, Mesh};
use crate::shape::Near;
use glam::DVec3;

/// Splits an edge near its middle, and its image as well, if that keeps to the rules.
pub fn split(mesh: &mut Mesh<'_>, [a, b]: [u32; 2]) -> bool {
    // Along an edge between vertices that are held, the body may touch another piece of it, which nobody would split.
    if mesh.held[a as usize] && mesh.held[b as usize] {
        return false;
    }
    let Some(image) = mesh.splitting([a, b]) else {
        return false;
    };
    // An image is made from what it is the image of.
    let (first, image) = match image {
        Some((link, true, original)) => (original, Some((link, [a, b]))),
        Some((link, false, image)) => ([a, b], Some((link, image))),
        None => ([a, b], None),
    };
    let Some(place) = place(mesh, first) else {
        return false;
    };
    let mut changes = vec![halved(mesh, first, place)];
    let mut new = vec![mesh.points.len() as u32 - 1];
    if let Some((link, second)) = image {
        let place = (mesh.rules.links[link].image)(place);
        changes.push(halved(mesh, second, place));
        new.push(mesh.points.len() as u32 - 1);
    }
    let change = Change::all(changes);
    match mesh.fit(&change) {
        Some(fitted) => {
            mesh.apply(&change, fitted);
            if let (Some((link, _)), &[v, w]) = (image, &new[..]) {
                mesh.images.add(link, [v, w]);
            }
            true
        }
        None => {
            new.iter().for_each(|_| mesh.drop_last());
            false
        }
    }
}

/// Where an edge is split.
fn place(mesh: &Mesh<'_>, [a, b]: [u32; 2]) -> Option<DVec3> {
    let &first = mesh.at_edge(a, b).first()?;
    let patch = mesh.patch[first as usize];
    let middle = 0.5 * (mesh.points[a as usize] + mesh.points[b as usize]);
    let near = match mesh.curve(a, b) {
        Some(curve) => mesh.envelope.nearest(Near::Curve(curve), middle),
        None if mesh.planes[patch as usize].is_some() => Some(middle),
        None => mesh.envelope.nearest(Near::Patch(patch), middle),
    };
    let bound = mesh.bound[a as usize] & mesh.bound[b as usize];
    near.and_then(|p| mesh.rules.put(bound, p))
}

/// Adds a vertex there, and halves the triangles at the edge by it.
fn halved(mesh: &mut Mesh<'_>, [a, b]: [u32; 2], place: DVec3) -> Change {
    let at_edge = mesh.at_edge(a, b);
    let bound = mesh.bound[a as usize] & mesh.bound[b as usize];
    let size = 0.5 * (mesh.size[a as usize] + mesh.size[b as usize]);
    let first = at_edge.first().map(|&t| mesh.patch[t as usize]);
    let wanted = first.and_then(|patch| mesh.envelope.at(patch, place));
    let wanted = wanted.map_or(size, |at| at.1.min(size));
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
    if let Some(curve) = mesh.curve(a, b) {
        change.chords_gone = vec![key(a, b)];
        change.chords = vec![(key(a, new), curve), (key(b, new), curve)];
    }
    change
}
