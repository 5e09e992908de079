//! The report as a page: tables, histograms and pictures in one file that needs no other.

use super::drawing::{self, Colour, quality_colour, quality_legend, region_colour};
use super::svg::{escaped, histograms, outlined};
use super::words::{STATISTICS, beyond, check_table, symmetry_words, verdict};
use crate::error::Error;
use crate::measure::{Metric, Statistic, Summary};
use crate::report::Report;
use base64::display::Base64Display;
use base64::engine::general_purpose::STANDARD;
use kit::{grouped, number, point};
use std::fmt::Write;
use tmesh::Document;

/// Pictures of a mesh.
pub struct Pictures {
    outside: Vec<u8>,
    inside: Option<Vec<u8>>,
    /// The same by region, where there are several.
    regions: Option<Vec<u8>>,
}

impl Pictures {
    /// Draws a mesh.
    ///
    /// # Errors
    /// Pictures that cannot be encoded.
    pub fn of(document: &Document) -> Result<Self, Error> {
        Ok(Self {
            outside: drawing::outside(document)?,
            inside: drawing::inside(document, Colour::Quality)?,
            regions: match document.regions.len() {
                0 | 1 => None,
                _ => drawing::inside(document, Colour::Region)?,
            },
        })
    }
}

/// Regions named below a picture; the table of regions has them all.
const NAMED_REGIONS: usize = 16;

const STYLE: &str = "body{font:14px/1.5 sans-serif;color:#222;max-width:1680px;margin:2em auto;padding:0 1em}\
table{border-collapse:collapse;margin:.5em 0 1.5em}td,th{padding:.15em .9em;text-align:right;border-bottom:1px solid #ddd}\
td,th{white-space:nowrap}td:first-child,th:first-child{text-align:left;padding-left:0}figure{margin:0}.wide{overflow-x:auto}\
.pictures,.histograms{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(24em,100%),1fr));gap:1em;margin-bottom:1em}.histograms{grid-template-columns:repeat(auto-fit,minmax(min(30em,100%),1fr))}\
figcaption{color:#555}.key{white-space:nowrap}img{width:100%;height:auto;border:1px solid #ddd}.broken{color:#b2182b;font-weight:bold}\
.key i{display:inline-block;width:.9em;height:.9em;margin:0 .3em 0 .8em;vertical-align:-.1em}svg{width:100%;height:auto}";

/// The page.
pub fn html(report: &Report, title: &str, pictures: &Pictures) -> String {
    let mut out = String::new();
    let name = escaped(title);
    let _ = writeln!(
        out,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>{name}</title>\
         <style>{STYLE}</style></head>\n<body>\n<h1>{name}</h1>"
    );
    sizes(&mut out, &report.summary);
    images(&mut out, report, pictures);
    regions(&mut out, &report.summary);
    metrics(&mut out, report);
    distributions(&mut out, report);
    worst(&mut out, report);
    checks(&mut out, report);
    for note in &report.notes {
        let _ = writeln!(out, "<p>{}</p>", escaped(note));
    }
    out.push_str("</body>\n</html>\n");
    out
}

fn sizes(out: &mut String, s: &Summary) {
    let _ = write!(
        out,
        "<p>{} vertices, {} tetrahedra, {} surface triangles; volume {}, boundary area {}",
        grouped(s.vertices),
        grouped(s.tetrahedra),
        grouped(s.surface.triangles),
        number(s.volume),
        number(s.surface.boundary_area)
    );
    if let Some(symmetry) = &s.symmetry {
        let _ = write!(out, "; symmetry of {}", symmetry_words(symmetry));
        if s.instances > 1 {
            let _ = write!(out, ", {} copies", grouped(s.instances));
        }
    }
    out.push_str("</p>\n");
}

fn key(out: &mut String, colour: [f64; 3], text: &str) {
    let [r, g, b] = colour.map(|c| c as u8);
    let _ = write!(
        out,
        " <span class=\"key\"><i style=\"background:rgb({r},{g},{b})\"></i>{}</span>",
        escaped(text)
    );
}

fn images(out: &mut String, report: &Report, pictures: &Pictures) {
    out.push_str("<div class=\"pictures\">\n");
    let mut figure = |bytes: &[u8], words: &str, caption: &dyn Fn(&mut String)| {
        let _ = write!(
            out,
            "<figure><img alt=\"{words}\" src=\"data:image/png;base64,{}\"><figcaption>{words}:",
            Base64Display::new(bytes, &STANDARD)
        );
        caption(out);
        out.push_str("</figcaption></figure>\n");
    };
    let by_region = |out: &mut String| {
        for (i, region) in report
            .summary
            .regions
            .iter()
            .enumerate()
            .take(NAMED_REGIONS)
        {
            key(out, region_colour(i), &region.name);
        }
    };
    figure(&pictures.outside, "Surface, by region", &by_region);
    if let Some(regions) = &pictures.regions {
        let words = "Elements behind a plane through the middle, by region";
        figure(regions, words, &by_region);
    }
    if let Some(inside) = &pictures.inside {
        let words = "Elements behind a plane through the middle, by smallest dihedral angle";
        figure(inside, words, &|out| {
            for degrees in quality_legend() {
                let text = format!("{degrees}°");
                key(out, quality_colour(degrees), &text);
            }
        });
    }
    out.push_str("</div>\n");
}

fn regions(out: &mut String, s: &Summary) {
    out.push_str(
        "<h2>Regions</h2>\n<div class=\"wide\"><table><tr><th>region</th><th>id</th><th>tetrahedra</th><th>volume</th>\
         <th>smallest dihedral</th><th>1 %</th><th>radius-edge 99 %</th><th>largest</th></tr>\n",
    );
    for r in &s.regions {
        let of = |metric, statistic| {
            let value = r.metrics.get(metric).map(|m| m.get(statistic));
            value.map_or("-".to_owned(), number)
        };
        let _ = writeln!(
            out,
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
             <td>{}</td></tr>",
            escaped(&r.name),
            r.id,
            grouped(r.tetrahedra),
            number(r.volume),
            of(Metric::MinDihedral, Statistic::Min),
            of(Metric::MinDihedral, Statistic::P01),
            of(Metric::RadiusEdgeRatio, Statistic::P99),
            of(Metric::RadiusEdgeRatio, Statistic::Max),
        );
    }
    out.push_str("</table></div>\n");
}

fn metrics(out: &mut String, report: &Report) {
    out.push_str("<h2>Quality</h2>\n<div class=\"wide\"><table><tr><th>metric</th>");
    for statistic in STATISTICS {
        let _ = write!(out, "<th>{}</th>", statistic.name());
    }
    out.push_str("</tr>\n");
    let other = report
        .compare
        .as_ref()
        .map(|c| (c.name.as_str(), &c.summary));
    let all = [("", &report.summary)].into_iter().chain(other);
    for metric in Metric::ALL {
        for (name, summary) in all.clone() {
            let name = match name {
                "" => metric.name().to_owned(),
                name => format!("compared: {}", escaped(name)),
            };
            let _ = write!(out, "<tr><td>{name}</td>");
            for statistic in STATISTICS {
                let value = summary.metrics.get(metric).map(|m| m.get(statistic));
                let _ = write!(out, "<td>{}</td>", value.map_or("-".to_owned(), number));
            }
            out.push_str("</tr>\n");
        }
    }
    out.push_str("</table></div>\n");
    for (name, summary) in all {
        for line in beyond(summary) {
            let of = if name.is_empty() { "" } else { "compared: " };
            let _ = writeln!(out, "<p>{of}{}</p>", escaped(&line));
        }
    }
}

fn distributions(out: &mut String, report: &Report) {
    out.push_str("<h2>Distributions</h2>\n");
    if let Some(outlined) = outlined(report) {
        let _ = writeln!(out, "<p>{}</p>", escaped(&outlined));
    }
    out.push_str("<div class=\"histograms\">\n");
    histograms(report).for_each(|image| out.push_str(&image));
    out.push_str("</div>\n");
}

fn worst(out: &mut String, report: &Report) {
    if report.worst.is_empty() {
        return;
    }
    out.push_str(
        "<h2>Worst elements</h2>\n<div class=\"wide\"><table><tr><th>metric</th><th>value</th><th>region</th>\
         <th>place</th><th>template</th><th>tetrahedron</th><th>copies</th></tr>\n",
    );
    for w in &report.worst {
        let _ = writeln!(
            out,
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
             <td>{}</td></tr>",
            w.metric.name(),
            number(w.value),
            escaped(&report.summary.region_name(w.region)),
            point(w.place),
            w.template,
            w.tetrahedron,
            w.copies
        );
    }
    out.push_str("</table></div>\n");
}

fn checks(out: &mut String, report: &Report) {
    out.push_str("<h2>Checks</h2>\n");
    let failures = report.failures(true);
    for failure in &failures {
        let _ = writeln!(out, "<p class=\"broken\">{}</p>", escaped(failure));
    }
    for short in &report.shortfalls {
        let _ = writeln!(out, "<p class=\"broken\">{}</p>", escaped(short));
    }
    if failures.is_empty() {
        let verdict = verdict(&report.checks);
        let _ = writeln!(out, "<p>No limit is broken; {}.</p>", escaped(&verdict));
    }
    out.push_str("<div class=\"wide\"><table>\n");
    for (name, value) in check_table(&report.checks) {
        let value = value.unwrap_or_else(|| "-".to_owned());
        let _ = writeln!(out, "<tr><td>{name}</td><td>{value}</td></tr>");
    }
    out.push_str("</table></div>\n");
}
