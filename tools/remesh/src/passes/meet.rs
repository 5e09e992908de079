//! Where flat faces meet.

use crate::mesh::Mesh;
use geom::flat::Plane;
use glam::DVec3;

/// The point nearest to a place on all of some planes, and on what a vertex is bound to. `None` where they have no point in common there. Planes
/// that are the same but for rounding count once: where they do not meet, what is made of the point does not fit.
pub fn meeting(
    mesh: &Mesh<'_>,
    v: u32,
    place: DVec3,
    planes: impl Iterator<Item = Plane>,
) -> Option<DVec3> {
    let bound = mesh.bound[v as usize];
    let faces = planes.map(|plane| (plane.normal, plane.origin));
    let mut p = place;
    // Directions in which it cannot move any more, upright to each other.
    let mut taken: Vec<DVec3> = Vec::new();
    for (normal, on) in bounds(mesh, bound, place).into_iter().chain(faces) {
        let free = taken.iter().fold(normal, |n, t| n - *t * t.dot(normal));
        let part = free.length();
        if part > f64::EPSILON.sqrt() {
            let along = free / part;
            p += along * (normal.dot(on - p) / part);
            taken.push(along);
        }
    }
    mesh.rules.put(bound, p)
}

/// The planes and lines of these bits as planes: of each a unit normal and a point.
fn bounds(mesh: &Mesh<'_>, bound: u32, place: DVec3) -> Vec<(DVec3, DVec3)> {
    let far = place.abs().max_element().max(mesh.rules.deviation);
    let bits = (0..u32::BITS).filter(|bit| bound & 1 << bit != 0);
    let of_bit = |bit: u32| {
        // Of a line, two of them tell all.
        DVec3::AXES.map(|axis| {
            let beside = place + axis * far;
            let on = (mesh.rules.onto)(bit, beside);
            ((beside - on).normalize_or_zero(), on)
        })
    };
    bits.flat_map(of_bit).collect()
}
