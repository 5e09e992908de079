//! Why a foreign file could not be read.

use glam::DVec3;
use thiserror::Error;

/// Why a foreign file could not be read. Each message names the place in the file or in space.
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
    /// The surface is well-formed but not what the pipe can work with.
    #[error("{0}")]
    BadSurface(String),
    /// The surface is well-formed but not closed.
    #[error("{message}")]
    NotClosed {
        /// How many edges, and where the first ones are.
        message: String,
        /// All of them.
        edges: Box<OddEdges>,
    },
    /// The document inside is damaged.
    #[error(transparent)]
    Tmesh(#[from] tmesh::DecodeError),
}

/// Edges that keep a surface from being closed, by their ends in world coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OddEdges {
    /// Edges of one triangle only.
    pub open: Vec<[DVec3; 2]>,
    /// Edges with three triangles or a higher odd number.
    pub crowded: Vec<[DVec3; 2]>,
}
