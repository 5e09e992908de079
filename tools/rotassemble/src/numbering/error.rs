//! Why copies cannot be numbered.

use thiserror::Error;
use tmesh::Isometry;

/// Why the copies of a document cannot be numbered.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NumberingError {
    /// Some instances have a neighbour across a wall and others have none.
    #[error(
        "instance {isometry} of template {template} has no neighbour across wall '{wall}', though \
         others have"
    )]
    MissingNeighbour {
        /// Template index.
        template: usize,
        /// The instance's placement.
        isometry: Isometry,
        /// The wall's name.
        wall: String,
    },
    /// A chain of walls leads to a placement that is not among the instances.
    #[error(
        "following the walls from instance {isometry} of template {template} leads to a placement \
         of template {other} that is not there"
    )]
    Incomplete {
        /// Template index.
        template: usize,
        /// The instance's placement.
        isometry: Isometry,
        /// Template at the end of the chain.
        other: usize,
    },
    /// More points than ids.
    #[error(
        "the assembled mesh has {points} points, and vertex ids end at {}",
        u32::MAX
    )]
    TooManyPoints {
        /// Points needed.
        points: u64,
    },
}
