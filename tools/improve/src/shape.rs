//! Curved shapes that the surface stands for.

use glam::DVec3;
use std::sync::Arc;

/// A curved shape in patches, along which vertices of the surface may be moved. Positions are those that elements are improved at: the
/// template's times the scale.
pub trait Shape: Send + Sync {
    /// The place of a patch that is nearest to a point, and the unit normal there.
    fn nearest(&self, patch: u32, p: DVec3) -> Option<(DVec3, DVec3)>;

    /// Whether a triangle of the surface may be there, whose first corner was moved; all of those around a vertex are asked for.
    fn holds(&self, patch: u32, corners: [DVec3; 3]) -> bool;
}

/// A point of the shape that the surface stays near to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Where it is.
    pub at: DVec3,
    /// How far the surface may be.
    pub reach: f64,
}

/// What stands for a curved shape.
#[derive(Clone)]
pub struct Curved<'a> {
    /// The shape.
    pub shape: Arc<dyn Shape>,
    /// The patch that each facet stands for, [`NO_PATCH`] for none.
    pub patches: &'a [u32],
    /// Cosine of the angle between triangles from which on an edge is a feature, which stays.
    pub feature: f64,
    /// Points of the shape that each facet is near to, model units.
    pub points: &'a [Vec<Point>],
    /// What coordinates are multiplied by to improve elements.
    pub scale: f64,
}

/// No patch.
pub const NO_PATCH: u32 = u32::MAX;
