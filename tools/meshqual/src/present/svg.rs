//! The histograms as SVG: an image of two rows of three panels, or an image for each, for pages.

use super::drawing::Ticks;
use crate::measure::{Histogram, Metric, Statistics};
use crate::report::Report;
use geom::number::significant;
use kit::{grouped, number};
use std::fmt::Write;

/// The look of the image, pixels. All of it is a matter of taste: nothing is computed from it.
struct Layout {
    /// Size of a panel's plot.
    width: f64,
    height: f64,
    /// Margins around the plot.
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    /// Height of the headline above the panels, and its two base lines.
    head: f64,
    title_base: f64,
    sizes_base: f64,
    /// Base lines of a panel's name and statistics, relative to the plot's top.
    name_base: f64,
    statistics_base: f64,
    /// Base line of the labels below the plot, relative to its bottom.
    label_base: f64,
    /// Base line of the label of the highest share, relative to the plot's top.
    share_base: f64,
    /// Distance of the labels at the left from the plot.
    label_gap: f64,
    /// Length of the ticks below the plot.
    tick: f64,
    /// Gap between bars, and the least width of a bar.
    gap: f64,
    least_bar: f64,
    /// Panels side by side, and the labels of a plot at most.
    columns: usize,
    labels: usize,
    /// Digits of labels and statistics.
    digits: usize,
}

const LAYOUT: Layout = Layout {
    width: 340.0,
    height: 200.0,
    left: 52.0,
    right: 30.0,
    top: 44.0,
    bottom: 34.0,
    head: 48.0,
    title_base: 24.0,
    sizes_base: 42.0,
    name_base: -22.0,
    statistics_base: -7.0,
    label_base: 16.0,
    share_base: 8.0,
    label_gap: 5.0,
    tick: 4.0,
    gap: 1.0,
    least_bar: 0.5,
    columns: 3,
    labels: 8,
    digits: 3,
};

/// The image. With a comparison, the other mesh is drawn as an outline; heights are shares.
pub fn svg(report: &Report, title: &str) -> String {
    let Layout { columns, left, .. } = LAYOUT;
    let panel = panel();
    let rows = Metric::ALL.len().div_ceil(columns);
    let width = columns as f64 * panel.0;
    let height = LAYOUT.head + rows as f64 * panel.1;
    let words = format!("Histograms of the elements of {title}");
    let mut out = String::new();
    begin(&mut out, (width, height), &words);
    headline(&mut out, report, title);
    for (i, metric) in Metric::ALL.into_iter().enumerate() {
        let x = (i % columns) as f64 * panel.0 + left;
        let y = LAYOUT.head + (i / columns) as f64 * panel.1 + LAYOUT.top;
        draw(&mut out, report, metric, (x, y));
    }
    let _ = writeln!(out, "</svg>");
    out
}

/// An image for each metric.
pub fn histograms(report: &Report) -> impl Iterator<Item = String> + use<'_> {
    Metric::ALL.into_iter().map(move |metric| {
        let mut out = String::new();
        begin(
            &mut out,
            panel(),
            &format!("Histogram of {}", metric.name()),
        );
        draw(&mut out, report, metric, (LAYOUT.left, LAYOUT.top));
        out.push_str("</svg>\n");
        out
    })
}

/// What the outline is of a mesh that another one is compared with.
pub fn outlined(report: &Report) -> Option<String> {
    let other = report.compare.as_ref()?;
    Some(format!(
        "outline: {} ({} tetrahedra)",
        other.name,
        grouped(other.summary.tetrahedra)
    ))
}

/// Width and height of a panel.
fn panel() -> (f64, f64) {
    (
        LAYOUT.left + LAYOUT.width + LAYOUT.right,
        LAYOUT.top + LAYOUT.height + LAYOUT.bottom,
    )
}

/// The beginning of an image, and its ground.
fn begin(out: &mut String, (width, height): (f64, f64), words: &str) {
    let _ = writeln!(
        out,
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img" aria-label="{}" font-family="sans-serif" font-size="11" fill="#222222">
<rect width="{width}" height="{height}" fill="#ffffff"/>"##,
        escaped(words)
    );
}

fn headline(out: &mut String, report: &Report, title: &str) {
    let Layout {
        left,
        title_base,
        sizes_base,
        ..
    } = LAYOUT;
    let summary = &report.summary;
    let _ = writeln!(
        out,
        r#"<text x="{left}" y="{title_base}" font-size="15" font-weight="bold">{}</text>"#,
        escaped(title)
    );
    let mut line = format!(
        "{} vertices, {} tetrahedra",
        grouped(summary.vertices),
        grouped(summary.tetrahedra)
    );
    if let Some(outlined) = outlined(report) {
        let _ = write!(line, "; {outlined}");
    }
    let line = escaped(&line);
    let _ = writeln!(out, r#"<text x="{left}" y="{sizes_base}">{line}</text>"#);
}

/// A panel with its plot at a place.
fn draw(out: &mut String, report: &Report, metric: Metric, (x, y): (f64, f64)) {
    let own = report.summary.metrics.get(metric);
    let other = report.compare.as_ref();
    let other = other.and_then(|c| c.summary.metrics.get(metric));
    let _ = writeln!(out, r#"<g transform="translate({x} {y})">"#);
    plot(out, metric, own, other);
    let _ = writeln!(out, "</g>");
}

/// What a panel shows, the bars of the mesh, the outline of the other one, and the axes.
fn plot(out: &mut String, metric: Metric, own: Option<&Statistics>, other: Option<&Statistics>) {
    let Layout {
        name_base,
        statistics_base,
        ..
    } = LAYOUT;
    let name = metric.name();
    let _ = writeln!(
        out,
        r#"<text y="{name_base}" font-weight="bold">{name}</text>"#
    );
    let Some(reference) = own.or(other) else {
        let _ = writeln!(out, r#"<text y="{statistics_base}">no tetrahedra</text>"#);
        return;
    };
    if let Some(s) = own {
        let values = [s.min, s.p01, s.p50, s.p99, s.max];
        let names = ["min", "p01", "p50", "p99", "max"];
        for (i, (name, value)) in names.into_iter().zip(values).enumerate() {
            let x = (LAYOUT.width + LAYOUT.right) * i as f64 / names.len() as f64;
            let value = significant(value, LAYOUT.digits);
            let _ = writeln!(
                out,
                r##"<text x="{x:.0}" y="{statistics_base}" font-size="10"><tspan fill="#777777">{name}</tspan> {value}</text>"##
            );
        }
    }
    let shown = [own, other].into_iter().flatten();
    let plot = Plot {
        bins: reference.histogram.counts.len(),
        highest: shown
            .flat_map(|s| shares(&s.histogram))
            .fold(f64::MIN_POSITIVE, f64::max),
    };
    if let Some(s) = own {
        plot.bars(out, &s.histogram);
    }
    if let Some(s) = other {
        plot.outline(out, &s.histogram);
    }
    plot.axes(out, &Ticks::of(&reference.histogram.edges, LAYOUT.labels));
}

/// The scales of a panel.
struct Plot {
    bins: usize,
    /// The highest share of a bin.
    highest: f64,
}

impl Plot {
    /// Where a bin begins.
    fn x(&self, bin: usize) -> f64 {
        LAYOUT.width * bin as f64 / self.bins as f64
    }

    fn y(&self, share: f64) -> f64 {
        LAYOUT.height * (1.0 - share / self.highest)
    }

    fn bars(&self, out: &mut String, histogram: &Histogram) {
        let width = (LAYOUT.width / self.bins as f64 - LAYOUT.gap).max(LAYOUT.least_bar);
        for (i, share) in shares(histogram).into_iter().enumerate() {
            if share > 0.0 {
                let _ = writeln!(
                    out,
                    r##"<rect x="{:.2}" y="{:.2}" width="{width:.2}" height="{:.2}" fill="#4c78a8"><title>{} to {}: {}</title></rect>"##,
                    self.x(i) + 0.5 * LAYOUT.gap,
                    self.y(share),
                    LAYOUT.height - self.y(share),
                    number(histogram.edges[i]),
                    number(histogram.edges[i + 1]),
                    histogram.counts[i]
                );
            }
        }
    }

    fn outline(&self, out: &mut String, histogram: &Histogram) {
        let height = LAYOUT.height;
        let mut path = format!("M0 {height}");
        for (i, share) in shares(histogram).into_iter().enumerate() {
            let _ = write!(path, " V{:.2} H{:.2}", self.y(share), self.x(i + 1));
        }
        let _ = writeln!(
            out,
            r##"<path d="{path} V{height}" fill="none" stroke="#e45756" stroke-width="1.5"/>"##
        );
    }

    fn axes(&self, out: &mut String, ticks: &Ticks) {
        let Layout {
            width,
            height,
            label_gap,
            share_base,
            tick,
            ..
        } = LAYOUT;
        let _ = writeln!(
            out,
            r##"<path d="M0 0 V{height} H{width}" fill="none" stroke="#222222"/>
<text x="-{label_gap}" y="{share_base}" text-anchor="end">{:.1} %</text>
<text x="-{label_gap}" y="{height}" text-anchor="end">0</text>"##,
            100.0 * self.highest
        );
        for &(value, share) in &ticks.0 {
            let _ = writeln!(
                out,
                r##"<path d="M{0:.2} {height} v{tick}" stroke="#222222"/><text x="{0:.2}" y="{1}" text-anchor="middle">{2}</text>"##,
                width * share,
                height + LAYOUT.label_base,
                significant(value, LAYOUT.digits)
            );
        }
    }
}

fn shares(histogram: &Histogram) -> Vec<f64> {
    let total = histogram.counts.iter().sum::<u64>().max(1) as f64;
    histogram.counts.iter().map(|&c| c as f64 / total).collect()
}

/// Text as it can stand in XML.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // XML has no other control characters.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
