//! Why a document could not be filled with tetrahedra.

use crate::failure::{Failure, FailureKind};
use glam::DVec3;
use std::fmt;
use thiserror::Error;

/// Position in a message, model units, canonical frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place(pub DVec3);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let short = |x: f64| if x == 0.0 { 0.0 } else { x };
        let [x, y, z] = self.0.to_array().map(short);
        write!(f, "({x:.6e}, {y:.6e}, {z:.6e})")
    }
}

/// Why a document could not be filled with tetrahedra. Places are canonical coordinates.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A template has no surface.
    #[error("template {template} has no surface to fill; did the previous stage fail?")]
    NoSurface {
        /// Template index.
        template: usize,
    },
    /// The surface has borders.
    #[error(
        "the surface of template {template} is not closed: {edges} open edge(s), the first near {place}"
    )]
    Open {
        /// Template index.
        template: usize,
        /// Number of edges that bound a single triangle.
        edges: usize,
        /// Middle of the first one.
        place: Place,
    },
    /// Triangles that bound one cell disagree about its region.
    #[error(
        "the surface of template {template} is not closed or its regions are inconsistent: one cell is bounded by {first} and, near {place}, by {second}"
    )]
    MixedCell {
        /// Template index.
        template: usize,
        /// Region named by the first triangle.
        first: RegionName,
        /// Region named by another one.
        second: RegionName,
        /// A point on the other one.
        place: Place,
    },
    /// A region reaches to infinity.
    #[error(
        "the surface of template {template} is inside out: {region} is not enclosed near {place}"
    )]
    Unbounded {
        /// Template index.
        template: usize,
        /// The region.
        region: RegionName,
        /// A point on its boundary.
        place: Place,
    },
    /// The sizes asked for mean more elements than can be held.
    #[error(
        "the volume limit {max_volume:e} means at least {count:.1e} tetrahedra in template {template}; the limit is {limit:.1e}"
    )]
    TooMany {
        /// Template index.
        template: usize,
        /// Volume limit, model units cubed.
        max_volume: f64,
        /// Volume over limit.
        count: f64,
        /// How many there may be.
        limit: f64,
    },
    /// The walls of a template mean more elements than can be held.
    #[error(transparent)]
    Walls(#[from] sizing::TooMany),
    /// The mesher did not deliver.
    #[error("{failure}{place}; {advice}")]
    Mesher {
        /// What happened.
        failure: Failure,
        /// Where, as a phrase; may be empty.
        place: String,
        /// What to try.
        advice: &'static str,
    },
    /// What the mesher delivered, or became of it, does not fit its input.
    #[error("the mesh of template {template} is unusable: {what}; {ADVICE}")]
    Unusable {
        /// Template index.
        template: usize,
        /// What is wrong, with numbers and a place.
        what: String,
    },
    /// The mesh has a triangle of the surface that a copy has as well.
    #[error(
        "the mesh of template {template} is unusable: a triangle beside wall '{wall}' lies on it near {place}; {ADVICE}"
    )]
    Doubled {
        /// Template index.
        template: usize,
        /// Name of the wall.
        wall: String,
        /// Middle of the triangle.
        place: Place,
    },
}

/// What to try when it is not known what is wrong.
pub(crate) const ADVICE: &str = "clean or simplify the surface, cut it with another --order, --start-angle, --seam or --deviation of wedgecut, or change the element parameters";

/// Who can do something about an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// What is asked for makes no sense.
    Usage,
    /// The input is malformed.
    Input,
    /// The input is sound, but this cannot be done.
    Impossible,
}

/// Steps in which TetGen puts a surface into its mesh.
const RECOVERY: [&str; 2] = ["Constrained Delaunay", "Recovering boundaries"];

impl Error {
    /// Who can do something about it.
    pub fn fault(&self) -> Fault {
        match self {
            Self::Mesher { failure, .. } if failure.kind == FailureKind::Switches => Fault::Usage,
            Self::NoSurface { .. }
            | Self::Open { .. }
            | Self::MixedCell { .. }
            | Self::Unbounded { .. } => Fault::Input,
            Self::TooMany { .. }
            | Self::Walls(_)
            | Self::Mesher { .. }
            | Self::Unusable { .. }
            | Self::Doubled { .. } => Fault::Impossible,
        }
    }

    /// Whether another description of the same surface may go through.
    pub fn is_chance(&self) -> bool {
        match self {
            Self::Mesher { failure, .. } => failure.kind == FailureKind::Chance,
            Self::Unusable { .. } | Self::Doubled { .. } => true,
            _ => false,
        }
    }

    /// Whether the mesher failed while it put the surface into its mesh, before it refined that.
    pub fn is_of_recovery(&self) -> bool {
        match self {
            Self::Mesher { failure, .. } => RECOVERY.contains(&failure.step.as_str()),
            _ => false,
        }
    }
}

/// A region id in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegionName(pub u32);

impl fmt::Display for RegionName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            tmesh::OUTSIDE => f.write_str("the outside"),
            id => write!(f, "region {id}"),
        }
    }
}
