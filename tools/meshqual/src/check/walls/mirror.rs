//! Mirror walls: faces in a plane beyond which the mesh continues as its own image.

use super::face::Face;
use crate::check::findings::{Findings, Kind};
use geom::tolerance::PROMISE;
use tmesh::Plane;

/// Checks that everything on the plane is listed, and nothing lies beyond it.
pub fn check(wall: &Face<'_>, plane: Plane, findings: &mut Findings) {
    let template = wall.template(wall.own);
    let name = &wall.gluing.name;
    let listed = flags(template.vertices.len(), wall.gluing.vertices_here());
    let vertices = template.vertices.iter().enumerate();
    for (v, &p) in vertices.filter(|v| !listed[v.0]) {
        let distance = plane.distance(p);
        let kind = if distance.abs() <= PROMISE * wall.mesh.size {
            Kind::NearWall
        } else if distance > 0.0 {
            Kind::BeyondWall
        } else {
            continue;
        };
        findings.add(kind, || {
            let place = wall.at(wall.own, &[v as u32]);
            format!("vertex {v} lies {distance:e} from the plane of wall '{name}' {place}")
        });
    }
    let triangles = flags(template.triangles.len(), wall.gluing.triangles_here());
    let skin = &wall.mesh.skins[wall.own];
    for (face, &triangle) in skin.faces.iter().zip(&skin.triangles) {
        let on_plane = face.iter().all(|&v| listed[v as usize]);
        let known = triangle != u32::MAX && triangles[triangle as usize];
        if on_plane && !known {
            wall.unlisted(wall.own, *face, findings);
        }
    }
    for triangle in wall.gluing.triangles_here() {
        let vertices = template.triangles[triangle as usize].vertices;
        if !vertices.iter().all(|&v| listed[v as usize]) {
            findings.add(Kind::WallInside, || {
                let place = wall.at(wall.own, &vertices);
                format!(
                    "triangle {triangle} of wall '{name}' has vertices that are not on it {place}"
                )
            });
        }
    }
}

fn flags(count: usize, set: impl Iterator<Item = u32>) -> Vec<bool> {
    let mut flags = vec![false; count];
    set.for_each(|i| flags[i as usize] = true);
    flags
}
