//! The report as text: tables and histograms for a terminal.

use crate::beyond;
use crate::instances::Realized;
use crate::statistics::Histogram;
use crate::{Checks, Metric, Report, Statistic, Summary};
use std::fmt::Write;

/// Cells of the longest histogram bar.
const BAR: usize = 40;
/// Eighths of a cell.
const BLOCKS: [char; 8] = [' ', '▏', '▎', '▍', '▌', '▋', '▊', '▉'];

/// The whole report. `promises`: say of each check how it went.
pub fn text(report: &Report, promises: bool) -> String {
    let mut out = String::new();
    sizes(&mut out, &report.summary);
    if let Some(other) = &report.compare {
        let _ = writeln!(out, "\nCompared with {}", other.name);
        sizes(&mut out, &other.summary);
    }
    metrics(&mut out, report);
    worst(&mut out, report);
    for metric in Metric::ALL {
        let Some(own) = report.summary.metrics.get(metric) else {
            continue;
        };
        let other = report.compare.as_ref();
        let other = other.and_then(|c| c.summary.metrics.get(metric));
        let _ = writeln!(out, "\n{}", metric.name());
        histogram(&mut out, &own.histogram, other.map(|o| &o.histogram));
    }
    checks(&mut out, report, promises);
    for note in &report.notes {
        let _ = writeln!(out, "note: {note}");
    }
    out
}

/// The order of a symmetry, with mirrors and with what holds outside of a hub.
pub fn symmetry_words(symmetry: &Realized) -> String {
    let mut of = format!("order {}", symmetry.order);
    if symmetry.mirror {
        of.push_str(" with mirrors");
    }
    if symmetry.horizontal_mirror {
        of.push_str(" and a horizontal mirror");
    }
    if let Some(outside) = &symmetry.outside {
        let mirrors = match outside.mirror && !symmetry.mirror {
            true => " with mirrors",
            false => "",
        };
        let radius = number(outside.radius);
        let _ = write!(
            of,
            ", of order {}{mirrors} outside of the radius {radius}",
            outside.order
        );
    }
    of
}

fn sizes(out: &mut String, s: &Summary) {
    let _ = writeln!(
        out,
        "{} vertices, {} tetrahedra, {} surface triangles",
        grouped(s.vertices),
        grouped(s.tetrahedra),
        grouped(s.surface.triangles)
    );
    if let Some(symmetry) = &s.symmetry {
        let of = symmetry_words(symmetry);
        let plural = |n: u64| if n == 1 { "" } else { "s" };
        if s.instances == 1 {
            let _ = writeln!(out, "one piece that promises a symmetry of {of}");
        } else {
            let _ = writeln!(
                out,
                "{} template{} placed {} time{}, symmetry of {of}",
                s.templates,
                plural(s.templates),
                s.instances,
                plural(s.instances)
            );
        }
    }
    let _ = writeln!(
        out,
        "volume {}, boundary area {}",
        number(s.volume),
        number(s.surface.boundary_area)
    );
    if s.regions.is_empty() {
        return;
    }
    let width = s.regions.iter().map(|r| r.name.chars().count()).max();
    let width = width.unwrap_or(0).clamp(6, 40);
    let _ = writeln!(
        out,
        "\n{:<width$} {:>10} {:>14} {:>14} {:>12} {:>12} {:>12}",
        "region", "id", "tetrahedra", "volume", "min dihedral", "its p01", "rad-edge p99"
    );
    for r in &s.regions {
        let of = |metric, statistic| {
            let value = r.metrics.get(metric).map(|m| m.get(statistic));
            value.map_or("-".to_owned(), number)
        };
        let _ = writeln!(
            out,
            "{:<width$} {:>10} {:>14} {:>14} {:>12} {:>12} {:>12}",
            r.name,
            r.id,
            grouped(r.tetrahedra),
            number(r.volume),
            of(Metric::MinDihedral, Statistic::Min),
            of(Metric::MinDihedral, Statistic::P01),
            of(Metric::RadiusEdgeRatio, Statistic::P99)
        );
    }
}

fn worst(out: &mut String, report: &Report) {
    if !report.worst.is_empty() {
        out.push_str("\nworst elements\n");
    }
    for w in &report.worst {
        let [x, y, z] = w.place.map(number);
        let copies = if w.copies > 1 {
            format!(", {} copies", grouped(w.copies))
        } else {
            String::new()
        };
        let _ = writeln!(
            out,
            "{:<20} {:>11}  {} near ({x}, {y}, {z}); tetrahedron {} of template {}{copies}",
            w.metric.name(),
            number(w.value),
            report.region_name(w.region),
            w.tetrahedron,
            w.template,
        );
    }
}

fn metrics(out: &mut String, report: &Report) {
    if report.summary.tetrahedra == 0 && report.compare.is_none() {
        return;
    }
    let _ = write!(out, "\n{:<20}", "metric");
    let order = [
        Statistic::Min,
        Statistic::P01,
        Statistic::P50,
        Statistic::Mean,
        Statistic::P99,
        Statistic::Max,
    ];
    for statistic in order {
        let _ = write!(out, " {:>11}", statistic.name());
    }
    out.push('\n');
    let mut row = |name: &str, summary: &Summary, metric| {
        let _ = write!(out, "{name:<20}");
        for statistic in order {
            let value = summary.metrics.get(metric).map(|m| m.get(statistic));
            let _ = write!(out, " {:>11}", value.map_or("-".to_owned(), number));
        }
        out.push('\n');
    };
    for metric in Metric::ALL {
        row(metric.name(), &report.summary, metric);
        if let Some(other) = &report.compare {
            row("  compared", &other.summary, metric);
        }
    }
    for line in beyond::sentences(&report.summary) {
        let _ = writeln!(out, "{line}");
    }
    let other = report.compare.as_ref().map(|c| &c.summary);
    for line in other.into_iter().flat_map(beyond::sentences) {
        let _ = writeln!(out, "  compared: {line}");
    }
}

fn histogram(out: &mut String, own: &Histogram, other: Option<&Histogram>) {
    let total = |h: &Histogram| h.counts.iter().sum::<u64>().max(1) as f64;
    let shares =
        |h: &Histogram| -> Vec<f64> { h.counts.iter().map(|&c| c as f64 / total(h)).collect() };
    let rows = [Some(own), other];
    let longest = rows
        .iter()
        .flatten()
        .flat_map(|h| shares(h))
        .fold(0.0, f64::max);
    // Empty bins at the ends say nothing.
    let used = |i: &usize| rows.iter().flatten().any(|h| h.counts[*i] > 0);
    let bins = 0..own.counts.len();
    let Some(first) = bins.clone().find(used) else {
        return;
    };
    let last = bins.rev().find(used).unwrap_or(first);
    for i in first..=last {
        let (low, high) = (number(own.edges[i]), number(own.edges[i + 1]));
        for (h, label) in rows
            .iter()
            .flatten()
            .zip([format!("{low:>11} to {high:<11}"), " ".repeat(26)])
        {
            let share = shares(h)[i];
            let line = format!(
                "{label} {:>12} {:>6.2} % {}",
                grouped(h.counts[i]),
                100.0 * share,
                bar(share / longest)
            );
            let _ = writeln!(out, "{}", line.trim_end());
        }
    }
}

/// A bar of eighth blocks; what is not nothing shows.
fn bar(share: f64) -> String {
    let eighths = (share * (8 * BAR) as f64).round() as usize;
    let eighths = if share > 0.0 { eighths.max(1) } else { 0 };
    let mut bar = "█".repeat(eighths / 8);
    if eighths % 8 > 0 {
        bar.push(BLOCKS[eighths % 8]);
    }
    bar
}

fn checks(out: &mut String, report: &Report, promises: bool) {
    let c = &report.checks;
    out.push('\n');
    for (name, value) in c.table() {
        let value = value.unwrap_or_else(|| "-".to_owned());
        let _ = writeln!(out, "{name:<24} {value:>11}");
    }
    for failure in report.failures(true) {
        let _ = writeln!(out, "BROKEN {failure}");
    }
    if promises && report.checks.passed {
        let _ = writeln!(out, "all promises hold");
    }
}

impl Checks {
    /// Names and results, where there are any, as tables show them.
    pub fn table(&self) -> [(&'static str, Option<String>); 8] {
        let answer = |b: bool| if b { "yes" } else { "NO" }.to_owned();
        let count = |n: u64| grouped(n);
        let error = |e: f64| format!("{e:.2e}");
        [
            ("conforming", self.conforming.map(answer)),
            ("inverted", self.inverted.map(count)),
            ("coincident vertices", self.coincident_vertices.map(count)),
            ("symmetry residual", self.symmetry_residual.map(error)),
            (
                "connectivity symmetric",
                self.connectivity_symmetric.map(answer),
            ),
            ("volume error", self.volume_error.map(error)),
            ("region volume error", self.region_volume_error.map(error)),
            ("boundary area error", self.boundary_area_error.map(error)),
        ]
    }
}

/// Six significant digits, shortest of plain and scientific notation.
pub fn number(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if !x.is_finite() {
        return if x > 0.0 { "inf" } else { "-inf" }.to_owned();
    }
    let scientific = format!("{x:.5e}");
    let exponent = scientific.split_once('e').and_then(|s| s.1.parse().ok());
    let exponent: i32 = exponent.unwrap_or(0);
    if (-4..7).contains(&exponent) {
        let text = format!("{x:.*}", (5 - exponent).max(0) as usize);
        if text.contains('.') {
            return text.trim_end_matches('0').trim_end_matches('.').to_owned();
        }
        return text;
    }
    format!("{x:.4e}")
}

/// A count with its digits in groups of three.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(' ');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (x, expected) in [
            (0.0, "0"),
            (1.0, "1"),
            (70.528779, "70.5288"),
            (-0.25, "-0.25"),
            (123456.7, "123457"),
            (1e-7, "1.0000e-7"),
            (1.5e9, "1.5000e9"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(number(x), expected);
        }
        assert_eq!(grouped(1_234_567), "1 234 567");
        assert_eq!(grouped(12), "12");
    }

    #[test]
    fn bars_show_what_is_there() {
        assert_eq!(bar(0.0), "");
        assert_eq!(bar(1e-9), "▏");
        assert_eq!(bar(0.5).chars().count(), BAR / 2);
        assert_eq!(bar(1.0).chars().count(), BAR);
    }
}
