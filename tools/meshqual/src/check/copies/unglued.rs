//! Looks for vertices and faces of different copies that meet and are not glued.

use super::near;
use super::rim::Rim;
use super::surface::Surface;
use crate::check::findings::{Findings, Kind, place};
use crate::check::walls::Mesh;
use geom::contacts::{Search, contacts};

/// Checks that copies meet only where they are glued; `on_wall` tells of each triangle of each template whether a gluing
/// lists it.
pub fn check(mesh: &Mesh<'_>, on_wall: &[Vec<bool>], findings: &mut Findings) {
    let document = mesh.document;
    let mut apart = true;
    let compared = near::instances(mesh);
    let rim = Rim::new(mesh, &compared, |meeting| {
        apart = false;
        findings.add(Kind::Unglued, || {
            let [(a, v), (b, w)] = meeting.vertices;
            format!(
                "vertex {v} of instance {a} and vertex {w} of instance {b} are {:e} apart {}",
                meeting.distance,
                place(document, meeting.point)
            )
        });
    });
    // Faces on each other have vertices on each other, and one finding says enough.
    if !apart {
        return;
    }
    let surface = Surface::of(mesh, on_wall, &compared, &rim);
    let instances = |faces: [u32; 2]| faces.map(|f| surface.instances[f as usize]);
    for pair in surface.repeated() {
        findings.add(Kind::UngluedFace, || {
            let [a, b] = instances(pair);
            let corner = surface.faces[pair[0] as usize][0];
            let place = place(document, rim.points[corner as usize]);
            format!("faces of instance {a} and instance {b} {place}")
        });
    }
    let group = |face: u32| surface.instances[face as usize];
    let end = contacts(&rim.points, &surface.faces, group, |contact| {
        findings.add(Kind::Crossing, || {
            let [a, b] = instances(contact.triangles);
            let place = place(document, contact.point);
            format!("faces of instance {a} and instance {b} {place}")
        });
        true
    });
    if matches!(end, Search::GaveUp) && !findings.has(&[Kind::Crossing]) {
        findings.add(Kind::Crossing, || {
            "there are too many that nearly meet to look at all".to_owned()
        });
    }
}
