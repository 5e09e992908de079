//! What is known of the facets of a surface before it is improved.

use crate::shape::Curved;
use glam::DVec3;

/// Facets of the surface of a filled template.
pub struct Flats<'a> {
    /// Facet of each surface triangle.
    pub of_triangle: &'a [u32],
    /// Unit normal of each facet; zero where it has none.
    pub normals: &'a [DVec3],
    /// Sine of the angle by which parts of each facet may lean.
    pub slopes: &'a [f64],
    /// Vertices that must stay where they are.
    pub fixed: &'a [u32],
    /// Surface triangles that must stay.
    pub kept: &'a [u32],
    /// A vertex this far from the line between its neighbours is on it, model units.
    pub straight: f64,
    /// The curved shape that facets stand for, if vertices may be moved along it.
    pub curved: Option<Curved<'a>>,
}
