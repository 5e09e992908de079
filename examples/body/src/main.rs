//! Writes test bodies whose symmetry, regions and volumes are known exactly.
//!
//! ```text
//! cargo run -p body -- tsv --order 16 --thickness 5e-3 --rotate 1 -o tsv.stl
//! ```

use bodies::{
    Body, Coating, Encoding, Gear, Impeller, Placement, PracticalTsv, Prism, Ratchet, Screw,
    Tessellation, Tsv,
};
use clap::{Parser, ValueEnum};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Clone, Copy, ValueEnum)]
enum Kind {
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
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FileFormat {
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
struct Cli {
    /// What to make
    kind: Kind,

    /// File to write [default: standard output]
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,

    /// Format of the output [default: what the extension says; for .stl with several materials,
    /// ascii]
    #[arg(long, value_name = "FMT")]
    to: Option<FileFormat>,

    /// Order of the rotation: corners, teeth, blades or threads [default: 16; practical-tsv 24, gear
    /// and ratchet 12, impeller 7, screw 5]
    #[arg(long, value_name = "N")]
    order: Option<u32>,

    /// Thickness of coating, liner or each film [default: 5e-3; practical-tsv 7e-4]
    #[arg(long, value_name = "T")]
    thickness: Option<f64>,

    /// Height of the body
    #[arg(
        long,
        visible_alias = "length",
        value_name = "H",
        default_value_t = 1.0
    )]
    height: f64,

    /// Radius of the bore, 0 for none [default: ring 0.5, gear and ratchet 0.3, others 0]
    #[arg(long, value_name = "R")]
    bore: Option<f64>,

    /// Thickness of a second material that lines the bore of a ratchet or screw, 0 for none
    #[arg(long, value_name = "T", default_value_t = 0.0)]
    coating: f64,

    /// Radius of a via's core or hole [default: tsv 0.2; practical-tsv 0.05, or what ten films fill]
    #[arg(long, value_name = "R")]
    core: Option<f64>,

    /// Twist of impeller or screw from bottom to top, degrees
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 30.0,
        allow_negative_numbers = true
    )]
    twist: f64,

    /// Films of practical-tsv, or levels of facets of impeller or screw [default: 6]
    #[arg(long, value_name = "N", default_value_t = 6)]
    layers: u32,

    /// Facets around each level of the screw, at least; each has up to a quarter more
    #[arg(long, value_name = "N", default_value_t = 150)]
    facets: u32,

    /// Turn and shift the body at random; the same seed gives the same placement
    #[arg(long, value_name = "SEED")]
    rotate: Option<u64>,

    /// Multiply all coordinates
    #[arg(long, value_name = "S", default_value_t = 1.0)]
    scale: f64,

    /// Displace every vertex at random by up to this much along each axis
    #[arg(long, value_name = "D", default_value_t = 0.0)]
    jitter: f64,

    /// Split flat parts differently from sector to sector
    #[arg(long)]
    asymmetric_tessellation: bool,

    /// Split all quadrilaterals by a random choice, bent ones too, so that the shape as drawn is only
    /// nearly symmetric; of the screw: draw other facets
    #[arg(long, value_name = "SEED", conflicts_with = "asymmetric_tessellation")]
    redraw: Option<u64>,

    /// Digits after the point in ASCII STL [default: all that a double has]
    #[arg(long, value_name = "D")]
    digits: Option<usize>,

    /// Write order, mirrors and volumes as JSON
    #[arg(long, value_name = "PATH")]
    volumes: Option<PathBuf>,

    /// Say the volume of each region on standard error
    #[arg(short, long)]
    verbose: bool,
}

impl Cli {
    fn order(&self) -> u32 {
        self.order.unwrap_or(match self.kind {
            Kind::PracticalTsv => 24,
            Kind::Gear | Kind::Ratchet => 12,
            Kind::Impeller => 7,
            Kind::Screw => 5,
            Kind::Prism | Kind::Ring | Kind::Tsv | Kind::Cube => 16,
        })
    }

    fn body(&self) -> Result<Body, String> {
        let order = self.order();
        let least = match self.kind {
            Kind::Gear | Kind::Ratchet | Kind::Screw => 2,
            _ => 3,
        };
        if !(least..=1000).contains(&order) {
            return Err(format!("--order {order} is not between {least} and 1000"));
        }
        let positive = [self.height, self.scale, self.thickness.unwrap_or(1.0)];
        if !positive.iter().all(|x| x.is_finite() && *x > 0.0) {
            return Err("--height, --scale and --thickness must be positive".to_owned());
        }
        if self.layers == 0 {
            return Err("--layers must be positive".to_owned());
        }
        let tessellation = match (self.redraw, self.asymmetric_tessellation) {
            (Some(seed), _) => Tessellation::Redrawn(seed),
            (None, true) => Tessellation::Asymmetric,
            (None, false) => Tessellation::Symmetric,
        };
        let (radius, height) = (1.0, self.height);
        // Flat-to-flat lengths of the sections have to leave room for each other.
        let flat = (std::f64::consts::PI / f64::from(order)).cos();
        let within = |name: &str, value: f64, low: f64, high: f64| {
            if low <= value && value < high {
                Ok(value)
            } else {
                Err(format!("{name} {value} is not in [{low}, {high})"))
            }
        };
        Ok(match self.kind {
            Kind::Prism => {
                let bore = within("--bore", self.bore.unwrap_or(0.0), 0.0, radius)?;
                Prism {
                    order,
                    radius,
                    height,
                    bore,
                    tessellation,
                }
                .build()
            }
            Kind::Ring => {
                let thickness = self.thickness.unwrap_or(5e-3);
                let bore = self.bore.unwrap_or(0.5);
                within(
                    "--bore plus --thickness",
                    bore + thickness / flat,
                    thickness,
                    radius,
                )?;
                Coating {
                    order,
                    radius,
                    bore,
                    thickness,
                    height,
                    tessellation,
                }
                .build()
            }
            Kind::Tsv => {
                let thickness = self.thickness.unwrap_or(5e-3);
                let core = self.core.unwrap_or(0.2);
                within(
                    "--core plus --thickness",
                    core + thickness / flat,
                    thickness,
                    radius,
                )?;
                Tsv {
                    order,
                    radius,
                    core,
                    thickness,
                    height,
                    tessellation,
                }
                .build()
            }
            Kind::PracticalTsv => {
                let thickness = self.thickness.unwrap_or(7e-4);
                let core = self.core.unwrap_or((10.0 * thickness).clamp(0.05, 0.5));
                let hole = within("--core", core, 0.0, radius)?;
                let films = thickness * f64::from(self.layers);
                within("the films' thickness", films, 0.0, height.min(hole * flat))?;
                PracticalTsv {
                    order,
                    radius,
                    hole,
                    thickness,
                    layers: self.layers,
                    height,
                    tessellation,
                }
                .build()
            }
            Kind::Gear => {
                let bore = within("--bore", self.bore.unwrap_or(0.3), 0.0, Gear::ROOT)?;
                Gear {
                    order,
                    radius,
                    bore,
                    height,
                    tessellation,
                }
                .build()
            }
            Kind::Ratchet => {
                let bore = within("--bore", self.bore.unwrap_or(0.3), 0.0, Ratchet::ROOT)?;
                let coating = match self.coating {
                    0.0 => 0.0,
                    t if bore > 0.0 => within("--coating", t, 0.0, Ratchet::ROOT - bore)?,
                    _ => return Err("--coating needs a --bore".to_owned()),
                };
                Ratchet {
                    order,
                    radius,
                    bore,
                    coating,
                    height,
                    tessellation,
                }
                .build()
            }
            Kind::Impeller => {
                let room = Impeller::HUB * Impeller::TOP;
                let bore = within("--bore", self.bore.unwrap_or(0.0), 0.0, room)?;
                let level = (self.twist / f64::from(self.layers)).abs();
                // Facets of one level must not turn past their neighbours.
                within(
                    "the twist per level, in degrees,",
                    level,
                    0.0,
                    0.5 * 360.0 / f64::from(order),
                )?;
                Impeller {
                    order,
                    radius,
                    bore,
                    height,
                    twist: self.twist.to_radians(),
                    layers: self.layers,
                    tessellation,
                }
                .build()
            }
            Kind::Screw => {
                let bore = within("--bore", self.bore.unwrap_or(0.3), 0.0, Screw::LEAST)?;
                let coating = match self.coating {
                    0.0 => 0.0,
                    t if bore > 0.0 => within("--coating", t, 0.0, Screw::LEAST - bore)?,
                    _ => return Err("--coating needs a --bore".to_owned()),
                };
                // A level's facets must not be taken for those of the next thread.
                let facets = within(
                    "--facets",
                    f64::from(self.facets),
                    f64::from(4 * order),
                    1e6,
                )?;
                Screw {
                    order,
                    radius,
                    bore,
                    coating,
                    height,
                    twist: self.twist.to_radians(),
                    layers: self.layers,
                    facets: facets as u32,
                    drawing: self.redraw.unwrap_or(0),
                }
                .build()
            }
            Kind::Cube => bodies::cube(height, tessellation),
        })
    }

    fn encoding(&self, body: &Body) -> Result<Encoding, String> {
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

fn volumes_json(body: &Body) -> serde_json::Value {
    let regions: Vec<_> = body
        .materials
        .iter()
        .enumerate()
        .map(|(i, m)| serde_json::json!({"name": m.name, "volume": body.volume(i)}))
        .collect();
    serde_json::json!({
        "order": body.order,
        "mirror": body.mirror,
        "volume": body.total_volume(),
        "regions": regions,
    })
}

fn run(cli: &Cli) -> Result<(), (u8, String)> {
    let usage = |text| (2, text);
    let mut body = cli.body().map_err(usage)?;
    let placement = Placement {
        rotate: cli.rotate,
        scale: cli.scale,
        jitter: cli.jitter,
    };
    placement.apply(&mut body);
    let encoding = cli.encoding(&body).map_err(usage)?;
    let written = |e: io::Error| match e.kind() {
        io::ErrorKind::Unsupported => (2, e.to_string()),
        _ => (4, format!("cannot write: {e}")),
    };
    let mut out: Box<dyn Write> = match &cli.output {
        Some(path) => Box::new(File::create(path).map_err(written)?),
        None => Box::new(io::stdout()),
    };
    let mut buffer = BufWriter::new(&mut out);
    bodies::write(&body, encoding, &mut buffer).map_err(written)?;
    buffer.flush().map_err(written)?;
    if let Some(path) = &cli.volumes {
        let text = format!("{:#}\n", volumes_json(&body));
        std::fs::write(path, text).map_err(written)?;
    }
    if cli.verbose {
        for (index, material) in body.materials.iter().enumerate() {
            eprintln!("{:e} {}", body.volume(index), material.name);
        }
    }
    Ok(())
}

fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err((code, text)) => {
            eprintln!("body: error: {text}");
            ExitCode::from(code)
        }
    }
}
