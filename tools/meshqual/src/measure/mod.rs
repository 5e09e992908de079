//! How good the elements are: metrics, their statistics over all copies, and what is asked of them.

mod assignment;
mod bound;
mod limit;
mod measured;
mod metric;
mod statistics;
mod summary;
mod surface;
mod worst;

pub use bound::{Beyond, Bound};
pub use limit::Limit;
pub use measured::{Measured, measure};
pub use metric::Metric;
pub use statistics::{Histogram, Statistic, Statistics, common_bins};
pub use summary::{Metrics, RegionMetrics, RegionReport, Summary};
pub use surface::Surface;
pub use worst::Worst;
