//! Finds the axis, order and mirror planes of a body: of its shape, not of its tessellation.
//!
//! Candidate axes come from moments that are exact integrals over the triangles, candidate orders and
//! mirror planes from scans with a few samples. Each candidate's axis and centre are adjusted to the
//! shape, and then every operation is verified: images of vertices and face samples must lie on the
//! surface, on an interface of the same two regions, within a tolerance relative to the radius about
//! the axis.

mod budget;
mod cli;
mod detect;
mod enclosure;
mod error;
mod group;
mod nearly;
mod params;
mod redrawn;
mod report;
mod rotation;
mod shape;
mod threads;
mod tolerance;
mod verify;

#[cfg(test)]
mod bodies;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_groups;

pub use cli::Cli;
pub use detect::detect;
pub use error::{Closest, Error};
pub use nearly::Nearly;
pub use params::Params;
pub use report::{Defects, Detection, OrderResidual, Places, Report, svg};

use tmesh::Document;

/// Adds its symmetry to a document.
pub fn run(mut document: Document, params: &Params) -> Result<Document, Error> {
    let detection = detect(&document, None, params, &mut |_| ())?;
    document.symmetry = Some(detection.symmetry);
    document.search = Some(detection.search);
    Ok(document)
}
