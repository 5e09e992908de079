//! Which part of a face is the image of which.

use super::part::Part;
use tmesh::Isometry;

/// A part that is the image of another part, or of itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Join {
    /// Such as `wall-a` or `seam`.
    pub name: &'static str,
    /// The image.
    pub here: Part,
    /// What it is the image of; of a mirror wall the same.
    pub there: Part,
    /// Takes the part there onto the one here.
    pub step: Isometry,
}

impl Join {
    /// Whether the part is its own image, point by point.
    pub fn is_mirror(&self) -> bool {
        self.here == self.there
    }
}
