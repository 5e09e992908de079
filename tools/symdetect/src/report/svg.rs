//! What was found, as an image: the body along its axis with its mirror planes, from the side, and
//! how far it is off under every order tried.

use crate::report::detection::Detection;
use crate::report::drawing::{Segment, Views, views};
use kit::{number, point};
use std::f64::consts::PI;
use std::fmt::Write;
use tmesh::{Document, OtherAxis, Symmetry};

/// Side of a view, width and height of the plot, and the space around them, pixels.
const VIEW: f64 = 340.0;
const PLOT: [f64; 2] = [1080.0, 200.0];
const MARGIN: f64 = 56.0;
const HEAD: f64 = 92.0;
/// First line and distance of lines in the panel of figures, pixels; directions in one line; decimals of them, below which there is noise.
const FIRST: f64 = 30.0;
const LINE: f64 = 15.0;
const ABREAST: usize = 2;
const DECIMALS: f64 = 1e3;
/// Height of the bars of what is below the plot, pixels, so that they are seen.
const LEAST_BAR: f64 = 5.0;
/// Decades of the plot below the tolerance: what holds is far below it, and how far is the noise of rounding.
const DECADES_BELOW: f64 = 3.0;
/// Mirror planes drawn at most.
const MOST_PLANES: u32 = 128;

const INK: &str = "#222222";
const BODY: &str = "#4c78a8";
const MIRROR: &str = "#e45756";
const AXIS: &str = "#2f9e44";
const HELD: &str = "#2f9e44";
const NOT_HELD: &str = "#9a9a9a";

/// The image.
pub fn svg(document: &Document, found: &Detection, title: &str) -> String {
    let symmetry = &found.symmetry;
    let views = document.templates.first().map(|t| views(t, symmetry));
    let width = PLOT[0] + 2.0 * MARGIN;
    let height = HEAD + VIEW + PLOT[1] + 2.5 * MARGIN;
    let mut out = String::new();
    let _ = writeln!(
        out,
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img" aria-label="{}" font-family="sans-serif" font-size="11" fill="{INK}">
<rect width="{width}" height="{height}" fill="#ffffff"/>
<text x="{MARGIN}" y="28" font-size="16" font-weight="bold">{}: {}</text>"##,
        escaped(&format!("The symmetry of {title}")),
        escaped(title),
        symmetry.group
    );
    for (i, line) in found.summary().iter().take(3).enumerate() {
        let y = 46 + 15 * i;
        let _ = writeln!(
            out,
            r#"<text x="{MARGIN}" y="{y}">{}</text>"#,
            escaped(line)
        );
    }
    if let Some(views) = &views {
        let _ = writeln!(out, r#"<g transform="translate({MARGIN} {HEAD})">"#);
        along_axis(&mut out, views, symmetry);
        let second = VIEW + 0.5 * MARGIN;
        let _ = writeln!(
            out,
            r#"</g><g transform="translate({} {HEAD})">"#,
            MARGIN + second
        );
        from_side(&mut out, views, symmetry);
        let third = MARGIN + 2.0 * second;
        let _ = writeln!(out, r#"</g><g transform="translate({third} {HEAD})">"#);
        facts(&mut out, found);
        let _ = writeln!(out, "</g>");
    }
    let y = HEAD + VIEW + MARGIN;
    let _ = writeln!(out, r#"<g transform="translate({MARGIN} {y})">"#);
    plot(&mut out, found);
    let _ = writeln!(out, "</g>\n</svg>");
    out
}

/// Drawing coordinates of a view from its own: `scale` pixels a unit around the middle.
struct Scale {
    middle: [f64; 2],
    pixels: f64,
}

impl Scale {
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let half = 0.5 * VIEW;
        [
            half + self.pixels * (x - self.middle[0]),
            half - self.pixels * (y - self.middle[1]),
        ]
    }

    fn line(&self, out: &mut String, ends: Segment, style: &str) {
        let [[x, y], [u, v]] = ends.map(|p| self.at(p));
        let _ = writeln!(
            out,
            r#"<line x1="{x:.1}" y1="{y:.1}" x2="{u:.1}" y2="{v:.1}" {style}/>"#
        );
    }

    fn outline(&self, out: &mut String, segments: &[Segment]) {
        let mut path = String::new();
        for s in segments {
            let [[x, y], [u, v]] = s.map(|p| self.at(p));
            let _ = write!(path, "M{x:.1} {y:.1}L{u:.1} {v:.1}");
        }
        let _ = writeln!(
            out,
            r#"<path d="{path}" fill="none" stroke="{BODY}" stroke-width="0.8" stroke-linecap="round"/>"#
        );
    }
}

fn along_axis(out: &mut String, views: &Views, symmetry: &Symmetry) {
    heading(out, "along the axis");
    let reach = views.reach.max(1e-9);
    let scale = Scale {
        middle: [0.0; 2],
        pixels: 0.43 * VIEW / reach,
    };
    scale.outline(out, &views.top);
    let n = symmetry.group.order;
    let end = |angle: f64| {
        let (s, c) = libm::sincos(angle);
        [1.1 * reach * c, 1.1 * reach * s]
    };
    if symmetry.group.has_vertical_mirrors() && n <= MOST_PLANES {
        let style = format!(r#"stroke="{MIRROR}" stroke-width="0.9" stroke-dasharray="7 3""#);
        for k in 0..n {
            let [x, y] = end(PI * f64::from(k) / f64::from(n));
            scale.line(out, [[-x, -y], [x, y]], &style);
        }
    } else if !symmetry.group.has_vertical_mirrors() && n > 1 && n <= MOST_PLANES {
        // The steps of the rotation.
        let style = format!(r#"stroke="{AXIS}" stroke-width="0.7" stroke-dasharray="2 4""#);
        for k in 0..n {
            scale.line(
                out,
                [[0.0; 2], end(2.0 * PI * f64::from(k) / f64::from(n))],
                &style,
            );
        }
    }
    let [x, y] = scale.at([0.0; 2]);
    let _ = writeln!(out, r#"<circle cx="{x}" cy="{y}" r="3.5" fill="{AXIS}"/>"#);
}

fn from_side(out: &mut String, views: &Views, symmetry: &Symmetry) {
    heading(out, "from the side, the axis upwards");
    let [low, high] = views.span;
    let size = views.reach.max(0.5 * (high - low)).max(1e-9);
    let scale = Scale {
        middle: [0.0, 0.5 * (low + high)],
        pixels: 0.43 * VIEW / size,
    };
    scale.outline(out, &views.side);
    let more = 0.08 * size;
    let axis = [[0.0, low - more], [0.0, high + more]];
    scale.line(
        out,
        axis,
        &format!(r#"stroke="{AXIS}" stroke-width="1.3" stroke-dasharray="12 3 2 3""#),
    );
    if symmetry.group.has_horizontal_mirror() {
        let end = views.reach + more;
        scale.line(
            out,
            [[-end, 0.0], [end, 0.0]],
            &format!(r#"stroke="{MIRROR}" stroke-width="0.9" stroke-dasharray="7 3""#),
        );
    }
}

/// Axis, centre and the other axes in figures.
fn facts(out: &mut String, found: &Detection) {
    let symmetry = &found.symmetry;
    heading(out, "in figures");
    let mut lines = vec![
        format!("group {}, order {}", symmetry.group, symmetry.group.order),
        format!("axis {}", point(symmetry.axis.direction)),
        format!("centre {}", point(symmetry.axis.point)),
        format!("radius {}", number(symmetry.radius)),
        format!("residual {:.2e} of the radius", symmetry.residual),
        format!("tolerance {:.0e} of the radius", symmetry.tolerance),
    ];
    if symmetry.group.has_vertical_mirrors() {
        lines.push(format!(
            "mirror planes contain the axis: {}, one along {}",
            symmetry.group.order,
            point(symmetry.reference)
        ));
    }
    if symmetry.group.has_horizontal_mirror() {
        lines.push("a mirror plane across the axis".to_owned());
    }
    if symmetry.axisymmetric {
        lines.push("a body of revolution".to_owned());
    }
    let room = ((VIEW - FIRST) / LINE) as usize + 1 - lines.len();
    lines.extend(other_axes(&found.search.other_axes, found.axes, room));
    for (i, line) in lines.iter().enumerate() {
        let y = FIRST + LINE * i as f64;
        let _ = writeln!(out, r#"<text x="8" y="{y}">{}</text>"#, escaped(line));
    }
}

/// The other axes by their orders, in so many lines; the last one counts those for which there is no room, or
/// which are not listed.
fn other_axes(axes: &[OtherAxis], count: usize, room: usize) -> Vec<String> {
    let mut lines: Vec<(String, usize)> = Vec::new();
    let unlisted = count - axes.len();
    let mut seen = 0;
    for same in axes.chunk_by(|a, b| a.order == b.order) {
        seen += same.len();
        // Those that are not listed are half turns, which come last.
        let beside = if seen == axes.len() { unlisted } else { 0 };
        let all = same.len() + beside;
        let one = if all == 1 { "axis" } else { "axes" };
        lines.push((format!("{all} other {one} of order {}:", same[0].order), 0));
        for some in same.chunks(ABREAST) {
            let directions = some.iter().map(|axis| {
                let [x, y, z] = axis
                    .direction
                    .map(|c| number((c * DECIMALS).round() / DECIMALS + 0.0));
                format!("({x}, {y}, {z})")
            });
            lines.push((directions.collect::<Vec<_>>().join("  "), some.len()));
        }
    }
    if lines.len() + usize::from(unlisted > 0) > room {
        lines.truncate(room.saturating_sub(1));
    }
    let left = count - lines.iter().map(|l| l.1).sum::<usize>();
    if left > 0 {
        lines.push((format!("and {left} more"), 0));
    }
    lines.into_iter().map(|l| l.0).collect()
}

/// Residual against order, the tolerance as a line.
fn plot(out: &mut String, found: &Detection) {
    let _ = writeln!(
        out,
        r#"<text y="-12" font-weight="bold">largest deviation under each order about this axis, in radii (green: holds)</text>"#
    );
    let [width, height] = PLOT;
    let tolerance = found.symmetry.tolerance;
    let bottom = libm::floor(libm::log10(tolerance.max(f64::EPSILON))) - DECADES_BELOW;
    let y = |v: f64| {
        let share = (libm::log10(v.max(f64::MIN_POSITIVE)) - bottom) / -bottom;
        height * (1.0 - share.clamp(0.0, 1.0))
    };
    for decade in bottom as i32..=0 {
        let at = y(libm::pow(10.0, f64::from(decade)));
        let _ = writeln!(
            out,
            r##"<path d="M0 {at:.1} H{width}" stroke="#dddddd"/><text x="-6" y="{:.1}" text-anchor="end">{}1e{decade}</text>"##,
            at + 4.0,
            if f64::from(decade) > bottom {
                ""
            } else {
                "≤ "
            }
        );
    }
    let count = found.profile.len().max(1) as f64;
    let step = width / count;
    let label_every = (count / 40.0).ceil() as usize;
    for (i, r) in found.profile.iter().enumerate() {
        let (x, top) = (step * i as f64, y(r.residual).min(height - LEAST_BAR));
        let colour = if r.holds { HELD } else { NOT_HELD };
        let _ = writeln!(
            out,
            r#"<rect x="{:.2}" y="{top:.1}" width="{:.2}" height="{:.1}" fill="{colour}"><title>order {}: {:.2e}</title></rect>"#,
            x + 0.15 * step,
            0.7 * step,
            height - top,
            r.order,
            r.residual
        );
        if r.holds && step >= 9.0 || i % label_every == 0 {
            let _ = writeln!(
                out,
                r#"<text x="{:.1}" y="{:.1}" text-anchor="middle">{}</text>"#,
                x + 0.5 * step,
                height + 14.0,
                r.order
            );
        }
    }
    let at = y(tolerance);
    let _ = writeln!(
        out,
        r#"<path d="M0 {at:.1} H{width}" stroke="{MIRROR}" stroke-width="1.2"/><text x="{width}" y="-12" text-anchor="end" fill="{MIRROR}">red line: tolerance {tolerance:.0e}</text>
<path d="M0 0 V{height} H{width}" fill="none" stroke="{INK}"/>"#
    );
}

fn heading(out: &mut String, text: &str) {
    let _ = writeln!(
        out,
        r##"<rect width="{VIEW}" height="{VIEW}" fill="none" stroke="#dddddd"/><text x="6" y="14" font-weight="bold">{text}</text>"##
    );
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_axes_that_are_counted_are_listed_or_said_to_be_left_out() {
        let axis = |order, x| OtherAxis {
            direction: [x, -1e-17, 1.0],
            order,
            residual: 0.0,
        };
        let mut axes = vec![axis(4, 0.0)];
        axes.extend((0..6).map(|i| axis(2, f64::from(i))));
        let all = other_axes(&axes, axes.len(), 6);
        assert_eq!(all[..2], ["1 other axis of order 4:", "(0, 0, 1)"]);
        assert_eq!(
            all[2..4],
            ["6 other axes of order 2:", "(0, 0, 1)  (1, 0, 1)"]
        );
        assert_eq!(all.len(), 6);
        assert_eq!(other_axes(&axes, axes.len(), 5)[4], "and 4 more");
        assert_eq!(other_axes(&axes, axes.len(), 1), ["and 7 more"]);
        let some = other_axes(&axes, 99, 7);
        assert_eq!(some[2], "98 other axes of order 2:");
        assert_eq!(some[6], "and 92 more");
    }
}
