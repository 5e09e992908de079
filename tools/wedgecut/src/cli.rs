//! The command line of `wedgecut`.

use crate::params::{Domain, Hub, Params, Seam};
use crate::{cut, graph, names};
use kit::{Command, CommonArgs, Failure, Session, StrictArgs, ThreadArgs, WishArgs};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLES: &str = "Examples:
  symdetect gear.stl | wedgecut -v > gear.wedge.tmesh
  symdetect gear.stl | wedgecut --order 4 --to vtk -o wedge.vtk
  symdetect via.stl | wedgecut --max-volume 0.01 | tetwedge -o via.tmesh
  symdetect gear.stl | wedgecut --size-field background.vtk | tetwedge | rotassemble > gear.vtk
  symdetect fan.stl | wedgecut --domain rotation --start-angle 15 | tetwedge | rotassemble > fan.vtk
  symdetect fan.stl | wedgecut --seam between-blades.txt | tetwedge | rotassemble > fan.vtk";

/// Cut one wedge out of a symmetric body.
///
/// Reads a document that symdetect has written. The wedge reaches from one mirror plane to the next
/// (angle 180/n degrees), or, for bodies without mirror planes, over 360/n degrees with cut faces
/// that match under the rotation. Half turns about axes across the main one, rotary reflections and the mirror
/// plane across the axis make it half of that. The cut faces carry the interfaces between materials.
#[derive(clap::Parser, Debug)]
#[command(name = "wedgecut", version, after_help = EXAMPLES)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,

    /// Kind of wedge
    #[arg(long, value_enum, default_value_t)]
    domain: Domain,

    /// Order of the rotation to use, a divisor of the order found: `auto` chooses the one that is
    /// fastest to mesh without many more elements than the whole body would get
    #[arg(long, value_name = "auto|N", default_value = "auto", value_parser = order)]
    order: Order,

    /// Halve the wedge at a mirror plane across the axis, where there is one: `auto` where it pays
    #[arg(long, value_enum, default_value_t)]
    horizontal_mirror: Halving,

    /// Angle of the first cut face from the mirror direction (rotation wedges: any; mirror wedges:
    /// a multiple of 180/n)
    #[arg(long, value_name = "DEG|auto", default_value = "auto", value_parser = angle)]
    #[arg(allow_hyphen_values = true)]
    start_angle: Angle,

    /// Surface in which the sides of a rotation wedge lie: `plane`, a half plane; `auto`, one that passes between the
    /// blades where that costs fewer elements; or a file that gives its angle as a table. Each line has a distance from the
    /// axis, a height along it from the origin (model units) and an angle from the reference direction (degrees; axis
    /// and direction as symdetect reports them), linear between them; each distance comes with each height.
    /// --start-angle turns it
    #[arg(long, value_name = "plane|auto|FILE", default_value = "plane")]
    seam: PathBuf,

    /// Column around the axis that is meshed apart from the wedge, against small angles on the axis:
    /// `auto` to have one where it pays, `none`, or the radius of the circle inscribed in its
    /// polygon, in model units
    #[arg(long, value_name = "auto|none|RADIUS", default_value = "auto", value_parser = hub)]
    #[arg(allow_negative_numbers = true)]
    hub: Hub,

    /// Move points within this distance of a cut face onto it, relative to the radius about the
    /// axis [default: from the input's precision and the symmetry's residual]
    #[arg(long, value_name = "REL", value_parser = relative)]
    snap: Option<f64>,

    /// Collapse edges shorter than this, relative to the radius about the axis
    #[arg(long, value_name = "REL|off", default_value = "1e-6", value_parser = clean)]
    clean: Clean,

    // Order and hub are chosen for these; the later tools inherit them.
    #[command(flatten)]
    wishes: WishArgs,

    #[command(flatten)]
    strict: StrictArgs,

    #[command(flatten)]
    threads: ThreadArgs,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Halving {
    #[default]
    Auto,
    Off,
}

#[derive(Clone, Copy, Debug)]
struct Clean(f64);

fn clean(text: &str) -> Result<Clean, String> {
    if text == "off" {
        Ok(Clean(0.0))
    } else {
        relative(text).map(Clean)
    }
}

fn hub(text: &str) -> Result<Hub, String> {
    match text {
        "auto" => Ok(Hub::Auto),
        "none" => Ok(Hub::None),
        _ => match text.parse::<f64>() {
            Ok(radius) if radius > 0.0 && radius.is_finite() => Ok(Hub::Radius(radius)),
            _ => Err("expected `auto`, `none` or a positive radius".to_owned()),
        },
    }
}

#[derive(Clone, Copy, Debug)]
struct Order(Option<u32>);

#[derive(Clone, Copy, Debug)]
struct Angle(Option<f64>);

fn order(text: &str) -> Result<Order, String> {
    match text {
        "auto" => Ok(Order(None)),
        _ => match text.parse() {
            Ok(n) if n > 0 => Ok(Order(Some(n))),
            _ => Err("expected `auto` or a positive whole number".to_owned()),
        },
    }
}

fn angle(text: &str) -> Result<Angle, String> {
    match text {
        "auto" => Ok(Angle(None)),
        _ => match text.parse::<f64>() {
            Ok(degrees) if degrees.is_finite() => Ok(Angle(Some(degrees))),
            _ => Err("expected `auto` or an angle in degrees".to_owned()),
        },
    }
}

fn relative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (0.0..1.0).contains(&x) => Ok(x),
        _ => Err("expected a number from 0 to below 1".to_owned()),
    }
}

/// The seam asked for; a table is read.
fn seam(asked: &Path) -> Result<Seam, Failure> {
    match asked.to_str() {
        Some("plane") => return Ok(Seam::Plane),
        Some("auto") => return Ok(Seam::Auto),
        _ => {}
    }
    let bad = |what: &dyn Display| Failure::Usage(format!("--seam {}: {what}", asked.display()));
    let text = std::fs::read_to_string(asked).map_err(|error| bad(&error))?;
    let graph = graph::read(&text).map_err(|error| bad(&error))?;
    Ok(Seam::Graph(Arc::new(graph)))
}

impl Command for Cli {
    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn run(self, session: &Session) -> Result<(), Failure> {
        let params = Params {
            seam: seam(&self.seam)?,
            domain: self.domain,
            order: self.order.0,
            start_angle: self.start_angle.0.map(f64::to_radians),
            snap: self.snap,
            hub: self.hub,
            level: self.horizontal_mirror == Halving::Auto,
            clean: self.clean.0,
            threads: self.threads.count(),
        };
        session.check_output()?;
        let mut document = session.read()?;
        let notes = self.wishes.apply(&mut document)?;
        notes.iter().for_each(|note| session.note(note));
        let (mut document, report) = cut(document, &params)?;
        report.notes.iter().for_each(|note| session.info(note));
        let remarks = [
            names::lost(&document),
            report.warning,
            report.moved,
            report.differs,
        ];
        for remark in remarks.iter().flatten() {
            session.note(remark);
        }
        let short = self.strict.judge(session, &document)?;
        let notes = [report.notes, short].concat();
        document.history.push(session.history_entry(notes));
        session.write(&document)
    }
}
