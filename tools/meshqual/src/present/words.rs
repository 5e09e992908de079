//! What text and page say in the same words.

use crate::check::Checks;
use crate::instances::Realized;
use crate::measure::{Statistic, Summary};
use kit::{grouped, number};
use std::fmt::Write;

/// Columns of the table of metrics, in the order of values.
pub const STATISTICS: [Statistic; 6] = [
    Statistic::Min,
    Statistic::P01,
    Statistic::P50,
    Statistic::Mean,
    Statistic::P99,
    Statistic::Max,
];

/// The order of a symmetry, with mirrors and with what holds outside of a hub.
pub fn symmetry_words(symmetry: &Realized) -> String {
    let mut of = symmetry.group.symbol();
    if let Some(outside) = &symmetry.outside {
        let radius = number(outside.radius);
        let _ = write!(of, ", of {} outside of the radius {radius}", outside.group);
    }
    of
}

/// What is beyond the bounds, a sentence each.
pub fn beyond(summary: &Summary) -> impl Iterator<Item = String> + use<'_> {
    summary.beyond.iter().map(|b| {
        let side = if b.bound.above { "above" } else { "below" };
        format!(
            "{} {side} {}: {} ({:.4} %)",
            b.bound.metric.name(),
            b.bound.value,
            grouped(b.count),
            100.0 * b.share
        )
    })
}

/// What is said of checks that broke no promise.
pub fn verdict(checks: &Checks) -> String {
    match checks.unchecked.as_slice() {
        [] => "all promises hold".to_owned(),
        list => format!(
            "all promises hold that can be checked; not checked: {}",
            list.join("; ")
        ),
    }
}

/// Names and results of the checks, where there are any, as tables show them.
pub fn check_table(checks: &Checks) -> [(&'static str, Option<String>); 8] {
    let answer = |b: bool| if b { "yes" } else { "NO" }.to_owned();
    let count = |n: u64| grouped(n);
    let error = |e: f64| format!("{e:.2e}");
    [
        ("conforming", checks.conforming.map(answer)),
        ("inverted", checks.inverted.map(count)),
        ("coincident vertices", checks.coincident_vertices.map(count)),
        ("symmetry residual", checks.symmetry_residual.map(error)),
        (
            "connectivity symmetric",
            checks.connectivity_symmetric.map(answer),
        ),
        ("volume error", checks.volume_error.map(error)),
        ("region volume error", checks.region_volume_error.map(error)),
        ("boundary area error", checks.boundary_area_error.map(error)),
    ]
}
