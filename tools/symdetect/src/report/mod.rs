//! What is said of a body: the symmetry found, tables, drawings, the JSON report, or why there is none.

mod defects;
mod detection;
mod deviations;
mod drawing;
mod findings;
mod json;
mod nearly;
mod other_axes;
mod refusal;
mod residuals;
mod summary;
mod svg;

pub use defects::{Defects, Places};
pub use detection::{Detection, OrderResidual};
pub use json::{FailureReport, Report, ReportGap};
pub use svg::svg;
