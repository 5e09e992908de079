//! Why a file did not become a document.

use glam::DVec3;
use interchange::ReadError;
use thiserror::Error;

/// Why a file did not become a document. Each message names the place in the file or in space.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum HealError {
    /// The file could not be parsed.
    #[error(transparent)]
    Read(#[from] ReadError),
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
}

impl HealError {
    /// The same with a further reason, if there is one.
    pub fn because(self, reason: Option<&str>) -> Self {
        match (self, reason) {
            (Self::NotClosed { message, edges }, Some(reason)) => Self::NotClosed {
                message: format!("{message}; {reason}"),
                edges,
            },
            (other, _) => other,
        }
    }
}

/// Edges that keep a surface from being closed, by their ends in world coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OddEdges {
    /// Edges of one triangle only.
    pub open: Vec<[DVec3; 2]>,
    /// Edges with three triangles or a higher odd number.
    pub crowded: Vec<[DVec3; 2]>,
}
