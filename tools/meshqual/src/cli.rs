//! The command line of `meshqual`.

use crate::{Bound, Error, Limit, Params, Pictures, Report, analyse, html, svg, text};
use interchange::Format;
use kit::{Command, CommonArgs, Failure, Output, Session, StrictArgs};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Measures tetrahedral meshes and checks what an assembled mesh promises
///
/// Reads a mesh and writes a report: sizes, regions, statistics and histograms of the quality
/// metrics, and the state of the checks. Documents of instances are measured and checked as the mesh
/// they stand for, without being expanded. The mesh itself is not passed on.
#[derive(clap::Parser, Debug)]
#[command(name = "meshqual", version, after_long_help = AFTER)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,

    /// A second input, which is refused with what was meant
    #[arg(hide = true)]
    second: Option<PathBuf>,

    /// Write the report as JSON; `-` writes it in place of the text
    #[arg(long, value_name = "PATH")]
    json: Option<PathBuf>,

    /// Write the histograms as an SVG image; `-` writes it in place of the text
    #[arg(long, value_name = "PATH")]
    svg: Option<PathBuf>,

    /// Write the report as a page with tables, histograms and pictures of the mesh; `-` writes it in
    /// place of the text
    #[arg(long, value_name = "PATH")]
    html: Option<PathBuf>,

    /// Worst elements to list per metric, with their places
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(0..=1000))]
    worst: u32,

    /// Bins per histogram
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    bins: u32,

    /// A second mesh, measured beside the first
    #[arg(long, value_name = "OTHER")]
    compare: Option<PathBuf>,

    /// Exit with 1 if a promise of assembled meshes is broken, and say which ones there is nothing to check against
    #[arg(long)]
    check: bool,

    /// Exit with 1 if a statistic is below a value: METRIC=VALUE tests the minimum,
    /// METRIC.STATISTIC=VALUE another one (min, max, mean, p01, p50, p99); may be repeated
    #[arg(long, value_name = "METRIC=VALUE", value_parser = below)]
    fail_below: Vec<Limit>,

    /// The same for values above; METRIC=VALUE tests the maximum
    #[arg(long, value_name = "METRIC=VALUE", value_parser = above)]
    fail_above: Vec<Limit>,

    /// Count what is below a value; may be repeated
    #[arg(long, value_name = "METRIC=VALUE", value_parser = count_below)]
    count_below: Vec<Bound>,

    /// Count what is above a value; may be repeated
    #[arg(long, value_name = "METRIC=VALUE", value_parser = count_above)]
    count_above: Vec<Bound>,

    #[command(flatten)]
    strict: StrictArgs,
}

const AFTER: &str = "\
Metrics:
  radius_edge_ratio  radius of the circumscribed sphere over the shortest edge (regular: 0.612)
  min_dihedral_deg   smallest dihedral angle, degrees (regular: 70.53)
  max_dihedral_deg   largest dihedral angle, degrees (regular: 70.53)
  aspect_ratio       longest edge over 2 sqrt(6) times the inscribed radius (regular: 1)
  edge_length        each tetrahedron counts its six edges
  volume             signed volume

Percentiles are exact: values that occur (nearest rank).

Examples:
  meshqual mesh.vtk
  symdetect part.stl | wedgecut | tetwedge | meshqual --check
  meshqual --check --json report.json --svg report.svg part.tmesh
  meshqual --fail-below min_dihedral_deg.p01=13 --fail-above radius_edge_ratio.p99=1.4 part.tmesh
  meshqual --count-above radius_edge_ratio=1.4 --count-below min_dihedral_deg=10 part.tmesh
  meshqual --compare direct.vtk part.vtk
  meshqual --html report.html --worst 5 part.tmesh

Bounds that were asked of the elements travel in the document. What does not meet them is said on
standard error, and fails with --strict.

Exit status: 0 done, 1 a promise or a limit is broken or, with --strict, a bound not met (the report is
written all the same), 2 wrong usage, 3 malformed input, 4 output not writable.";

fn below(text: &str) -> Result<Limit, String> {
    Limit::parse(text, false)
}

fn above(text: &str) -> Result<Limit, String> {
    Limit::parse(text, true)
}

fn count_below(text: &str) -> Result<Bound, String> {
    Bound::parse(text, false)
}

fn count_above(text: &str) -> Result<Bound, String> {
    Bound::parse(text, true)
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::TooLarge { .. } | Error::Picture(_) => Self::Impossible(error.to_string()),
            Error::Invalid(_) | Error::Empty => Self::Input(error.to_string()),
        }
    }
}

impl Command for Cli {
    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn run(self, session: &Session) -> Result<(), Failure> {
        self.check_outputs()?;
        let params = Params {
            bins: self.bins as usize,
            limits: [self.fail_below.clone(), self.fail_above.clone()].concat(),
            bounds: [self.count_below.clone(), self.count_above.clone()].concat(),
            worst: self.worst as usize,
        };
        let document = session.read()?;
        let other = match &self.compare {
            Some(path) => Some((path.display().to_string(), session.read_other(path)?)),
            None => None,
        };
        let other = other
            .as_ref()
            .map(|(name, document)| (name.as_str(), document));
        let report = analyse(&document, other, &params)?;
        session.info("measured and checked");
        let pictures = self.html.as_ref().map(|_| Pictures::of(&document));
        let pictures = pictures.transpose()?;
        self.strict.say_if_unknown(session, &document);
        drop(document);
        self.write(&report, pictures.as_ref())?;
        let mut failures = report.failures(self.check);
        if self.strict.strict {
            failures.extend(report.shortfalls);
        } else {
            report
                .shortfalls
                .iter()
                .for_each(|short| session.note(short));
        }
        match failures.as_slice() {
            [] => Ok(()),
            [one] => Err(Failure::Impossible(one.clone())),
            [first, rest @ ..] => Err(Failure::Impossible(format!(
                "{first} (and {} more, see the report)",
                rest.len()
            ))),
        }
    }
}

fn is_dash(path: Option<&Path>) -> bool {
    path == Some(Path::new("-"))
}

impl Cli {
    fn check_outputs(&self) -> Result<(), Failure> {
        if let Some(second) = &self.second {
            return Err(Failure::Usage(format!(
                "one mesh is measured; --compare {} measures a second one beside it",
                second.display()
            )));
        }
        if self.common.to.is_some_and(|f| f != Format::Text) {
            return Err(Failure::Usage(
                "the output is a report, not a mesh; use --json, --svg or --html PATH for other forms"
                    .to_owned(),
            ));
        }
        let forms = [&self.json, &self.svg, &self.html];
        if forms.iter().filter(|p| is_dash(p.as_deref())).count() > 1 {
            return Err(Failure::Usage(
                "only one of --json, --svg and --html can go to standard output".to_owned(),
            ));
        }
        Ok(())
    }

    /// Writes all parts, then makes the files appear.
    fn write(&self, report: &Report, pictures: Option<&Pictures>) -> Result<(), Failure> {
        let mut done = Vec::new();
        let main = self.common.output.as_deref();
        let (json, svg_path) = (self.json.as_deref(), self.svg.as_deref());
        let html_path = self.html.as_deref();
        let title = match &self.common.input {
            Some(path) => path.display().to_string(),
            None => "standard input".to_owned(),
        };
        if let Some(path) = json {
            let path = if is_dash(json) { main } else { Some(path) };
            done.push(put(path, &to_json(report)?)?);
        }
        if let Some(path) = svg_path {
            let path = if is_dash(svg_path) { main } else { Some(path) };
            done.push(put(path, &svg(report, &title))?);
        }
        if let (Some(path), Some(pictures)) = (html_path, pictures) {
            let path = if is_dash(html_path) { main } else { Some(path) };
            done.push(put(path, &html(report, &title, pictures))?);
        }
        if ![json, svg_path, html_path].into_iter().any(is_dash) {
            done.push(put(main, &text(report, self.check))?);
        }
        done.into_iter().try_for_each(Output::commit)
    }
}

fn put(path: Option<&Path>, text: &str) -> Result<Output, Failure> {
    let mut out = Output::create(path, false)?;
    out.write_all(text.as_bytes())
        .map_err(|e| out.failure(&e))?;
    Ok(out)
}

fn to_json(report: &Report) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(report)
        .map_err(|e| Failure::Output(format!("cannot form the JSON report: {e}")))?;
    Ok(text + "\n")
}
