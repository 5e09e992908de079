//! Measures tetrahedral meshes and checks what an assembled mesh promises.
//!
//! [`analyse`] is the whole of it: documents in, a [`Report`] out. Instanced documents are measured
//! and checked as the mesh they stand for, without placing a copy.

mod beyond;
mod check;
mod cli;
mod faces;
mod html;
mod instances;
mod limit;
mod measure;
mod metric;
mod nearby;
mod picture;
mod png;
mod report;
#[cfg(test)]
mod specimens;
mod statistics;
mod svg;
mod text;
mod worst;

pub use beyond::{Beyond, Bound};
pub use check::{Broken, Checks};
pub use cli::Cli;
pub use html::{Pictures, html};
pub use instances::Realized;
pub use limit::Limit;
pub use metric::{Metric, Statistic};
pub use report::{
    Compared, Metrics, Params, RegionMetrics, RegionReport, Report, Summary, Surface, analyse,
};
pub use statistics::{Histogram, Statistics};
pub use svg::svg;
pub use text::text;
pub use worst::Worst;

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
}
