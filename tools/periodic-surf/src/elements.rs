//! What is asked of the elements on the command line, of every tool that meshes.

use geom::tet::REGULAR_RADIUS_EDGE;
use mesher::{DEFAULT_OPTIMIZE, Params, RegionSize, volume_of_edge};
use std::time::Duration;

/// Options for size, shape and time.
#[derive(clap::Args, Clone, Debug)]
pub struct ElementArgs {
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

    /// Dihedral angle, degrees, above which tetrahedra are optimized away, and half of what it leaves of 180
    /// the angle below which they are; `off` removes only the nearly flat ones
    #[arg(long, value_name = "DEG|off", value_parser = optimize, default_value_t = Optimize(Some(DEFAULT_OPTIMIZE)))]
    optimize: Optimize,

    /// A plain constrained tetrahedralization: no quality bounds, no optimization
    #[arg(long)]
    no_quality: bool,

    /// Time limit for the mesher, per template [default: none]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    timeout: Option<f64>,

    /// Memory that the mesher may take, per template, in MiB or with a unit: 512M, 8G [default: none]
    #[arg(long, value_name = "SIZE", value_parser = memory)]
    max_memory: Option<u64>,
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

/// Bytes in a size such as `512M`, `1.5G`, or `512` for MiB.
fn memory(text: &str) -> Result<u64, String> {
    let (digits, unit) = match text.to_ascii_uppercase().chars().last() {
        Some('M') => (&text[..text.len() - 1], 20),
        Some('G') => (&text[..text.len() - 1], 30),
        _ => (text, 20),
    };
    let bytes = positive(digits)? * f64::from(1 << unit);
    if bytes < 1e18 {
        Ok(bytes.ceil() as u64)
    } else {
        Err("more than there is anywhere".to_owned())
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

impl ElementArgs {
    /// The options as parameters; switches are left at their default.
    pub fn params(&self) -> Params {
        Params {
            quality: !self.no_quality,
            radius_edge: self.radius_edge,
            min_dihedral: self.min_dihedral,
            optimize: self.optimize.0,
            max_volume: self.max_volume.or(self.edge_length.map(volume_of_edge)),
            region_sizes: self.region.clone(),
            // Longer than the universe is as good as none.
            timeout: self
                .timeout
                .and_then(|s| Duration::try_from_secs_f64(s).ok()),
            max_memory: self.max_memory,
            ..Params::default()
        }
    }
}
