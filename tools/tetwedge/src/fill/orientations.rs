//! Tetrahedra that are positive, here and where their copies are placed.

use geom::predicate::orientation;
use glam::DVec3;
use mesher::Place;
use rayon::prelude::*;
use tmesh::{Template, Tet};

/// All tetrahedra positive, exactly, and still so where their copies are placed: coordinates there are up to
/// `reach` (model units), and rounded.
pub fn orientations(template: &Template, first_new: usize, reach: f64) -> Result<(), String> {
    // A placed coordinate is the sum of three terms and is rounded, and a product in each of two terms.
    let off = 4.0 * f64::EPSILON * reach;
    let bad = |t: &&Tet| {
        let [a, b, c, d] = t.vertices.map(|v| template.vertices[v as usize]);
        let (u, v, w) = (b - a, c - a, d - a);
        let (uv, vw, wu) = (u.cross(v), v.cross(w), w.cross(u));
        let faces = [uv, vw, wu, uv + vw + wu].map(DVec3::length_squared);
        let largest = faces.into_iter().fold(0.0, f64::max).sqrt();
        // Each of the four corners may be off, across the face opposite to it.
        let safe = uv.dot(w) > 4.0 * off * largest;
        !safe || orientation(a, b, c, d) <= 0.0
    };
    let count = template.tets.par_iter().filter(bad).count();
    if count == 0 {
        return Ok(());
    }
    match template.tets.iter().find(bad) {
        None => Ok(()),
        Some(t) => {
            let corners = t.vertices.map(|v| template.vertices[v as usize]);
            Err(format!(
                "{count} of {} tetrahedra are inverted or flat ({} new vertices), the first near {}",
                template.tets.len(),
                template.vertices.len() - first_new,
                Place(corners.iter().sum::<DVec3>() * 0.25)
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_that_placing_could_turn_over_are_refused() {
        let flat = |height: f64| Template {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z * height],
            tets: vec![Tet {
                vertices: [0, 1, 2, 3],
                region: 1,
            }],
            ..Template::default()
        };
        assert_eq!(orientations(&flat(1e-9), 4, 1.0), Ok(()));
        // Positive, but not for coordinates of a million.
        let told = orientations(&flat(1e-9), 4, 1e6).unwrap_err();
        assert!(
            told.contains("1 of 1 tetrahedra are inverted or flat"),
            "{told}"
        );
        assert!(orientations(&flat(0.0), 4, 1.0).is_err());
        assert!(orientations(&flat(-1.0), 4, 1.0).is_err());
    }
}
