//! The command line of `tetwedge`.

use crate::{DEFAULT_OPTIMIZE, Params, RegionSize, tetrahedralize, volume_of_edge};
use kit::{Command, CommonArgs, Failure, Session};
use std::time::Duration;

/// Fills a wedge, or any closed surface, with tetrahedra
///
/// The mesher is TetGen. Mirror walls may be refined; seams and walls shared with other templates
/// are kept as they are. Regions come from the surface's triangles.
#[derive(clap::Parser, Debug)]
#[command(
    name = "tetwedge",
    version,
    after_help = "Examples:\n  \
        symdetect a.stl | wedgecut | tetwedge | rotassemble > a.vtk\n  \
        tetwedge wedge.tmesh --max-volume 0.01 --region copper:max-volume=1e-4 -o meshed.tmesh\n  \
        tetwedge -v --timeout 60 --edge-length 0.05 wedge.tmesh -o meshed.tmesh"
)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,

    /// Largest ratio of circumradius to shortest edge of a tetrahedron
    #[arg(long, value_name = "R", default_value = "1.4", allow_negative_numbers = true, value_parser = radius_edge)]
    radius_edge: f64,

    /// Smallest dihedral angle, degrees
    #[arg(long, value_name = "DEG", default_value = "10", allow_negative_numbers = true, value_parser = min_dihedral)]
    min_dihedral: f64,

    /// Largest tetrahedron volume, model units cubed
    #[arg(long, value_name = "V", allow_negative_numbers = true, value_parser = positive, conflicts_with = "edge_length")]
    max_volume: Option<f64>,

    /// Largest tetrahedron volume, as that of the regular tetrahedron with this edge
    #[arg(long, value_name = "H", allow_negative_numbers = true, value_parser = positive)]
    edge_length: Option<f64>,

    /// Largest tetrahedron volume in one region, by its name or id; repeatable
    #[arg(long, value_name = "NAME:max-volume=V", value_parser = region_size)]
    region: Vec<RegionSize>,

    /// Dihedral angle, degrees, above which tetrahedra are optimized away, at some cost in radius-edge
    /// ratio and volume limits; `off` removes only the nearly flat ones
    #[arg(long, value_name = "DEG|off", value_parser = optimize, default_value_t = Optimize(Some(DEFAULT_OPTIMIZE)))]
    optimize: Optimize,

    /// A plain constrained tetrahedralization: no quality bounds, no optimization
    #[arg(long)]
    no_quality: bool,

    /// TetGen switches to append to ours
    #[arg(long, value_name = "STR", default_value = "", value_parser = switches, allow_hyphen_values = true, hide_default_value = true)]
    switches: String,

    /// Time limit for the mesher, per template [default: none]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    timeout: Option<f64>,

    /// Templates meshed at the same time [default: processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

#[derive(Clone, Copy, Debug)]
struct Optimize(Option<f64>);

impl std::fmt::Display for Optimize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(angle) => write!(f, "{angle}"),
            None => f.write_str("off"),
        }
    }
}

/// Dihedral angle of the regular tetrahedron, degrees: no tetrahedron's smallest one is larger, nor
/// its largest one smaller.
const REGULAR_DIHEDRAL: f64 = 70.528_779_365_509_31;

/// Radius-edge ratio of the regular tetrahedron, the smallest there is.
const REGULAR_RADIUS_EDGE: f64 = 0.612_372_435_695_794_5;

/// Appended switches may be this long; TetGen keeps them in a small buffer.
const LONGEST_SWITCHES: usize = 200;

fn number(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err("not a finite number".to_owned()),
    }
}

fn positive(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if x > 0.0 {
        Ok(x)
    } else {
        Err("must be above 0".to_owned())
    }
}

fn radius_edge(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if x > REGULAR_RADIUS_EDGE {
        Ok(x)
    } else {
        Err(format!(
            "must be above {REGULAR_RADIUS_EDGE:.3}, the ratio of the regular tetrahedron"
        ))
    }
}

fn min_dihedral(text: &str) -> Result<f64, String> {
    let x = number(text)?;
    if (0.0..REGULAR_DIHEDRAL).contains(&x) {
        Ok(x)
    } else {
        Err(format!(
            "must be at least 0 and below {REGULAR_DIHEDRAL:.2}, the angle of the regular tetrahedron"
        ))
    }
}

fn optimize(text: &str) -> Result<Optimize, String> {
    if text == "off" {
        return Ok(Optimize(None));
    }
    let x = number(text)?;
    if x > REGULAR_DIHEDRAL && x < 180.0 {
        Ok(Optimize(Some(x)))
    } else {
        Err(format!(
            "must be between {REGULAR_DIHEDRAL:.2} and 180, or off"
        ))
    }
}

fn region_size(text: &str) -> Result<RegionSize, String> {
    let Some((region, volume)) = text.rsplit_once(":max-volume=") else {
        return Err("expected NAME:max-volume=V".to_owned());
    };
    if region.is_empty() {
        return Err("the region's name is missing".to_owned());
    }
    Ok(RegionSize {
        region: region.to_owned(),
        max_volume: positive(volume)?,
    })
}

fn switches(text: &str) -> Result<String, String> {
    let text = text.trim().trim_start_matches('-');
    if text.len() > LONGEST_SWITCHES {
        return Err(format!("longer than {LONGEST_SWITCHES} characters"));
    }
    if let Some(odd) = text.chars().find(|c| !c.is_ascii_graphic()) {
        return Err(format!("{odd:?} is not part of a TetGen switch"));
    }
    Ok(text.to_owned())
}

impl Cli {
    fn params(&self) -> Params {
        Params {
            quality: !self.no_quality,
            radius_edge: self.radius_edge,
            min_dihedral: self.min_dihedral,
            optimize: self.optimize.0,
            max_volume: self.max_volume.or(self.edge_length.map(volume_of_edge)),
            region_sizes: self.region.clone(),
            switches: self.switches.clone(),
            // Longer than the universe is as good as none.
            timeout: self
                .timeout
                .and_then(|s| Duration::try_from_secs_f64(s).ok()),
            threads: self.threads.map_or_else(
                || std::thread::available_parallelism().map_or(1, usize::from),
                usize::from,
            ),
        }
    }
}

impl Command for Cli {
    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn run(self, session: &Session) -> Result<(), Failure> {
        let params = self.params();
        let document = session.read()?;
        let log = |text: &str| session.info(text);
        let meshed = tetrahedralize(document, &params, &log).map_err(|e| e.failure())?;
        for sentence in &meshed.advice {
            session.note(sentence);
        }
        let mut document = meshed.document;
        let notes = [meshed.advice, meshed.facts].concat();
        document.history.push(session.history_entry(notes));
        session.write(&document)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{CommandFactory, Parser};

    fn parse(arguments: &[&str]) -> Result<Params, clap::Error> {
        let all = std::iter::once("tetwedge").chain(arguments.iter().copied());
        Ok(Cli::try_parse_from(all)?.params())
    }

    #[test]
    fn options_become_parameters() {
        Cli::command().debug_assert();
        let params = parse(&[]).unwrap();
        assert_eq!(params.radius_edge, 1.4);
        assert_eq!(params.optimize, Some(DEFAULT_OPTIMIZE));
        let params = parse(&[
            "--edge-length",
            "2",
            "--region",
            "a:b:max-volume=1e-3",
            "--optimize",
            "off",
            "--switches",
            "-T1e-10",
            "--timeout",
            "0.5",
        ])
        .unwrap();
        assert!((params.max_volume.unwrap() - 8.0 / (6.0 * 2.0_f64.sqrt())).abs() < 1e-15);
        assert_eq!(params.region_sizes[0].region, "a:b");
        assert_eq!(params.optimize, None);
        assert_eq!(params.switches, "T1e-10");
        assert_eq!(params.timeout, Some(Duration::from_millis(500)));
    }

    #[test]
    fn impossible_numbers_are_usage_errors() {
        for bad in [
            ["--radius-edge", "nan"],
            ["--radius-edge", "0.5"],
            ["--radius-edge", "-1"],
            ["--min-dihedral", "71"],
            ["--min-dihedral", "-1"],
            ["--max-volume", "0"],
            ["--max-volume", "inf"],
            ["--edge-length", "-2"],
            ["--optimize", "180"],
            ["--optimize", "on"],
            ["--region", "copper"],
            ["--region", ":max-volume=1"],
            ["--region", "copper:max-volume=x"],
            ["--timeout", "0"],
            ["--switches", "a b"],
            ["--threads", "0"],
        ] {
            let error = parse(&bad).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{bad:?}");
        }
    }
}
