//! The command line of `symdetect`.

use crate::detect::detect;
use crate::enclosure::{self, Content, Enclosure, Impossible};
use crate::error::Error;
use crate::params::Params;
use crate::redrawn::redrawn;
use crate::report::{Defects, Detection, FailureReport, Report, ReportGap, svg};
use crate::threads;
use glam::DVec3;
use heal::{Contacts, Gap, Healing, Imported, Overlap, Repairing, Solids, gaps};
use kit::{Command, CommonArgs, Failure, InputFile, Output, Session, ThreadArgs, number};
use std::io::Write;
use std::path::{Path, PathBuf};
use tmesh::{Document, MAX_TURN_DENOMINATOR, Template};

const EXAMPLES: &str = "\
Examples:
  symdetect part.stl -o part.tmesh          find the symmetry
  symdetect part.stl --report part.json     and write what was found as JSON
  symdetect part.stl --svg part.svg         and draw it; -v prints a table of all orders
  symdetect --order 12 part.stl | wedgecut  insist on order 12
  symdetect --axis 0,0,1 --center 5,0,0 part.stl
  symdetect rotor.stl magnets.stl shaft.obj -o motor.tmesh
                                            several files are one body, a region for each
  symdetect --region steel=rotor.stl --region copper=coils.obj";

/// Find the axis, order and mirror planes of a body
///
/// Reads a closed surface of one or several materials and adds its symmetry. The shape counts, not
/// the triangles it is made of: every operation reported maps every sampled point of the surface
/// to within the tolerance of the surface, interfaces between materials included.
#[derive(clap::Parser, Debug)]
#[command(name = "symdetect", version, after_help = EXAMPLES)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,

    /// Further files, which are one body with the first: a region for each file, named after it, or for each of its solids
    #[arg(value_name = "MORE")]
    more: Vec<PathBuf>,

    /// A further file, all of it one region of this name; may be repeated
    #[arg(long, value_name = "NAME=FILE", value_parser = InputFile::named)]
    region: Vec<InputFile>,

    /// Largest deviation from symmetry, relative to the radius about the axis; auto: 1e-3 and, place by place, what
    /// the facets of curved surfaces hide
    #[arg(long, value_name = "REL|auto", default_value = "auto", value_parser = tolerance)]
    tolerance: Tolerance,

    /// Whether solids of one shape are images of each other whatever their names, or every region is its own image
    #[arg(long, value_name = "exchange|keep", default_value = "exchange")]
    regions: RegionsArg,

    /// Fill the space around the body, and empty space in it, with a region named air, up to an outer boundary FACTOR times as
    /// large as the body; both have the symmetry found
    #[arg(long, value_name = "cylinder|box:FACTOR", value_parser = Enclosure::parse)]
    enclosure: Option<Enclosure>,

    /// Leave the body itself out: what goes on is the space around it, such as the passages between blades. Its outer boundary
    /// is the surfaces `enclosure-below`, `enclosure-above` and `enclosure-side` (`enclosure-ends` where the symmetry
    /// turns the axis over); the body's surfaces keep their names
    #[arg(long, requires = "enclosure")]
    fluid: bool,

    /// Direction of the axis, to be verified
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    axis: Option<DVec3>,

    /// A point on the axis, to be verified
    #[arg(long, alias = "centre", value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    center: Option<DVec3>,

    /// Verify just this order; fail if it does not hold
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_ORDER)))]
    order: Option<u32>,

    /// Highest order tried
    #[arg(long, value_name = "N", default_value_t = 1024,
          value_parser = clap::value_parser!(u32).range(2..=i64::from(MAX_ORDER)))]
    max_order: u32,

    /// Whether cracks of the surface are closed and what is there twice or has no area is dropped; off refuses such files
    #[arg(long, value_name = "auto|off", default_value = "auto")]
    repair: RepairArg,

    /// What the solids of a surface file are: its groups (STL solids, OBJ groups), where each is closed, or the closed shells of each group, as of an assembly
    /// that was written as one solid; a shell that looks inwards is a cavity of the one around it
    #[arg(long, value_name = "groups|shells", default_value = "groups")]
    solids: SolidsArg,

    /// Which of two solids keeps the space that both claim, where neither lies inside the other: the one that is listed
    /// later or earlier; refuse such files
    #[arg(long, value_name = "later|earlier|refuse", default_value = "later")]
    overlap: OverlapArg,

    /// How far apart, or into each other, faces of two solids may be that touch, model units; otherwise what the facets
    /// of curved faces explain; the narrowest gap that stays is said, and all are in the report (`gaps`)
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    contact_gap: Option<f64>,

    /// Pass a body without symmetry on as C1
    #[arg(long)]
    allow_asymmetric: bool,

    #[command(flatten)]
    threads: ThreadArgs,

    /// Write what was found as JSON
    #[arg(long, value_name = "PATH")]
    report: Option<PathBuf>,

    /// Draw what was found: the body, its axis and mirror planes, the deviation under every order
    #[arg(long, value_name = "PATH")]
    svg: Option<PathBuf>,
}

/// Values of `--regions`.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq)]
enum RegionsArg {
    Exchange,
    Keep,
}

/// Values of `--repair`.
#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum RepairArg {
    Auto,
    Off,
}

/// Values of `--solids`.
#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum SolidsArg {
    Groups,
    Shells,
}

impl From<SolidsArg> for Solids {
    fn from(arg: SolidsArg) -> Self {
        match arg {
            SolidsArg::Groups => Self::Groups,
            SolidsArg::Shells => Self::Shells,
        }
    }
}

/// Values of `--overlap`.
#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum OverlapArg {
    Later,
    Earlier,
    Refuse,
}

impl From<OverlapArg> for Overlap {
    fn from(arg: OverlapArg) -> Self {
        match arg {
            OverlapArg::Later => Self::Later,
            OverlapArg::Earlier => Self::Earlier,
            OverlapArg::Refuse => Self::Refuse,
        }
    }
}

/// Triangles up to which a surface is checked without a report being asked for. A choice: on surfaces of 336,084 and
/// 454,852 triangles, single runs with the check took about 0.5 and 0.7 s of processor time more; a run without it and
/// without a report takes 1.5 and 1.7 s. A larger limit costs such bodies that; a smaller one leaves crossings of more
/// bodies to the mesher to find.
const ALWAYS_CHECKED: usize = 200_000;
/// Half a step must still be a turn that can be stored.
const MAX_ORDER: u32 = MAX_TURN_DENOMINATOR / 4;

/// What `--tolerance` says.
#[derive(Clone, Copy, Debug)]
enum Tolerance {
    /// The default one, and what facets hide.
    Auto,
    /// This much everywhere.
    Everywhere(f64),
}

fn tolerance(text: &str) -> Result<Tolerance, String> {
    if text == "auto" {
        return Ok(Tolerance::Auto);
    }
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 0.1 => Ok(Tolerance::Everywhere(x)),
        Ok(_) => Err("a tolerance is greater than 0 and at most 0.1".to_owned()),
        Err(e) => Err(e.to_string()),
    }
}

fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x >= 0.0 && x.is_finite() => Ok(x),
        Ok(_) => Err("a length is finite and not negative".to_owned()),
        Err(e) => Err(e.to_string()),
    }
}

fn point(text: &str) -> Result<DVec3, String> {
    let parts: Vec<f64> = text
        .split(',')
        .map(|p| p.trim().parse::<f64>().map_err(|e| format!("'{p}': {e}")))
        .collect::<Result<_, _>>()?;
    match parts[..] {
        [x, y, z] if parts.iter().all(|p| p.is_finite()) => Ok(DVec3::new(x, y, z)),
        [_, _, _] => Err("the numbers must be finite".to_owned()),
        _ => Err(format!("three numbers are wanted, not {}", parts.len())),
    }
}

fn direction(text: &str) -> Result<DVec3, String> {
    point(text)?
        .try_normalize()
        .ok_or_else(|| "a direction must not be zero".to_owned())
}

impl Cli {
    fn healing(&self) -> Healing {
        Healing {
            repairing: match self.repair {
                RepairArg::Auto => Repairing::Auto(Contacts {
                    overlap: self.overlap.into(),
                    gap: self.contact_gap,
                }),
                RepairArg::Off => Repairing::Off,
            },
            solids: self.solids.into(),
        }
    }

    fn params(&self) -> Params {
        let (tolerance, facets) = match self.tolerance {
            Tolerance::Auto => (Params::default().tolerance, true),
            Tolerance::Everywhere(x) => (x, false),
        };
        Params {
            tolerance,
            facets,
            exchange: self.regions == RegionsArg::Exchange,
            axis: self.axis,
            center: self.center,
            order: self.order,
            max_order: self.max_order,
            allow_asymmetric: self.allow_asymmetric,
            profile: self.report.is_some() || self.svg.is_some() || self.common.verbose > 0,
            threads: self.threads.count(),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::NoSurface | Error::NoExtent { .. } => Self::Input(error.to_string()),
            _ => Self::Impossible(error.to_string()),
        }
    }
}

impl From<Impossible> for Failure {
    fn from(impossible: Impossible) -> Self {
        Self::Impossible(impossible.to_string())
    }
}

impl Cli {
    /// Whether what is not needed to find the symmetry is looked for.
    fn looks_around(&self, template: &Template) -> bool {
        self.report.is_some() || template.triangles.len() <= ALWAYS_CHECKED
    }

    /// Defects of the surface, where they are looked for.
    fn defects(&self, document: &Document, is_apart: bool) -> Option<Defects> {
        let [template] = document.templates.as_slice() else {
            return None;
        };
        self.looks_around(template)
            .then(|| Defects::find(template, is_apart))
    }

    /// Gaps between solids, where they are looked for, told to the user.
    fn gaps(&self, document: &Document, session: &Session) -> Vec<Gap> {
        let found = match document.templates.as_slice() {
            [template] if self.looks_around(template) => gaps(document),
            _ => Vec::new(),
        };
        if let Some(first) = found.first() {
            let ReportGap {
                regions: [one, other],
                width,
                near,
            } = ReportGap::of(first, document);
            let pairs = match found.len() {
                1 => String::new(),
                n => format!(", the narrowest of those between {n} pairs of solids"),
            };
            session.note(&format!(
                "between '{one}' and '{other}' a gap of {} stays near {}{pairs}; --contact-gap LENGTH closes gaps up to \
                 a length",
                number(width),
                kit::point(near),
            ));
        }
        found
    }

    /// Defects of the surface, where they are looked for, and its symmetry; both at the same time where threads allow.
    fn examine(
        &self,
        document: &Document,
        params: &Params,
        session: &Session,
    ) -> (Option<Defects>, Result<Detection, Error>) {
        let search = || {
            detect(document, session.joined(), params, &mut |text| {
                session.info(text)
            })
        };
        threads::with(params.threads, || {
            threads::both(|| self.defects(document, session.is_apart()), search)
        })
    }

    /// The body with interfaces drawn once, where that suits the symmetry found, which it may be farther off than the drawing.
    fn redrawn(
        document: &Document,
        found: &mut Detection,
        params: &Params,
        session: &Session,
    ) -> Option<Imported> {
        let undrawn = session.undrawn()?;
        let redrawn = threads::with(params.threads, || redrawn(document, undrawn, found, params));
        let (once, residual) = redrawn?;
        let mut off = String::new();
        if residual > found.symmetry.residual {
            off = format!("; with them, the residual is {residual:.1e}");
            found.symmetry.residual = residual;
        }
        let notices = once.notices.iter();
        let notes = notices.map(|n| format!("interfaces of curved faces are drawn once: {n}{off}"));
        found.notes.extend(notes);
        Some(once)
    }

    /// The names of the files.
    fn title(&self) -> String {
        let inputs = self.inputs();
        let names = inputs.iter().filter_map(|input| input.path.file_name());
        let names: Vec<_> = names.map(|name| name.to_string_lossy()).collect();
        match names.is_empty() {
            true => "body".to_owned(),
            false => names.join(", "),
        }
    }

    /// Writes the report of a failure; what goes wrong with that is only told.
    fn report_failure(&self, failure: &Failure, defects: &Defects, session: &Session) {
        let Some(path) = &self.report else { return };
        let report = FailureReport {
            error: failure.to_string(),
            files: session.inputs().iter().map(InputFile::label).collect(),
            defects,
            input: session.notices(),
        };
        if let Err(e) = json(&report).and_then(|text| write_text(path, &text)) {
            session.note(&e.to_string());
        }
    }
}

impl Command for Cli {
    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn inputs(&self) -> Vec<InputFile> {
        let paths = self.common.input.iter().chain(&self.more);
        let unnamed = paths.cloned().map(InputFile::unnamed);
        unnamed.chain(self.region.iter().cloned()).collect()
    }

    fn run(self, session: &Session) -> Result<(), Failure> {
        session.check_output()?;
        let params = self.params();
        let mut document = session.read_with(self.healing()).inspect_err(|failure| {
            let defects = session.odd_edges().map(Defects::of_open);
            self.report_failure(failure, &defects.unwrap_or_default(), session);
        })?;
        let (mut defects, found) = self.examine(&document, &params, session);
        let tell = |defects: Option<Defects>| {
            if let Some(defects) = &defects {
                for note in defects.notes() {
                    session.note(&note);
                }
                session.info("surface checked");
            }
            defects.unwrap_or_default()
        };
        let mut found = match found {
            Ok(found) => found,
            Err(error) => {
                let defects = tell(defects);
                self.gaps(&document, session);
                let failure = Failure::from(error);
                self.report_failure(&failure, &defects, session);
                return Err(failure);
            }
        };
        let mut once = Self::redrawn(&document, &mut found, &params, session);
        if let Some(once) = &mut once {
            document = std::mem::take(&mut once.document);
            defects = self.defects(&document, once.is_apart);
        }
        let defects = tell(defects);
        let joined = once.as_ref().and_then(|once| once.joined.as_ref());
        let joined = joined.or(session.joined());
        let gaps = self.gaps(&document, session);
        if let Some(reason) = &found.asymmetric {
            session.note(&format!("passed on as C1: {reason}"));
        }
        for note in &found.notes {
            session.note(note);
        }
        if found.asymmetric.is_none() {
            for line in found.summary() {
                session.note(&line);
            }
        }
        if session.is_verbose() {
            for line in found.table() {
                session.note(&line);
            }
        }
        let picture = (self.svg.as_ref()).map(|path| (path, svg(&document, &found, &self.title())));
        let mut symmetry = found.symmetry.clone();
        if let Some(mut enclosure) = self.enclosure {
            if self.fluid {
                enclosure.content = Content::Fluid;
            }
            let filled = enclosure::fill(&mut document, &mut symmetry, enclosure);
            let note = filled.map_err(|impossible| {
                let failure = Failure::from(impossible);
                self.report_failure(&failure, &defects, session);
                failure
            })?;
            session.note(&note);
            found.notes.push(note);
        }
        if let Some(path) = &self.report {
            write_text(
                path,
                &json(&Report::new(
                    &document,
                    &found,
                    (joined, &defects, &gaps),
                    session,
                ))?,
            )?;
        }
        if let Some((path, picture)) = picture {
            write_text(path, &picture)?;
        }
        document.symmetry = Some(symmetry);
        document.search = Some(found.search);
        document.history.push(session.history_entry(found.notes));
        session.write(&document)
    }
}

fn json(report: &impl serde::Serialize) -> Result<String, Failure> {
    serde_json::to_string_pretty(report)
        .map_err(|e| Failure::Output(format!("cannot write the report: {e}")))
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    let mut out = Output::create(Some(path), false)?;
    writeln!(out, "{text}").map_err(|e| out.failure(&e))?;
    out.commit()
}
