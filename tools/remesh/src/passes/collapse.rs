//! Collapsing edges that are too short.

use super::meet::meeting;
use super::worth::{DETAIL, GOOD, LONG};
use crate::mesh::{Change, Mesh};
use crate::shape::UPRIGHT;
use geom::measure::double_area_vector;
use glam::DVec3;

/// Collapses an edge into its second end, or to where flat faces meet beside it, if that keeps to the rules and leaves no worse triangles. What is
/// `spare` goes even if others get longer than is wanted by it.
pub fn collapse(mesh: &mut Mesh<'_>, [from, to]: [u32; 2], spare: bool) -> bool {
    let Some(orbit) = mesh.collapsing([from, to]) else {
        return false;
    };
    let changes: Option<Vec<Change>> = orbit.iter().map(|&edge| change(mesh, edge)).collect();
    let change = changes.map(Change::all);
    let Some(change) = change.filter(|change| !has_twins(change)) else {
        return false;
    };
    let joined = match (change.joins, &orbit[..]) {
        (true, &[edge]) => where_faces_meet(mesh, edge, &change),
        _ => None,
    };
    take(mesh, &orbit, change, spare)
        || joined.is_some_and(|change| take(mesh, &orbit, change, spare))
}

/// Collapses edges, if what that changes keeps to the rules and leaves no worse triangles.
fn take(mesh: &mut Mesh<'_>, orbit: &[[u32; 2]], change: Change, spare: bool) -> bool {
    let before = change.gone.iter().map(|&t| {
        let (corners, patch) = (mesh.triangles[t as usize], mesh.patch[t as usize]);
        quality_of(mesh, (corners, patch), change.joins) * size_of(mesh, corners)
    });
    let before = before.fold(1.0, f64::min);
    let mut change = change;
    // So far, the change has the place that a vertex is to be moved to; from here on, the one that it was at.
    let swap = |mesh: &mut Mesh<'_>, change: &mut Change| {
        if let Some((v, place)) = &mut change.moved {
            std::mem::swap(&mut mesh.points[*v as usize], place);
        }
    };
    swap(mesh, &mut change);
    // What joining faces where they meet is worth is told when all of it is done.
    let is_worth_it = change.moved.is_some() || is_worth_it(mesh, orbit, &change, (before, spare));
    let fitted = match is_worth_it {
        true => mesh.fit(&change),
        false => None,
    };
    let Some(fitted) = fitted else {
        swap(mesh, &mut change);
        return false;
    };
    mesh.apply(&change, fitted);
    for &[from, to] in orbit {
        mesh.images.drop(from);
        // Where curves were joined, they end, unless only one goes on.
        mesh.fixed[to as usize] |= change.joins && !mesh.is_passed(to);
        mesh.keep_near(to, &[from]);
    }
    true
}

/// Whether what is there after a change is no worse than before.
fn is_worth_it(
    mesh: &Mesh<'_>,
    orbit: &[[u32; 2]],
    change: &Change,
    (before, spare): (f64, bool),
) -> bool {
    let after = (change.new.iter()).map(|&new| quality_of(mesh, new, change.joins));
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
    true
}

/// What joining two vertices does with the second one moved to where the flat faces around both meet, if they do so near enough. It has the place that the
/// vertex is to be moved to in place of the one that it was at.
fn where_faces_meet(mesh: &Mesh<'_>, [from, to]: [u32; 2], joined: &Change) -> Option<Change> {
    if mesh.held[to as usize] || mesh.images.has(to) {
        return None;
    }
    let mut change = joined.clone();
    let around = mesh.around(to).iter();
    for &t in around.filter(|t| !joined.gone.contains(t)) {
        change.gone.push(t);
        let kept = (mesh.triangles[t as usize], mesh.patch[t as usize]);
        change.new.push(kept);
    }
    let place = meeting(mesh, to, &[from, to], change.new.iter().map(|n| n.1))?;
    for (w, curve) in mesh.along(to) {
        let key = [to.min(w), to.max(w)];
        if w != from && !change.chords.iter().any(|chord| chord.0 == key) {
            change.chords_gone.push(key);
            change.chords.push((key, curve));
        }
    }
    change.moved = Some((to, place));
    Some(change)
}

/// Whether two of the new triangles have the same corners: images of each other that are collapsed into the same vertex.
fn has_twins(change: &Change) -> bool {
    let sorted = |n: &([u32; 3], u32)| {
        let mut corners = n.0;
        corners.sort_unstable();
        corners
    };
    let mut all: Vec<[u32; 3]> = change.new.iter().map(sorted).collect();
    all.sort_unstable();
    all.windows(2).any(|w| w[0] == w[1])
}

/// Quality of a triangle, from 0 to 1. Where curves are joined, needles in flat faces count, too.
fn quality_of(mesh: &Mesh<'_>, (corners, patch): ([u32; 3], u32), joins: bool) -> f64 {
    match joins {
        true => mesh.shape_of(corners),
        false => mesh.quality_of(corners, patch),
    }
}

/// How much of a triangle counts: all of it, or as much as it is larger than detail. However good, what is far smaller than
/// the edges wanted has to go, by way of needles, which are flipped then.
fn size_of(mesh: &Mesh<'_>, [a, b, c]: [u32; 3]) -> f64 {
    let sides = [[a, b], [b, c], [c, a]].map(|side| mesh.relative(side));
    (sides.into_iter().fold(0.0, f64::max) / DETAIL).min(1.0)
}

/// What collapsing an edge does, if it keeps the topology.
fn change(mesh: &Mesh<'_>, [from, to]: [u32; 2]) -> Option<Change> {
    let [x, y] = [from, to].map(|v| mesh.bound[v as usize]);
    if mesh.held[from as usize] || mesh.images.is_fixed(from) || x & y != x {
        return None;
    }
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
    let along = mesh.along(from);
    let key = |a: u32, b: u32| [a.min(b), a.max(b)];
    // Where the next vertex of the curve is a neighbour already, it is so across the one triangle that goes on that side of the curve.
    let may_follow = |next: u32| {
        of_to.binary_search(&next).is_err()
            || mesh.curve(to, next).is_none()
                && apexes.iter().filter(|&&apex| apex == next).count() == 1
    };
    match along[..] {
        [] if !mesh.fixed[from as usize] => {}
        [(v, curve), (w, other)]
            if !mesh.fixed[from as usize]
                && curve == other
                && (v == to || w == to)
                && may_follow(v + w - to) =>
        {
            let next = v + w - to;
            change.chords_gone = vec![key(from, to), key(from, next)];
            change.chords = vec![(key(to, next), curve)];
        }
        _ => join(mesh, [from, to], &mut change)?,
    }
    Some(change)
}

/// Takes the curves of the first vertex to the second one, where both are detail: nearer together than the deviation, and
/// than what edges are to be.
fn join(mesh: &Mesh<'_>, [from, to]: [u32; 2], change: &mut Change) -> Option<()> {
    let is_detail =
        mesh.length([from, to]) <= mesh.rules.deviation && mesh.relative([from, to]) < DETAIL;
    if !mesh.joins || !is_detail || opposite(mesh, [from, to]) {
        return None;
    }
    let key = |a: u32, b: u32| [a.min(b), a.max(b)];
    change.joins = true;
    for (w, curve) in mesh.along(from) {
        change.chords_gone.push(key(from, w));
        if w == to {
            continue;
        }
        // Two curves become one where a triangle between them goes.
        let there = mesh.curve(to, w);
        if there.is_some() {
            change.chords_gone.push(key(to, w));
        }
        change.chords.push((key(to, w), there.unwrap_or(curve)));
    }
    Some(())
}

/// Whether sides of something thin would meet: whether triangles around one vertex face away from those around the
/// other. Triangles that are detail themselves face anywhere, and those in walls and glued faces are no sides: the surface meets
/// them in any angle, and nothing comes to lie in them.
fn opposite(mesh: &Mesh<'_>, [from, to]: [u32; 2]) -> bool {
    let faces = |v: u32, other: u32| -> Vec<DVec3> {
        let around = mesh.around(v).iter();
        let of_shape = around.filter(|&&t| !mesh.is_cut(mesh.patch[t as usize]));
        let corners = of_shape.map(|&t| mesh.triangles[t as usize]);
        let apart = corners.filter(|corners| !corners.contains(&other));
        let vectors = apart.map(|corners| {
            let [a, b, c] = corners.map(|v| mesh.points[v as usize]);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            (double_area_vector(a, b, c), longest)
        });
        let wide =
            vectors.filter(|(vector, longest)| vector.length() > mesh.rules.deviation * longest);
        wide.map(|(vector, _)| vector.normalize_or_zero()).collect()
    };
    let (here, there) = (faces(from, to), faces(to, from));
    here.iter()
        .any(|m| there.iter().any(|n| m.dot(*n) < -UPRIGHT))
}
