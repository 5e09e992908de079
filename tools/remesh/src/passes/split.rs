//! Splitting edges that are too long.

use super::worth::BESIDE;
use crate::mesh::{Change, Mesh, Orbit};
use crate::shape::Near;
use geom::measure::double_area_vector;
use glam::DVec3;

/// Splits an edge near its middle, and its image as well, if that keeps to the rules.
pub fn split(mesh: &mut Mesh<'_>, [a, b]: [u32; 2]) -> bool {
    // Along an edge between vertices that are held, the body may touch another piece of it, which nobody would split.
    if mesh.held[a as usize] && mesh.held[b as usize] {
        return false;
    }
    let Some(orbit) = mesh.splitting([a, b]) else {
        return false;
    };
    if orbit.edges.iter().any(|&edge| is_in_needle(mesh, edge)) {
        return false;
    }
    let links = mesh.rules.links;
    let places = places(mesh, orbit.edges[0]).into_iter();
    let mut each = places.filter_map(|p| orbit.places(p, |link, p| (links[link].image)(p)));
    each.any(|places| at(mesh, &orbit, &places))
}

/// Splits the edges of an orbit there.
fn at(mesh: &mut Mesh<'_>, orbit: &Orbit, places: &[DVec3]) -> bool {
    let new = mesh.points.len() as u32;
    let each = orbit.edges.iter().zip(places);
    let changes = each.map(|(&edge, &place)| halved(mesh, edge, place));
    let change = Change::all(changes.collect());
    let Some(fitted) = mesh.fit(&change) else {
        orbit.edges.iter().for_each(|_| mesh.drop_last());
        return false;
    };
    mesh.apply(&change, fitted);
    for &(link, ends) in &orbit.links {
        let [v, image] = ends.map(|i| new + i as u32);
        mesh.images.add(link, [v, image]);
        mesh.fixed[v as usize] |= v == image;
    }
    true
}

/// Whether the middle of an edge is much nearer to a fold that stays than edges are to be long: halving edges beside it would go on until
/// nothing is between.
fn is_in_needle(mesh: &Mesh<'_>, [a, b]: [u32; 2]) -> bool {
    let is_held = |side: [u32; 2]| side.iter().all(|&v| mesh.held[v as usize]);
    let near = BESIDE * 0.5 * (mesh.size[a as usize] + mesh.size[b as usize]);
    mesh.at_edge(a, b).iter().any(|&t| {
        let corners = mesh.triangles[t as usize];
        let [p, q, r] = corners.map(|v| mesh.points[v as usize]);
        let area = double_area_vector(p, q, r).length();
        let mut apex = corners.into_iter().filter(|&v| v != a && v != b);
        apex.any(|apex| {
            [[a, apex], [b, apex]].into_iter().any(|side| {
                let apart = 0.5 * area / mesh.length(side);
                let stays = is_held(side) || apart * mesh.fold(side) > mesh.rules.deviation;
                apart < near && stays
            })
        })
    })
}

/// Where an edge may be split, best first: where the shape is nearest to its middle, or right there. Along the edge of something
/// thin, the nearest place may be on its other side, and halves of needles would face there.
fn places(mesh: &Mesh<'_>, [a, b]: [u32; 2]) -> Vec<DVec3> {
    let Some(&first) = mesh.at_edge(a, b).first() else {
        return Vec::new();
    };
    let patch = mesh.patch[first as usize];
    let middle = 0.5 * (mesh.points[a as usize] + mesh.points[b as usize]);
    let near = match mesh.curve(a, b) {
        // What was joined may be too far from where its curve was for the patches beside it.
        Some(curve) if mesh.loose[curve as usize] => Some(middle),
        Some(curve) => mesh.envelope.nearest(Near::Curve(curve), middle),
        None if mesh.planes[patch as usize].is_some() => Some(middle),
        None => mesh.envelope.nearest(Near::Patch(patch), middle),
    };
    let bound = mesh.bound[a as usize] & mesh.bound[b as usize];
    let all = near.into_iter().chain([middle]);
    let mut places: Vec<DVec3> = all.filter_map(|p| mesh.rules.put(bound, p)).collect();
    places.dedup();
    places
}

/// Adds a vertex there, and halves the triangles at the edge by it.
fn halved(mesh: &mut Mesh<'_>, [a, b]: [u32; 2], place: DVec3) -> Change {
    let at_edge = mesh.at_edge(a, b);
    let bound = mesh.bound[a as usize] & mesh.bound[b as usize];
    let size = 0.5 * (mesh.size[a as usize] + mesh.size[b as usize]);
    let first = at_edge.first().map(|&t| mesh.patch[t as usize]);
    let wanted = first.and_then(|patch| mesh.envelope.at(patch, place));
    let wanted = wanted.map_or(size, |at| at.1.min(size));
    let wanted = wanted.min(mesh.rules.sizes.at(place));
    let near = mesh.deviation_at(&[a, b]);
    let new = mesh.add(place, (bound, wanted), near);
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
