//! A table of what the pipe and the direct mesh are like, body by body, and what it comes to.

use soak::{Figures, Kind, Laboratory, Versus};
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Options of a comparison.
#[derive(clap::Args)]
pub struct Options {
    /// Number of bodies
    #[arg(long, default_value_t = 100)]
    count: u64,

    /// Seed of the first body; the others follow
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Folder of the tools' binaries
    #[arg(long, default_value = "target/release")]
    binaries: PathBuf,

    /// The program that meshes the whole body
    #[arg(long, default_value = "tetgen")]
    tetgen: PathBuf,

    /// Folder for the table (versus.tsv) and what is meshed
    #[arg(long, default_value = "target/versus")]
    out: PathBuf,

    /// Bodies at the same time
    #[arg(long, default_value_t = 1)]
    jobs: usize,

    /// Time limit of a mesh, seconds
    #[arg(long, default_value_t = 60)]
    limit: u64,

    /// Which bodies
    #[arg(long, value_enum, default_value_t = Kind::Folded)]
    kind: Kind,
}

/// Runs a comparison and prints what came of it. Returns whether the first percentile of the pipe is nowhere below the direct
/// mesh's.
///
/// # Errors
/// Fails when files cannot be written or processes not be started.
pub fn run(options: &Options) -> io::Result<bool> {
    fs::create_dir_all(&options.out)?;
    let table = options.out.join("versus.tsv");
    let file = OpenOptions::new().create(true).append(true).open(&table)?;
    let results: Mutex<(fs::File, Vec<(u64, Versus)>)> = Mutex::new((file, Vec::new()));
    let laboratory = Laboratory {
        binaries: options.binaries.clone(),
        limit: Duration::from_secs(options.limit),
        twice: 0,
        kind: options.kind,
        surfaces: false,
    };
    let next = AtomicU64::new(options.seed);
    let worker = || -> io::Result<()> {
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= options.seed + options.count {
                return Ok(());
            }
            let folder = options.out.join(format!("seed-{seed}"));
            let _ = fs::remove_dir_all(&folder);
            fs::create_dir_all(&folder)?;
            let versus = laboratory.versus(&options.tetgen, seed, &folder)?;
            fs::remove_dir_all(&folder)?;
            let mut results = results.lock().unwrap_or_else(|e| e.into_inner());
            results.0.write_all(line(seed, &versus).as_bytes())?;
            results.1.push((seed, versus));
        }
    };
    crate::workers::run(options.jobs, worker)?;
    let (_, mut rows) = results.into_inner().unwrap_or_else(|e| e.into_inner());
    rows.sort_by_key(|row| row.0);
    Ok(summary(&rows))
}

fn line(seed: u64, versus: &Versus) -> String {
    let figures = |f: &Figures| {
        let Figures {
            tetrahedra,
            p01,
            min,
            seconds,
            ..
        } = f;
        format!("{tetrahedra}\t{p01:.3}\t{min:.3}\t{seconds:.3}")
    };
    let none = "-\t-\t-\t-".to_owned();
    let ours = versus.ours.as_ref().map_or(none.clone(), figures);
    let direct = versus.direct.as_ref().map_or(none, figures);
    let failed = versus.ours.as_ref().err().map_or("", String::as_str);
    let (bent, distance, volume) = (versus.subject.bent, versus.distance, versus.volume);
    let what = &versus.subject.description;
    format!(
        "{seed}\t{bent:.2e}\t{ours}\t{direct}\t{distance:.2e}\t{volume:.2e}\t{what}\t{failed}\n"
    )
}

/// A body that both meshed.
struct Pair<'a> {
    seed: u64,
    bent: f64,
    ours: &'a Figures,
    direct: &'a Figures,
}

impl Pair<'_> {
    /// The first percentile of the pipe over that of the direct mesh.
    fn ratio(&self) -> f64 {
        self.ours.p01 / self.direct.p01
    }
}

/// Prints counts by decade of the angle. Returns whether none is below the direct mesh, and none failed.
fn summary(rows: &[(u64, Versus)]) -> bool {
    let failed: Vec<u64> = rows
        .iter()
        .filter(|(_, v)| v.ours.is_err())
        .map(|row| row.0)
        .collect();
    let alone = rows
        .iter()
        .filter(|(_, v)| v.ours.is_ok() && v.direct.is_none());
    println!(
        "{} bodies: {} that the pipe did not mesh (seeds {failed:?}), {} that tetgen alone did not",
        rows.len(),
        failed.len(),
        alone.count()
    );
    let pairs: Vec<Pair> = rows
        .iter()
        .filter_map(|(seed, v)| {
            Some(Pair {
                seed: *seed,
                bent: v.subject.bent,
                ours: v.ours.as_ref().ok()?,
                direct: v.direct.as_ref()?,
            })
        })
        .collect();
    let decade = |p: &Pair| p.bent.log10().floor() as i64;
    let mut decades: Vec<i64> = pairs.iter().map(decade).collect();
    decades.sort_unstable();
    decades.dedup();
    println!(
        "bent by, degrees   bodies  p01 below  min below  worst p01 ratio  median p01, direct  elements over direct"
    );
    for d in decades {
        let of: Vec<&Pair> = pairs.iter().filter(|p| decade(p) == d).collect();
        let name = match d {
            i64::MIN => "not at all".to_owned(),
            d => format!("1e{d} to 1e{}", d + 1),
        };
        row(&name, &of);
    }
    row("all", &pairs.iter().collect::<Vec<_>>());
    let mut below: Vec<&Pair> = pairs.iter().filter(|p| p.ratio() < 1.0).collect();
    below.sort_by(|p, q| p.ratio().total_cmp(&q.ratio()));
    for p in &below {
        println!(
            "seed {}: bent by {:.1e}, p01 {:.2} for {:.2}, min {:.2} for {:.2}, elements {} for {}",
            p.seed,
            p.bent,
            p.ours.p01,
            p.direct.p01,
            p.ours.min,
            p.direct.min,
            p.ours.tetrahedra,
            p.direct.tetrahedra
        );
    }
    let largest = |of: &dyn Fn(&Versus) -> f64| {
        let all = rows.iter().filter(|(_, v)| v.ours.is_ok());
        all.map(|(seed, v)| (of(v).abs(), *seed))
            .fold((0.0, 0), |m, x| if x.0 > m.0 { x } else { m })
    };
    let (distance, volume) = (largest(&|v| v.distance), largest(&|v| v.volume));
    println!(
        "largest distance {:.1e} of the radius (seed {}), largest difference of volume {:.1e} (seed {})",
        distance.0, distance.1, volume.0, volume.1
    );
    below.is_empty() && failed.is_empty()
}

fn row(name: &str, pairs: &[&Pair<'_>]) {
    let count = |holds: &dyn Fn(&Pair<'_>) -> bool| pairs.iter().filter(|p| holds(p)).count();
    let median = |of: &dyn Fn(&Pair<'_>) -> f64| {
        let mut all: Vec<f64> = pairs.iter().map(|p| of(p)).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
    };
    let worst = pairs
        .iter()
        .map(|p| p.ratio())
        .fold(f64::INFINITY, f64::min);
    println!(
        "{name:<18} {:>6} {:>10} {:>10} {worst:>16.3} {:>11.2}, {:>5.2} {:>21.2}",
        pairs.len(),
        count(&|p| p.ratio() < 1.0),
        count(&|p| p.ours.min < p.direct.min),
        median(&|p| p.ours.p01),
        median(&|p| p.direct.p01),
        median(&|p| p.ours.tetrahedra as f64 / p.direct.tetrahedra as f64),
    );
}
