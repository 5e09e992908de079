//! Draws the surface of documents side by side as an SVG image.
//!
//! ```text
//! cargo run -p picture -- part.sym.tmesh wedge:part.tet.tmesh part.tet.tmesh -o part.svg
//! ```

use clap::Parser;
use glam::{DMat3, DVec3};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;
use std::process::ExitCode;
use tmesh::{Document, OUTSIDE};

/// Width and height of one panel, pixels.
const PANEL: f64 = 300.0;
/// Share of a panel that the drawing takes.
const FILL: f64 = 0.94;
/// Colours of the first regions, of unmirrored and mirrored copies.
const COLOURS: [[[f64; 3]; 2]; 4] = [
    [[92.0, 142.0, 196.0], [126.0, 172.0, 218.0]],
    [[226.0, 190.0, 92.0], [240.0, 212.0, 134.0]],
    [[206.0, 116.0, 74.0], [224.0, 146.0, 106.0]],
    [[128.0, 176.0, 112.0], [160.0, 200.0, 144.0]],
];

/// Colour of both faces of a seam.
const SEAM: [f64; 3] = [238.0, 176.0, 80.0];

/// Draw the surface of documents side by side as an SVG image.
///
/// Colours tell regions apart, shades of them copies of the wedge and their mirror images. Seams of a wedge have a colour of
/// their own.
#[derive(Parser)]
struct Cli {
    /// Documents (tmesh); `wedge:PATH` draws one copy of each template, with its walls
    #[arg(required = true)]
    panels: Vec<String>,

    /// File to write
    #[arg(short, long, value_name = "PATH")]
    output: PathBuf,

    /// Height of the eye above the horizon of the canonical frame, degrees
    #[arg(long, default_value_t = 40.0, allow_negative_numbers = true)]
    elevation: f64,

    /// Direction of the eye around the axis, degrees
    #[arg(long, default_value_t = -60.0, allow_negative_numbers = true)]
    azimuth: f64,
}

/// A triangle seen from the eye: x to the right, y up, z towards the eye.
struct Facet {
    corners: [DVec3; 3],
    colour: [f64; 3],
}

fn facets(document: &Document, wedge: bool, view: DMat3) -> Vec<Facet> {
    let mut facets = Vec::new();
    // Canonical coordinates throughout: the axis points up wherever the body lies.
    let mut drawn = BTreeSet::new();
    for instance in &document.instances {
        if wedge && !drawn.insert(instance.template) {
            continue;
        }
        let template = &document.templates[instance.template as usize];
        let walls: BTreeSet<u32> = match wedge {
            true => BTreeSet::new(),
            false => template
                .gluings
                .iter()
                .flat_map(|g| g.triangles_of(0))
                .collect(),
        };
        let seams = template.gluings.iter().filter(|g| g.is_seam(0));
        let seams: BTreeSet<u32> = seams.flat_map(|g| g.triangles_of(0)).collect();
        let placed = instance.isometry.placed();
        for (index, triangle) in template.triangles.iter().enumerate() {
            let inner = triangle.front != OUTSIDE && triangle.back != OUTSIDE;
            if inner || walls.contains(&(index as u32)) {
                continue;
            }
            let [a, b, c] = triangle
                .vertices
                .map(|v| view * placed.apply(template.vertices[v as usize]));
            let inward = (triangle.back == OUTSIDE) != instance.isometry.reverses_orientation();
            let corners = if inward { [a, c, b] } else { [a, b, c] };
            let region = triangle.front.min(triangle.back);
            let place = document.regions.iter().position(|r| r.id == region);
            let colours = COLOURS[place.unwrap_or(0) % COLOURS.len()];
            facets.push(Facet {
                corners,
                colour: match seams.contains(&(index as u32)) {
                    true => SEAM,
                    false => colours[usize::from(instance.isometry.mirrored())],
                },
            });
        }
    }
    facets
}

/// Draws facets into a square whose left edge is at `left`.
fn draw(mut facets: Vec<Facet>, left: f64, out: &mut String) {
    let normal = |f: &Facet| {
        let [a, b, c] = f.corners;
        (b - a).cross(c - a).normalize_or_zero()
    };
    facets.retain(|f| normal(f).z > 1e-9);
    let depth = |f: &Facet| f.corners.iter().map(|p| p.z).sum::<f64>();
    facets.sort_by(|f, g| depth(f).total_cmp(&depth(g)));
    let points = facets.iter().flat_map(|f| f.corners);
    let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| {
        (l.min(p), h.max(p))
    });
    let size = (high - low).truncate().max_element();
    let middle = 0.5 * (low + high);
    let light = DVec3::new(-0.35, 0.5, 0.8).normalize();
    for facet in &facets {
        let shade = 0.55 + 0.45 * normal(facet).dot(light).max(0.0);
        let [r, g, b] = facet.colour.map(|c| (c * shade).round() as u8);
        out.push_str("<path d=\"");
        for (command, p) in ["M", "L", "L"].iter().zip(facet.corners) {
            let q = (p - middle) * (FILL * PANEL / size);
            let (x, y) = (left + 0.5 * PANEL + q.x, 0.5 * PANEL - q.y);
            write!(out, "{command}{x:.1} {y:.1}").expect("text");
        }
        writeln!(out, "z\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>").expect("text");
    }
}

fn run(cli: &Cli) -> Result<(), String> {
    let (elevation, azimuth) = (cli.elevation.to_radians(), cli.azimuth.to_radians());
    let eye = DVec3::new(
        elevation.cos() * azimuth.cos(),
        elevation.cos() * azimuth.sin(),
        elevation.sin(),
    );
    let right = DVec3::new(-azimuth.sin(), azimuth.cos(), 0.0);
    let view = DMat3::from_cols(right, eye.cross(right), eye).transpose();
    let width = PANEL * cli.panels.len() as f64;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{PANEL}\" \
         viewBox=\"0 0 {width} {PANEL}\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <g stroke=\"#20303c\" stroke-width=\"0.35\" stroke-linejoin=\"round\">\n"
    );
    for (index, panel) in cli.panels.iter().enumerate() {
        let (wedge, path) = match panel.strip_prefix("wedge:") {
            Some(path) => (true, path),
            None => (false, panel.as_str()),
        };
        let file = File::open(path).map_err(|e| format!("{path}: {e}"))?;
        let document = tmesh::read(BufReader::new(file)).map_err(|e| format!("{path}: {e}"))?;
        draw(
            facets(&document, wedge, view),
            PANEL * index as f64,
            &mut svg,
        );
    }
    svg.push_str("</g>\n</svg>\n");
    std::fs::write(&cli.output, svg).map_err(|e| format!("{}: {e}", cli.output.display()))
}

fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(text) => {
            eprintln!("picture: error: {text}");
            ExitCode::FAILURE
        }
    }
}
