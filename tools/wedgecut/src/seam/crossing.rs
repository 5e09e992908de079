//! Whether faces at a seam cross, where its points were moved.

use crate::error::CutError;
use geom::contacts::contacts;
use tmesh::{Frame, Template};

/// Checks that no face that has a point of a seam meets another one but in common vertices and edges. `moved` is how far
/// points of seams were moved.
///
/// # Errors
/// [`CutError::MovedFacesCross`].
pub fn check_moved(
    templates: &[Template],
    moved: f64,
    (equal, frame): (f64, &Frame),
) -> Result<(), CutError> {
    if moved <= equal {
        return Ok(());
    }
    for (index, template) in templates.iter().enumerate() {
        let mut is_at_seam = vec![false; template.vertices.len()];
        for gluing in template.gluings.iter().filter(|g| g.is_seam(index)) {
            for v in gluing.vertex_pairs.iter().flatten() {
                is_at_seam[*v as usize] = true;
            }
        }
        let triangles: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        let at_seam = |t: u32| {
            triangles[t as usize]
                .iter()
                .any(|v| is_at_seam[*v as usize])
        };
        let mut first = None;
        contacts(
            &template.vertices,
            &triangles,
            |t| t,
            |contact| {
                if contact.triangles.into_iter().any(at_seam) {
                    first = Some(contact.point);
                }
                first.is_none()
            },
        );
        if let Some(point) = first {
            return Err(CutError::MovedFacesCross {
                near: frame.to_world(point),
                moved,
            });
        }
    }
    Ok(())
}
