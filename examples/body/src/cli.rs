//! The command line.

use bodies::{Body, Encoding};
use clap::{Parser, ValueEnum};
use std::path::{Path, PathBuf};

#[derive(Clone, Copy, ValueEnum)]
pub enum Kind {
    /// Right prism over a regular polygon, one material
    Prism,
    /// Prism with a hole and a thin coating inside, two materials
    Ring,
    /// Filled via: core, thin liner, surroundings; three materials
    Tsv,
    /// Open via with thin films on wall and floor of the hole; a material each
    PracticalTsv,
    /// Spur gear; mirror planes contain the axis
    Gear,
    /// Wheel with saw teeth; rotations only
    Ratchet,
    /// Hub with twisted blades; rotations only
    Impeller,
    /// Tapered screw with rounded threads, drawn with facets that do not share its symmetry;
    /// rotations only
    Screw,
    /// Axis-aligned cube
    Cube,
    /// Bar of rectangular section, twisted: D2, of a square one D4
    TwistedBar,
    /// Gear, twisted: D_n
    HelicalGear,
    /// Antiprism: D_nd
    Antiprism,
    /// Wheel with teeth on its faces, above and below by turns: S_2n
    Alternating,
    /// Wheel with saw teeth around it, drawn with a horizontal mirror: C_nh
    SawWheel,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FileFormat {
    /// Binary STL (single precision, one material)
    Stl,
    /// ASCII STL, one solid per material
    Ascii,
    /// Wavefront OBJ, one group per material
    Obj,
    /// TetGen piecewise linear complex with region seeds
    Poly,
    /// The pipe's own document
    Tmesh,
}

/// Write a test body whose symmetry, regions and volumes are known exactly.
///
/// Lengths are in units of the outer radius, before --scale.
#[derive(Parser)]
pub struct Cli {
    /// What to make
    pub kind: Kind,

    /// File to write [default: standard output]
    #[arg(short, long, value_name = "PATH")]
    pub output: Option<PathBuf>,

    /// Format of the output [default: what the extension says; for .stl with several materials,
    /// ascii]
    #[arg(long, value_name = "FMT")]
    pub to: Option<FileFormat>,

    /// Order of the rotation: corners, teeth, blades or threads [default: 16; practical-tsv 24, gear,
    /// ratchet and saw-wheel 12, impeller and antiprism 7, screw 5, alternating 4]
    #[arg(long, value_name = "N")]
    pub order: Option<u32>,

    /// Thickness of coating, liner or each film [default: 5e-3; practical-tsv 7e-4]
    #[arg(long, value_name = "T")]
    pub thickness: Option<f64>,

    /// Height of the body
    #[arg(
        long,
        visible_alias = "length",
        value_name = "H",
        default_value_t = 1.0
    )]
    pub height: f64,

    /// Radius of the bore, 0 for none [default: ring 0.5; gears, ratchet, screw and wheels 0.3; others 0]
    #[arg(long, value_name = "R")]
    pub bore: Option<f64>,

    /// Thickness of a second material that lines the bore of a ratchet or screw, 0 for none
    #[arg(long, value_name = "T", default_value_t = 0.0)]
    pub coating: f64,

    /// Radius of a via's core or hole [default: tsv 0.2; practical-tsv 0.05, or what ten films fill]
    #[arg(long, value_name = "R")]
    pub core: Option<f64>,

    /// Width relative to the depth of a twisted bar's section; 1 for a square
    #[arg(long, value_name = "A", default_value_t = 2.0)]
    pub aspect: f64,

    /// Twist of impeller, screw, bar or gear from bottom to top, degrees
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 30.0,
        allow_negative_numbers = true
    )]
    pub twist: f64,

    /// Films of practical-tsv, or levels of facets of twisted bodies [default: 6]
    #[arg(long, value_name = "N", default_value_t = 6)]
    pub layers: u32,

    /// Facets around each level of the screw, at least; each has up to a quarter more
    #[arg(long, value_name = "N", default_value_t = 150)]
    pub facets: u32,

    /// Turn and shift the body at random; the same seed gives the same placement
    #[arg(long, value_name = "SEED")]
    pub rotate: Option<u64>,

    /// Multiply all coordinates
    #[arg(long, value_name = "S", default_value_t = 1.0)]
    pub scale: f64,

    /// Displace every vertex at random by up to this much along each axis
    #[arg(long, value_name = "D", default_value_t = 0.0)]
    pub jitter: f64,

    /// Bend flat faces by up to this angle, degrees, at points, lines and corners chosen at random, alike in all
    /// images
    #[arg(long, value_name = "DEG", conflicts_with_all = ["asymmetric_tessellation", "redraw"])]
    pub bend: Option<f64>,

    /// Seed of what is bent
    #[arg(long, value_name = "SEED", default_value_t = 0, requires = "bend")]
    pub bend_seed: u64,

    /// Split flat parts differently from sector to sector
    #[arg(long)]
    pub asymmetric_tessellation: bool,

    /// Split all quadrilaterals by a random choice, bent ones too, so that the shape as drawn is only
    /// nearly symmetric; of the screw: draw other facets
    #[arg(long, value_name = "SEED", conflicts_with = "asymmetric_tessellation")]
    pub redraw: Option<u64>,

    /// Digits after the point in ASCII STL [default: all that a double has]
    #[arg(long, value_name = "D")]
    pub digits: Option<usize>,

    /// Write order, mirrors and volumes as JSON
    #[arg(long, value_name = "PATH")]
    pub volumes: Option<PathBuf>,

    /// Say the volume of each region on standard error
    #[arg(short, long)]
    pub verbose: bool,
}

impl Cli {
    /// The encoding of the output.
    pub fn encoding(&self, body: &Body) -> Result<Encoding, String> {
        let ascii = Encoding::StlAscii {
            digits: self.digits,
        };
        let extension = self
            .output
            .as_deref()
            .and_then(Path::extension)
            .map(|e| e.to_string_lossy().to_lowercase());
        Ok(match (self.to, extension.as_deref()) {
            (Some(FileFormat::Stl), _) => Encoding::StlBinary,
            (Some(FileFormat::Ascii), _) => ascii,
            (Some(FileFormat::Obj), _) | (None, Some("obj")) => Encoding::Obj,
            (Some(FileFormat::Poly), _) | (None, Some("poly")) => Encoding::Poly,
            (Some(FileFormat::Tmesh), _) | (None, Some("tmesh")) => Encoding::Tmesh,
            (None, None | Some("stl")) if body.materials.len() > 1 || self.digits.is_some() => {
                ascii
            }
            (None, None | Some("stl")) => Encoding::StlBinary,
            (None, Some(other)) => return Err(format!("unknown extension .{other}; use --to")),
        })
    }
}
