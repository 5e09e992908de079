//! Why a mesh cannot be measured.

use thiserror::Error;

/// Why a mesh cannot be measured.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The document is not one.
    #[error("the mesh is inconsistent: {0}")]
    Invalid(tmesh::Violation),
    /// The mesh has nothing to measure.
    #[error("the mesh has neither tetrahedra nor triangles; did the previous stage fail?")]
    Empty,
    /// Too many faces for the indices used.
    #[error(
        "the mesh has {faces} faces in one template, more than the 2147483648 that can be checked"
    )]
    TooLarge {
        /// Faces, counting each tetrahedron's own.
        faces: u64,
    },
    /// A picture could not be encoded.
    #[error("cannot encode a picture of the mesh: {0}")]
    Picture(#[from] png::EncodingError),
}
