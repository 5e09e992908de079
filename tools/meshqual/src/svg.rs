//! The histograms as an SVG image: two rows of three panels.

use crate::statistics::{Histogram, Statistics};
use crate::text::number;
use crate::{Metric, Report};
use std::fmt::Write;

/// Size of a panel's plot and the margins around it, pixels.
const WIDTH: f64 = 340.0;
const HEIGHT: f64 = 200.0;
const LEFT: f64 = 52.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 34.0;
/// Height of the headline, pixels.
const HEAD: f64 = 48.0;

/// The image. With a comparison, the other mesh is drawn as an outline; heights are shares.
pub fn svg(report: &Report, title: &str) -> String {
    let panel = (LEFT + WIDTH + RIGHT, TOP + HEIGHT + BOTTOM);
    let (width, height) = (3.0 * panel.0, HEAD + 2.0 * panel.1);
    let mut out = String::new();
    let _ = writeln!(
        out,
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="11" fill="#222222">
<rect width="{width}" height="{height}" fill="#ffffff"/>"##
    );
    let summary = &report.summary;
    let _ = writeln!(
        out,
        r#"<text x="{LEFT}" y="24" font-size="15" font-weight="bold">{}</text>"#,
        escaped(title)
    );
    let mut line = format!(
        "{} vertices, {} tetrahedra",
        summary.vertices, summary.tetrahedra
    );
    if let Some(other) = &report.compare {
        let _ = write!(
            line,
            "; outline: {} ({} tetrahedra)",
            other.name, other.summary.tetrahedra
        );
    }
    let _ = writeln!(out, r#"<text x="{LEFT}" y="42">{}</text>"#, escaped(&line));
    for (i, metric) in Metric::ALL.into_iter().enumerate() {
        let x = (i % 3) as f64 * panel.0 + LEFT;
        let y = HEAD + (i / 3) as f64 * panel.1 + TOP;
        let _ = writeln!(out, r#"<g transform="translate({x} {y})">"#);
        let other = report.compare.as_ref();
        let other = other.and_then(|c| c.summary.metrics.get(metric));
        draw(&mut out, metric, summary.metrics.get(metric), other);
        let _ = writeln!(out, "</g>");
    }
    let _ = writeln!(out, "</svg>");
    out
}

fn draw(out: &mut String, metric: Metric, own: Option<&Statistics>, other: Option<&Statistics>) {
    let _ = writeln!(
        out,
        r#"<text y="-22" font-weight="bold">{}</text>"#,
        metric.name()
    );
    let Some(reference) = own.or(other) else {
        let _ = writeln!(out, r#"<text y="-7">no tetrahedra</text>"#);
        return;
    };
    if let Some(s) = own {
        let _ = writeln!(
            out,
            r#"<text y="-7">min {}  p01 {}  p50 {}  p99 {}  max {}</text>"#,
            number(s.min),
            number(s.p01),
            number(s.p50),
            number(s.p99),
            number(s.max)
        );
    }
    let all = [own, other];
    let highest = all
        .iter()
        .flatten()
        .flat_map(|s| shares(&s.histogram))
        .fold(f64::MIN_POSITIVE, f64::max);
    let bins = reference.histogram.counts.len() as f64;
    let x = |i: usize| WIDTH * i as f64 / bins;
    let y = |share: f64| HEIGHT * (1.0 - share / highest);
    if let Some(s) = own {
        for (i, share) in shares(&s.histogram).into_iter().enumerate() {
            if share > 0.0 {
                let _ = writeln!(
                    out,
                    r##"<rect x="{:.2}" y="{:.2}" width="{:.2}" height="{:.2}" fill="#4c78a8"><title>{} to {}: {}</title></rect>"##,
                    x(i) + 0.5,
                    y(share),
                    (WIDTH / bins - 1.0).max(0.5),
                    HEIGHT - y(share),
                    number(s.histogram.edges[i]),
                    number(s.histogram.edges[i + 1]),
                    s.histogram.counts[i]
                );
            }
        }
    }
    if let Some(s) = other {
        let mut path = format!("M0 {HEIGHT}");
        for (i, share) in shares(&s.histogram).into_iter().enumerate() {
            let _ = write!(path, " V{:.2} H{:.2}", y(share), x(i + 1));
        }
        let _ = writeln!(
            out,
            r##"<path d="{path} V{HEIGHT}" fill="none" stroke="#e45756" stroke-width="1.5"/>"##
        );
    }
    let _ = writeln!(
        out,
        r##"<path d="M0 0 V{HEIGHT} H{WIDTH}" fill="none" stroke="#222222"/>
<text x="-5" y="8" text-anchor="end">{:.1} %</text>
<text x="-5" y="{HEIGHT}" text-anchor="end">0</text>"##,
        100.0 * highest
    );
    let edges = &reference.histogram.edges;
    let count = edges.len() - 1;
    let mut ticks: Vec<usize> = (0..=4).map(|i| i * count / 4).collect();
    ticks.dedup();
    for i in ticks {
        let _ = writeln!(
            out,
            r##"<path d="M{0:.2} {HEIGHT} v4" stroke="#222222"/><text x="{0:.2}" y="{1}" text-anchor="middle">{2}</text>"##,
            x(i),
            HEIGHT + 16.0,
            number(edges[i])
        );
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
