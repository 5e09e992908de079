//! Where flat faces meet.

use crate::input::Rules;
use crate::mesh::Mesh;
use glam::DVec3;

/// The point on the flat faces among some patches, and on what a vertex is bound to, that is nearest to the middle of some vertices, if it is within
/// the deviation of all of these. `None` where the vertex is in all of the faces already, and where they have no point in common.
///
/// Faces in planes that are the same but for rounding count once: what is made of a point that is not in all of them does not fit.
pub fn meeting(
    mesh: &Mesh<'_>,
    v: u32,
    near: &[u32],
    patches: impl Iterator<Item = u32>,
) -> Option<DVec3> {
    let mut faces: Vec<u32> = patches
        .filter(|&f| mesh.planes[f as usize].is_some())
        .collect();
    faces.sort_unstable();
    faces.dedup();
    let own = mesh.points[v as usize];
    let planes = faces
        .iter()
        .filter_map(|&f| Some((mesh.planes[f as usize]?, mesh.off[f as usize])));
    let is_off = planes.clone().any(|(plane, off)| plane.off([own; 3]) > off);
    if !is_off {
        return None;
    }
    let places = near.iter().map(|&v| mesh.points[v as usize]);
    let middle = places.clone().sum::<DVec3>() / near.len() as f64;
    let bound = mesh.bound[v as usize];
    let planes = planes.map(|(plane, _)| (plane.normal, plane.origin));
    let all = bounds(&mesh.rules, bound, middle).into_iter().chain(planes);
    let p = onto_all(middle, all);
    let most = mesh.deviation_at(near);
    let p = mesh.rules.put(bound, p)?;
    let mut places = places;
    places.all(|q| q.distance(p) <= most).then_some(p)
}

/// The point on planes that is nearest to another one, each given by a unit normal and a point: on the first ones, where there is none on all.
pub fn onto_all(p: DVec3, planes: impl IntoIterator<Item = (DVec3, DVec3)>) -> DVec3 {
    let mut p = p;
    // Directions in which it cannot move any more, upright to each other.
    let mut taken: Vec<DVec3> = Vec::new();
    for (normal, on) in planes {
        let free = taken.iter().fold(normal, |n, t| n - *t * t.dot(normal));
        let part = free.length();
        if part > f64::EPSILON.sqrt() {
            let along = free / part;
            p += along * (normal.dot(on - p) / part);
            taken.push(along);
        }
    }
    p
}

/// The planes and lines of these bits as planes near a place: of each a unit normal and a point.
pub fn bounds(rules: &Rules<'_>, bound: u32, place: DVec3) -> Vec<(DVec3, DVec3)> {
    let far = place.abs().max_element().max(rules.deviation);
    let bits = (0..u32::BITS).filter(|bit| bound & 1 << bit != 0);
    let of_bit = |bit: u32| {
        // Of a line, two of them tell all.
        DVec3::AXES.map(|axis| {
            let beside = place + axis * far;
            let on = (rules.onto)(bit, beside);
            ((beside - on).normalize_or_zero(), on)
        })
    };
    bits.flat_map(of_bit).collect()
}
