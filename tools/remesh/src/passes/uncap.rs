//! Taking out needles between features.

use super::meet::meeting;
use super::worth::{BESIDE, DETAIL};
use crate::mesh::{Change, Mesh};
use geom::measure::double_area_vector;
use glam::DVec3;

/// Takes out a triangle that is detail, a vertex beside the middle of a feature edge: the edge is led by way of the vertex, or the vertex
/// is moved onto the edge, or to where flat faces beside both meet. Not where faces would meet at less than the triangle's own corners, as on both
/// sides of something thin.
pub fn uncap(mesh: &mut Mesh<'_>, t: u32) -> bool {
    let Some(cap) = cap(mesh, t) else {
        return false;
    };
    let is_done = [Way::Led, Way::OntoEdge, Way::Meeting]
        .into_iter()
        .any(|way| take(mesh, t, &cap, way));
    if is_done {
        let [a, b, c] = cap.corners;
        [a, b, c]
            .iter()
            .for_each(|&v| mesh.fixed[v as usize] |= !mesh.is_passed(v));
    }
    is_done
}

/// A triangle beside the middle of a feature edge.
struct Cap {
    /// The ends of the edge, and the vertex beside it.
    corners: [u32; 3],
    /// How far that is from the edge.
    height: f64,
    /// The curve that the edge is of.
    curve: u32,
}

/// How a triangle is taken out.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// The edge is led by way of the vertex.
    Led,
    /// The vertex is moved onto the edge.
    OntoEdge,
    /// The vertex is moved to where flat faces meet.
    Meeting,
}

/// Takes out a triangle.
fn take(mesh: &mut Mesh<'_>, t: u32, cap: &Cap, way: Way) -> bool {
    let [_, _, c] = cap.corners;
    let old = mesh.points[c as usize];
    let place = match way {
        Way::Led => old,
        _ if mesh.held[c as usize] || mesh.images.has(c) => return false,
        Way::OntoEdge => match on_edge(mesh, cap) {
            Some(place) => place,
            None => return false,
        },
        Way::Meeting => match where_faces_meet(mesh, t, cap) {
            Some(place) => place,
            None => return false,
        },
    };
    mesh.points[c as usize] = place;
    let moves = way != Way::Led;
    let change = change(mesh, t, cap, moves.then_some(old));
    let change = change.filter(|change| !moves || !narrows(mesh, change));
    let fitted = change.and_then(|change| Some((mesh.fit(&change)?, change)));
    match fitted {
        Some((fitted, change)) => {
            mesh.apply(&change, fitted);
            true
        }
        None => {
            mesh.points[c as usize] = old;
            false
        }
    }
}

/// The place of the vertex on the edge, if that is near enough: what is wider is divided until it is as wide as long.
fn on_edge(mesh: &Mesh<'_>, cap: &Cap) -> Option<DVec3> {
    let [a, b, c] = cap.corners;
    let [x, y, z] = cap.corners.map(|v| mesh.bound[v as usize]);
    let [p, q, r] = [a, b, c].map(|v| mesh.points[v as usize]);
    let along = q - p;
    let on_edge = p + along * ((r - p).dot(along) / along.length_squared());
    let is_narrow = cap.height < BESIDE * mesh.size[c as usize];
    let may_move = is_narrow && z == x & y;
    mesh.rules.put(z, on_edge).filter(|_| may_move)
}

/// Where the flat faces around the vertex and beyond the edge meet, within the deviation.
fn where_faces_meet(mesh: &Mesh<'_>, t: u32, cap: &Cap) -> Option<DVec3> {
    let [a, b, c] = cap.corners;
    let mut around = mesh.at_edge(a, b);
    around.extend(mesh.around(c));
    let others = around.into_iter().filter(|&u| u != t);
    let patches = others.map(|u| mesh.patch[u as usize]);
    meeting(mesh, c, &[c], patches)
}

/// Whether a triangle of what is curved gets narrower than all that there were: then needles beside the one that goes would be taken
/// for ever narrower ones.
fn narrows(mesh: &Mesh<'_>, change: &Change) -> bool {
    let is_curved = |patch: u32| mesh.planes[patch as usize].is_none();
    let height = |corners: [u32; 3], at: &dyn Fn(u32) -> DVec3| {
        let [a, b, c] = corners.map(at);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        double_area_vector(a, b, c).length() / longest
    };
    let is = |v: u32| mesh.points[v as usize];
    let was = |v: u32| mesh.before(change, v);
    let new = change.new.iter().filter(|n| is_curved(n.1));
    let gone = change.gone.iter().map(|&t| t as usize);
    let gone = gone.filter(|&t| is_curved(mesh.patch[t]));
    let after = new.map(|n| height(n.0, &is)).fold(f64::INFINITY, f64::min);
    let before = gone.map(|t| height(mesh.triangles[t], &was));
    after < before.fold(f64::INFINITY, f64::min)
}

/// A triangle of which the corner opposite to the longest side, a feature, is above the inside of it, and near it.
fn cap(mesh: &Mesh<'_>, t: u32) -> Option<Cap> {
    if !mesh.joins || !mesh.is_there(t) {
        return None;
    }
    let corners = mesh.triangles[t as usize];
    let turned = (0..3).map(|i| [0, 1, 2].map(|k| corners[(i + k) % 3]));
    let length = |&[a, b, _]: &[u32; 3]| mesh.length([a, b]);
    let [a, b, c] = turned.max_by(|x, y| length(x).total_cmp(&length(y)))?;
    let [p, q, r] = [a, b, c].map(|v| mesh.points[v as usize]);
    let height = double_area_vector(p, q, r).length() / p.distance(q);
    let reach = [p.distance(r), q.distance(r)];
    // At least as far from both ends as from the side: between 45 degrees from either.
    let is_inside = reach
        .into_iter()
        .all(|r| r > std::f64::consts::SQRT_2 * height);
    let size = mesh.size[c as usize];
    let is_detail = height <= mesh.rules.deviation && height <= DETAIL * size;
    let curve = mesh.curve(a, b)?;
    let [x, y, z] = [a, b, c].map(|v| mesh.bound[v as usize]);
    let stays = mesh.held[a as usize] && mesh.held[b as usize];
    let is_image = [a, b].iter().all(|&v| mesh.images.has(v));
    let may_go = is_inside && is_detail && !stays && !is_image && x & y & z == x & y;
    may_go.then_some(Cap {
        corners: [a, b, c],
        height,
        curve,
    })
}

/// What taking out a triangle does, whose vertex was at a place, if it is moved.
fn change(mesh: &Mesh<'_>, t: u32, cap: &Cap, moved: Option<DVec3>) -> Option<Change> {
    let [a, b, c] = cap.corners;
    let mut change = Change {
        joins: true,
        chords_gone: vec![[a.min(b), a.max(b)]],
        gone: mesh.at_edge(a, b),
        moved: moved.map(|place| (c, place)),
        ..Change::default()
    };
    for &u in change.gone.iter().filter(|&&u| u != t) {
        let corners = mesh.triangles[u as usize];
        let apex = corners.into_iter().find(|&v| v != a && v != b)?;
        if apex == c || mesh.neighbours(c).binary_search(&apex).is_ok() {
            return None;
        }
        for end in [a, b] {
            let half = corners.map(|v| if v == end { c } else { v });
            change.new.push((half, mesh.patch[u as usize]));
        }
    }
    for end in [a, b] {
        let key = [end.min(c), end.max(c)];
        let there = mesh.curve(end, c);
        if there.is_some() {
            change.chords_gone.push(key);
        }
        change.chords.push((key, there.unwrap_or(cap.curve)));
    }
    if moved.is_some() {
        // All around it is as new.
        let around = mesh.around(c).iter().filter(|&&u| u != t);
        for &u in around {
            change.gone.push(u);
            let kept = (mesh.triangles[u as usize], mesh.patch[u as usize]);
            change.new.push(kept);
        }
        for (w, curve) in mesh
            .along(c)
            .into_iter()
            .filter(|(w, _)| ![a, b].contains(w))
        {
            let key = [w.min(c), w.max(c)];
            change.chords_gone.push(key);
            change.chords.push((key, curve));
        }
    }
    let corner = cap.height / mesh.length([a, c]).max(mesh.length([b, c]));
    opens(mesh, &change, [a, b, c], corner).then_some(change)
}

/// Whether faces meet at the new sides at more than an angle, radians.
fn opens(mesh: &Mesh<'_>, change: &Change, [a, b, c]: [u32; 3], angle: f64) -> bool {
    [a, b].into_iter().all(|end| {
        let [p, q] = [end, c].map(|v| mesh.points[v as usize]);
        let along = (q - p).normalize_or_zero();
        let there = mesh.at_edge(end, c).into_iter();
        let there = there.filter(|u| !change.gone.contains(u));
        let there = there.map(|u| mesh.triangles[u as usize]);
        let new = change.new.iter().map(|n| n.0);
        let new = new.filter(|corners| corners.contains(&end) && corners.contains(&c));
        let sides: Vec<DVec3> = (there.chain(new))
            .flat_map(|corners| corners.into_iter().filter(|&v| v != end && v != c))
            .map(|v| mesh.points[v as usize] - p)
            .map(|side| side - along * side.dot(along))
            .collect();
        let all = sides.iter().enumerate();
        let mut pairs = all.flat_map(|(i, m)| sides[..i].iter().map(move |n| (m, n)));
        pairs.all(|(m, n)| m.angle_between(*n) > angle)
    })
}
