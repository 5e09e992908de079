//! The report as text: tables and histograms for a terminal.

use super::words::{STATISTICS, beyond, check_table, symmetry_words, verdict};
use crate::measure::{Histogram, Metric, Statistic, Summary};
use crate::report::Report;
use kit::{grouped, number, point};
use std::fmt::Write;

/// Character cells of the longest histogram bar: what is left of a line of 90 beside the figures.
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
    for short in &report.shortfalls {
        let _ = writeln!(out, "NOT MET {short}");
    }
    for note in &report.notes {
        let _ = writeln!(out, "note: {note}");
    }
    out
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
        let copies = if w.copies > 1 {
            format!(", {} copies", grouped(w.copies))
        } else {
            String::new()
        };
        let _ = writeln!(
            out,
            "{:<20} {:>11}  {} near {}; tetrahedron {} of template {}{copies}",
            w.metric.name(),
            number(w.value),
            report.summary.region_name(w.region),
            point(w.place),
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
    for statistic in STATISTICS {
        let _ = write!(out, " {:>11}", statistic.name());
    }
    out.push('\n');
    let mut row = |name: &str, summary: &Summary, metric| {
        let _ = write!(out, "{name:<20}");
        for statistic in STATISTICS {
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
    for line in beyond(&report.summary) {
        let _ = writeln!(out, "{line}");
    }
    let other = report.compare.as_ref().map(|c| &c.summary);
    for line in other.into_iter().flat_map(beyond) {
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
    for (name, value) in check_table(c) {
        let value = value.unwrap_or_else(|| "-".to_owned());
        let _ = writeln!(out, "{name:<24} {value:>11}");
    }
    for failure in report.failures(true) {
        let _ = writeln!(out, "BROKEN {failure}");
    }
    if promises && report.checks.passed {
        let _ = writeln!(out, "{}", verdict(&report.checks));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_show_what_is_there() {
        assert_eq!(bar(0.0), "");
        assert_eq!(bar(1e-9), "▏");
        assert_eq!(bar(0.5).chars().count(), BAR / 2);
        assert_eq!(bar(1.0).chars().count(), BAR);
    }
}
