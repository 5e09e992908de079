//! Measures tetrahedral meshes and checks what an assembled mesh promises.
//!
//! [`analyse`] is the whole of it: documents in, a [`Report`] out. Instanced documents are measured
//! and checked as the mesh they stand for, without placing a copy.

mod check;
mod cli;
mod error;
mod instances;
mod measure;
mod present;
mod report;
mod soundness;

pub use check::{Broken, Checks};
pub use cli::Cli;
pub use error::Error;
pub use instances::Realized;
pub use measure::{
    Beyond, Bound, Histogram, Limit, Metric, Metrics, RegionMetrics, RegionReport, Statistic,
    Statistics, Summary, Surface, Worst,
};
pub use present::{Pictures, html, svg, text};
pub use report::{Compared, Params, Report, analyse};
