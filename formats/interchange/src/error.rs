//! Why a foreign file could not be read or written.

use std::io;
use thiserror::Error;

/// Why a foreign file could not be read. Each message names the place in the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The bytes do not follow the format.
    #[error("{format}: {reason}")]
    Malformed {
        /// Format name.
        format: &'static str,
        /// What is wrong, and where.
        reason: String,
    },
    /// The format is known, but not for input.
    #[error("{0} is not an input format")]
    NotAnInput(&'static str),
    /// Numbers at points are wanted, and are not read from this format.
    #[error("{0} has no numbers at points that are read; vtk, vtu and msh have")]
    NoPointData(&'static str),
    /// The document inside is damaged.
    #[error(transparent)]
    Tmesh(#[from] tmesh::DecodeError),
}

/// Why a mesh could not be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// Writing failed.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The format is known, but not for output.
    #[error("{0} is not an output format")]
    NotAnOutput(&'static str),
    /// The mesh has more of something than the format can count.
    #[error("the mesh has {count} {what}, and {format} counts no further than {limit}")]
    TooLarge {
        /// Format name.
        format: &'static str,
        /// What there is too much of.
        what: &'static str,
        /// How many there are.
        count: u64,
        /// How many the format can count.
        limit: u64,
    },
    /// A surface format, and no surface.
    #[error("the mesh has no surface triangles, so there is nothing to write as {0}")]
    NoSurface(&'static str),
    /// A format of volumes, and none.
    #[error("the mesh has no tetrahedra, so there is nothing to write as {0}")]
    NoVolume(&'static str),
    /// A format of several files, and one place to write to.
    #[error(
        "a mesh in the format {0} is several files; give a path with rotassemble -o, such as mesh.{0}"
    )]
    SeveralFiles(&'static str),
    /// Second-order elements in a format that is written with first-order ones only.
    #[error("{0} is written with first-order elements only")]
    NoSecondOrder(&'static str),
}
