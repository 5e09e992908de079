//! Motions of the body, and what the images of its triangles may land on.

use glam::{DMat3, DVec3};
use std::sync::Arc;
use tmesh::Frame;

/// A rigid or improper motion that fixes a point.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Orthogonal matrix.
    pub linear: DMat3,
    /// The fixed point.
    pub centre: DVec3,
}

impl Motion {
    /// The motion that has matrix `canonical` in the frame.
    pub fn new(frame: &Frame, canonical: DMat3) -> Self {
        Self {
            linear: frame.rotation * canonical * frame.rotation.transpose(),
            centre: frame.origin,
        }
    }

    /// Image of a point.
    #[inline]
    pub fn apply(&self, p: DVec3) -> DVec3 {
        self.centre + self.linear * (p - self.centre)
    }
}

/// What the image of a triangle may land on.
#[derive(Clone, Debug)]
pub enum Target {
    /// Any triangle.
    Any,
    /// Triangles of the class that the list gives for each class; [`NO_CLASS`] where there is none.
    Classes(Arc<[u32]>),
}

/// No interface separates the two regions.
pub const NO_CLASS: u32 = u32::MAX;
