//! Finds the axis, order and mirror planes of a body: of its shape, not of its tessellation.
//!
//! Candidate axes come from moments that are exact integrals over the triangles, candidate orders and
//! mirror planes from scans with a few samples. Each candidate's axis and centre are adjusted to the
//! shape, and then every operation is verified: images of vertices and face samples must lie on the
//! surface, on an interface of the same two regions, within a tolerance relative to the radius about
//! the axis.

mod candidates;
mod cli;
mod complete;
mod defects;
mod detect;
mod drawing;
mod error;
mod faces;
mod facets;
mod findings;
mod group;
mod mirror;
mod moments;
mod order;
mod permutation;
mod placement;
mod refine;
mod refusal;
mod report;
mod samples;
mod shape;
mod summary;
mod svg;
mod swing;
mod verify;

#[cfg(test)]
mod bodies;
#[cfg(test)]
mod tests;

pub use cli::Cli;
pub use defects::{Defects, Places};
pub use detect::{Detection, detect};
pub use error::{At, Closest, Error};
pub use report::Report;
pub use summary::OrderResidual;
pub use svg::svg;

use glam::DVec3;
use tmesh::Document;

/// Checked options.
#[derive(Clone, Debug)]
pub struct Params {
    /// Largest deviation from symmetry, relative to the radius about the axis.
    pub tolerance: f64,
    /// Unit direction of the axis, if given.
    pub axis: Option<DVec3>,
    /// A point on the axis, world coordinates, if given.
    pub center: Option<DVec3>,
    /// The order to verify, if given.
    pub order: Option<u32>,
    /// Highest order tried.
    pub max_order: u32,
    /// Whether a body without symmetry is passed on.
    pub allow_asymmetric: bool,
    /// Whether residuals are measured order by order for a table or a plot.
    pub profile: bool,
    /// Threads used at most; the result does not depend on it.
    pub threads: usize,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            axis: None,
            center: None,
            order: None,
            max_order: 1024,
            allow_asymmetric: false,
            profile: false,
            threads: kit::available_threads(),
        }
    }
}

/// Adds its symmetry to a document.
pub fn run(mut document: Document, params: &Params) -> Result<Document, Error> {
    let detection = detect(&document, params, &mut |_| ())?;
    document.symmetry = Some(detection.symmetry);
    document.search = Some(detection.search);
    Ok(document)
}
