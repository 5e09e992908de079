//! Taking out needles between features.

use super::worth::DETAIL;
use crate::mesh::{Change, Mesh};
use geom::measure::double_area_vector;
use glam::DVec3;

/// Takes out a triangle that is detail, a vertex beside the middle of a feature edge: the edge is led by way of the vertex. Not
/// where faces would meet at less than the triangle's own corners, as on both sides of something thin.
pub fn uncap(mesh: &mut Mesh<'_>, t: u32) -> bool {
    let Some(change) = change(mesh, t) else {
        return false;
    };
    let Some(fitted) = mesh.fit(&change) else {
        return false;
    };
    mesh.apply(&change, fitted);
    for &(ends, _) in &change.chords {
        ends.iter().for_each(|&v| mesh.fixed[v as usize] = true);
    }
    true
}

/// Of a triangle that is there, the ends of its longest side, the other corner, and how high that is above the side, if it
/// is above the inside of it.
fn cap(mesh: &Mesh<'_>, t: u32) -> Option<([u32; 3], f64)> {
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
    is_inside.then_some(([a, b, c], height))
}

fn change(mesh: &Mesh<'_>, t: u32) -> Option<Change> {
    if !mesh.joins || !mesh.is_there(t) {
        return None;
    }
    let ([a, b, c], height) = cap(mesh, t)?;
    let curve = mesh.curve(a, b)?;
    let size = mesh.size[c as usize];
    if height > mesh.rules.deviation || height > DETAIL * size {
        return None;
    }
    let [x, y, z] = [a, b, c].map(|v| mesh.bound[v as usize]);
    let stays = mesh.held[a as usize] && mesh.held[b as usize];
    let is_image = [a, b].iter().all(|&v| mesh.images.has(v));
    if stays || is_image || x & y & z != x & y {
        return None;
    }
    let gone = mesh.at_edge(a, b);
    let mut change = Change {
        joins: true,
        chords_gone: vec![[a.min(b), a.max(b)]],
        ..Change::default()
    };
    for &u in gone.iter().filter(|&&u| u != t) {
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
        change.chords.push((key, there.unwrap_or(curve)));
    }
    let corner = height / mesh.length([a, c]).max(mesh.length([b, c]));
    change.gone = gone;
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
