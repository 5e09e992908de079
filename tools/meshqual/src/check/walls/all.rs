//! All walls of a mesh.

use super::face::{Face, Mesh};
use super::{across, mirror};
use crate::check::findings::Findings;

/// Checks the walls of all templates.
pub fn check(mesh: Mesh<'_>, findings: &mut Findings) {
    for (own, template) in mesh.document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            let wall = Face { mesh, own, gluing };
            wall.check_outer(own, gluing.triangles_here(), findings);
            match gluing.mirror_plane(own) {
                Some(plane) => mirror::check(&wall, plane, findings),
                None => {
                    wall.check_outer(gluing.other as usize, gluing.triangles_there(), findings);
                    across::check(&wall, findings);
                }
            }
        }
    }
}

/// Largest distance between a vertex on a wall and the image of the one that it is paired with,
/// relative to the size. That of a mirror wall is twice the distance from its plane.
pub fn gluing_residual(mesh: &Mesh<'_>) -> f64 {
    let mut residual = 0.0_f64;
    for template in &mesh.document.templates {
        for gluing in &template.gluings {
            let beyond = &mesh.document.templates[gluing.other as usize];
            let step = gluing.step.placed();
            for &[here, there] in &gluing.vertex_pairs {
                let image = step.apply(beyond.vertices[there as usize]);
                residual = residual.max(image.distance(template.vertices[here as usize]));
            }
        }
    }
    if mesh.size > 0.0 {
        residual / mesh.size
    } else {
        0.0
    }
}
