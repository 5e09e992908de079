//! Why a wedge's surface could not be made.

use glam::DVec3;
use kit::Failure;
use mesher::Fault;
use thiserror::Error;

/// What the user can do instead.
const ADVICE: &str = "leave periodic-surf out, and tetwedge keeps the surface as it was cut, or cut with another --order, --hub, --start-angle or --deviation of wedgecut";

/// Why a wedge's surface could not be made. Places are canonical coordinates.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// The wedge is filled already.
    #[error(
        "the document holds {0} tetrahedra; periodic-surf works on the surface, before tetwedge"
    )]
    AlreadyFilled(usize),
    /// The free pass of the mesher failed.
    #[error("the mesh that is to guide the surface failed: {0}")]
    Mesher(#[from] mesher::Error),
    /// The free pass did not keep the edges of the surface.
    #[error(
        "the mesh that is to guide the surface of template {template} has {what} near ({}, {}, {})",
        place.x, place.y, place.z
    )]
    Guide {
        /// Template index.
        template: usize,
        /// What is odd.
        what: &'static str,
        /// Where.
        place: DVec3,
    },
    /// The faces of the seam do not correspond.
    #[error(
        "the two faces of the seam of template {template} are not joined alike near ({}, {}, {})",
        place.x, place.y, place.z
    )]
    Unmatched {
        /// Template index.
        template: usize,
        /// Where.
        place: DVec3,
    },
    /// A flat facet cannot be triangulated.
    #[error(
        "the outline of a flat facet of template {template} crosses itself near ({}, {}, {})",
        place.x, place.y, place.z
    )]
    Facet {
        /// Template index.
        template: usize,
        /// Where.
        place: DVec3,
    },
    /// The new surface does not bound what the old one did, or has vertices that the mesher takes for one.
    #[error("the new surface of template {template} is wrong: {what}")]
    Changed {
        /// Template index.
        template: usize,
        /// What, with numbers.
        what: String,
    },
}

impl SurfaceError {
    /// The exit code's class, and the message with advice.
    pub fn failure(&self) -> Failure {
        let text = self.to_string();
        match self {
            Self::AlreadyFilled(_) => Failure::Input(text),
            Self::Mesher(error) => of_fault(error.fault(), text),
            _ => Failure::Impossible(format!("{text}; {ADVICE}")),
        }
    }
}

/// The exit code's class of a mesher's error.
pub fn failure(error: &mesher::Error) -> Failure {
    of_fault(error.fault(), error.to_string())
}

fn of_fault(fault: Fault, text: String) -> Failure {
    match fault {
        Fault::Usage => Failure::Usage(text),
        Fault::Input => Failure::Input(text),
        Fault::Impossible => Failure::Impossible(text),
    }
}
