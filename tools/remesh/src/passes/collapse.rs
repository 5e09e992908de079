//! Collapsing edges that are too short.

use super::worth::{GOOD, LONG};
use crate::mesh::{Change, Mesh};

/// Collapses an edge into its second end, if that keeps to the rules and leaves no worse triangles. What is `spare` goes even if
/// others get longer than is wanted by it.
pub fn collapse(mesh: &mut Mesh<'_>, [from, to]: [u32; 2], spare: bool) -> bool {
    let Some(orbit) = mesh.collapsing([from, to]) else {
        return false;
    };
    let changes: Option<Vec<Change>> = orbit.iter().map(|&edge| change(mesh, edge)).collect();
    let Some(change) = changes.map(Change::all) else {
        return false;
    };
    let before = mesh.worst(&change.gone);
    let after = change
        .new
        .iter()
        .map(|&(t, patch)| mesh.quality_of(t, patch));
    if after.fold(1.0, f64::min) < before.min(GOOD) {
        return false;
    }
    if before >= GOOD && !spare {
        // Of good triangles none gets longer than those to be split.
        let lengthened = |&[from, to]: &[u32; 2]| {
            let longer = |&w: &u32| {
                mesh.relative([to, w]) > LONG && mesh.length([to, w]) > mesh.length([from, w])
            };
            mesh.neighbours(from).iter().any(longer)
        };
        let is_curved = |&(_, patch): &([u32; 3], u32)| mesh.planes[patch as usize].is_none();
        if change.new.iter().any(is_curved) && orbit.iter().any(lengthened) {
            return false;
        }
    }
    let Some(fitted) = mesh.fit(&change) else {
        return false;
    };
    mesh.apply(&change, fitted);
    orbit.iter().for_each(|edge| mesh.images.drop(edge[0]));
    true
}

/// What collapsing an edge does, if it keeps the topology.
fn change(mesh: &Mesh<'_>, [from, to]: [u32; 2]) -> Option<Change> {
    let [x, y] = [from, to].map(|v| mesh.bound[v as usize]);
    if mesh.fixed[from as usize] || x & y != x {
        return None;
    }
    let along = mesh.along(from);
    let onward = match along[..] {
        [] => None,
        [(v, curve), (w, other)] if curve == other && (v == to || w == to) => {
            Some((if v == to { w } else { v }, curve))
        }
        _ => return None,
    };
    let at_edge = mesh.at_edge(from, to);
    let apexes: Vec<u32> = (at_edge.iter())
        .flat_map(|&t| mesh.triangles[t as usize])
        .filter(|&v| v != from && v != to)
        .collect();
    // The link condition: only what is at the edge is joined.
    let (of_from, of_to) = (mesh.neighbours(from), mesh.neighbours(to));
    let common = of_from.iter().filter(|v| of_to.binary_search(v).is_ok());
    if common.clone().any(|v| !apexes.contains(v)) {
        return None;
    }
    let gone = mesh.around(from).to_vec();
    let mut change = Change::replacing(mesh, &gone, from, to);
    // The last triangles of something that is closed.
    if change.new.is_empty() {
        return None;
    }
    if let Some((next, curve)) = onward {
        if of_to.binary_search(&next).is_ok() {
            return None;
        }
        let key = |a: u32, b: u32| [a.min(b), a.max(b)];
        change.chords_gone = vec![key(from, to), key(from, next)];
        change.chords = vec![(key(to, next), curve)];
    }
    Some(change)
}
