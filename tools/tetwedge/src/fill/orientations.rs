//! Tetrahedra that are positive, here and where their copies are placed.

use geom::predicate::orientation;
use glam::DVec3;
use mesher::Place;
use rayon::prelude::*;
use tmesh::{Template, Tet};

/// Whether tetrahedra are positive, exactly, and still so where their copies are placed.
pub struct Oriented {
    /// By how much a placed coordinate may be off, model units.
    off: f64,
}

impl Oriented {
    /// Coordinates of copies are up to `reach`, model units, and rounded.
    pub fn within(reach: f64) -> Self {
        // A placed coordinate is the sum of three terms and is rounded, and a product in each of two terms.
        Self {
            off: 4.0 * f64::EPSILON * reach,
        }
    }

    /// Whether a tetrahedron is positive with room for rounding.
    pub fn holds(&self, [a, b, c, d]: [DVec3; 4]) -> bool {
        let (u, v, w) = (b - a, c - a, d - a);
        let (uv, vw, wu) = (u.cross(v), v.cross(w), w.cross(u));
        let faces = [uv, vw, wu, uv + vw + wu].map(DVec3::length_squared);
        let largest = faces.into_iter().fold(0.0, f64::max).sqrt();
        // Each of the four corners may be off, across the face opposite to it.
        uv.dot(w) > 4.0 * self.off * largest && orientation(a, b, c, d) > 0.0
    }

    /// That all tetrahedra of a template hold; `first_new` is the number of the first vertex that the input does not have.
    ///
    /// # Errors
    /// How many do not, and the place of the first.
    pub fn all(&self, template: &Template, first_new: usize) -> Result<(), String> {
        let corners = |t: &Tet| t.vertices.map(|v| template.vertices[v as usize]);
        let bad = |t: &&Tet| !self.holds(corners(t));
        let count = template.tets.par_iter().filter(bad).count();
        match template.tets.iter().find(bad) {
            None => Ok(()),
            Some(t) => Err(format!(
                "{count} of {} tetrahedra are inverted or flat ({} new vertices), the first near {}",
                template.tets.len(),
                template.vertices.len() - first_new,
                Place(corners(t).iter().sum::<DVec3>() * 0.25)
            )),
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
        assert_eq!(Oriented::within(1.0).all(&flat(1e-9), 4), Ok(()));
        // Positive, but not for coordinates of a million.
        let told = Oriented::within(1e6).all(&flat(1e-9), 4).unwrap_err();
        assert!(
            told.contains("1 of 1 tetrahedra are inverted or flat"),
            "{told}"
        );
        assert!(Oriented::within(1.0).all(&flat(0.0), 4).is_err());
        assert!(Oriented::within(1.0).all(&flat(-1.0), 4).is_err());
    }
}
