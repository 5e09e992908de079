//! Many trials, with a table of their results that an interrupted campaign goes on from.

use soak::{Kind, Laboratory, Trial, Verdict};
use std::collections::{BTreeMap, HashSet};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Options of every campaign.
#[derive(clap::Args)]
struct Campaign {
    /// Number of trials
    #[arg(long, default_value_t = 1000)]
    count: u64,

    /// Seed of the first trial; the others follow
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Folder of the tools' binaries
    #[arg(long, default_value = "target/release")]
    binaries: PathBuf,

    /// Folder for results and for what fails; results that are there are not made again
    #[arg(long, default_value = "target/soak")]
    out: PathBuf,

    /// Trials at the same time
    #[arg(long, default_value_t = 1)]
    jobs: usize,

    /// Time limit of a pipe, seconds
    #[arg(long, default_value_t = 60)]
    limit: u64,
}

/// Options of a campaign of bodies that are drawn.
#[derive(clap::Args)]
pub struct Bodies {
    #[command(flatten)]
    campaign: Campaign,

    /// Which bodies
    #[arg(long, value_enum, default_value_t = Kind::Solids)]
    kind: Kind,

    /// Ask for a deviation and sizes of the surface, drawn by the seed, and hold the distance of solids against it
    #[arg(long)]
    surfaces: bool,

    /// Run every so manieth pipe twice and compare the bytes, 0 for none
    #[arg(long, default_value_t = 10)]
    twice: u64,
}

/// Options of a campaign of files that are spoilt.
#[derive(clap::Args)]
pub struct Files {
    #[command(flatten)]
    campaign: Campaign,

    /// Files of triangles, which take turns
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

/// Sends bodies of known symmetry through the pipe and prints what came of it. Returns whether nothing failed.
///
/// # Errors
/// Fails when files cannot be written or processes not be started.
pub fn of_bodies(options: &Bodies) -> io::Result<bool> {
    let laboratory = Laboratory {
        twice: options.twice,
        kind: options.kind,
        surfaces: options.surfaces,
        ..options.campaign.laboratory()
    };
    (options.campaign).run(|seed, folder| laboratory.trial(seed, folder))
}

/// Sends spoilt files through the pipe and prints what came of it. Returns whether nothing failed.
///
/// # Errors
/// Fails when files cannot be read or written or processes not be started.
pub fn of_files(options: &Files) -> io::Result<bool> {
    let laboratory = options.campaign.laboratory();
    let files = &options.files;
    options.campaign.run(|seed, folder| {
        let file = &files[(seed % files.len() as u64) as usize];
        laboratory.spoilt(file, seed, folder)
    })
}

impl Campaign {
    fn laboratory(&self) -> Laboratory {
        Laboratory {
            binaries: self.binaries.clone(),
            limit: Duration::from_secs(self.limit),
            twice: 0,
            kind: Kind::Solids,
            surfaces: false,
        }
    }

    /// Makes a trial of each seed that has none yet, and prints a summary. Returns whether nothing failed.
    fn run(&self, trial: impl Fn(u64, &Path) -> io::Result<Trial> + Sync) -> io::Result<bool> {
        fs::create_dir_all(&self.out)?;
        let table = self.out.join("results.tsv");
        let seeds = self.seed..self.seed + self.count;
        let done = done(&table)?;
        let todo: Vec<u64> = seeds.clone().filter(|s| !done.contains(s)).collect();
        let results = Mutex::new(OpenOptions::new().create(true).append(true).open(&table)?);
        let next = AtomicU64::new(0);
        let worker = || -> io::Result<()> {
            loop {
                let place = next.fetch_add(1, Ordering::Relaxed) as usize;
                let Some(&seed) = todo.get(place) else {
                    return Ok(());
                };
                let folder = self.out.join(format!("seed-{seed}"));
                let _ = fs::remove_dir_all(&folder);
                fs::create_dir_all(&folder)?;
                let trial = trial(seed, &folder)?;
                match &trial.verdict {
                    Verdict::Meshed | Verdict::Asymmetric => fs::remove_dir_all(&folder)?,
                    Verdict::Refused(text) | Verdict::Failed(text) => {
                        // The mesh is made again by the script.
                        for name in ["mesh.tmesh", "whole.tmesh", "again.tmesh"] {
                            let _ = fs::remove_file(folder.join(name));
                        }
                        eprintln!("soak: seed {seed}: {text}");
                    }
                }
                let mut results = results.lock().unwrap_or_else(|e| e.into_inner());
                results.write_all(line(seed, &trial).as_bytes())?;
            }
        };
        crate::workers::run(self.jobs, worker)?;
        summary(&table, &seeds)
    }
}

fn line(seed: u64, trial: &Trial) -> String {
    let (word, text) = match &trial.verdict {
        Verdict::Meshed => ("meshed", ""),
        Verdict::Asymmetric => ("asymmetric", ""),
        Verdict::Refused(text) => ("refused", text.as_str()),
        Verdict::Failed(text) => ("failed", text.as_str()),
    };
    format!(
        "{seed}\t{word}\t{:.3}\t{}\t{}\t{text}\n",
        trial.time.as_secs_f64(),
        trial.tetrahedra,
        trial.description
    )
}

/// Rows of the table, split into columns.
fn rows(table: &Path) -> io::Result<Vec<Vec<String>>> {
    let file = match File::open(table) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(error),
    };
    let mut rows = Vec::new();
    for line in BufReader::new(file).lines() {
        let row: Vec<String> = line?.split('\t').map(str::to_owned).collect();
        // An interrupted campaign may have left part of a line.
        if row.len() == 6 {
            rows.push(row);
        }
    }
    Ok(rows)
}

fn done(table: &Path) -> io::Result<HashSet<u64>> {
    let rows = rows(table)?;
    Ok(rows.iter().filter_map(|row| row[0].parse().ok()).collect())
}

/// Prints counts and reasons. Returns whether nothing failed.
fn summary(table: &Path, seeds: &std::ops::Range<u64>) -> io::Result<bool> {
    let mut reasons: BTreeMap<(String, String), Vec<u64>> = BTreeMap::new();
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    let mut seconds = 0.0;
    let mut longest = (0.0, 0);
    let mut tetrahedra = 0.0;
    for row in rows(table)? {
        let Some(seed) = row[0].parse().ok().filter(|s| seeds.contains(s)) else {
            continue;
        };
        *counts.entry(row[1].clone()).or_default() += 1;
        let time: f64 = row[2].parse().unwrap_or(0.0);
        seconds += time;
        if time > longest.0 {
            longest = (time, seed);
        }
        tetrahedra += row[3].parse().unwrap_or(0.0);
        if !row[5].is_empty() {
            let key = (row[1].clone(), without_numbers(&row[5]));
            reasons.entry(key).or_default().push(seed);
        }
    }
    let total: u64 = counts.values().sum();
    let of = |word: &str| counts.get(word).copied().unwrap_or(0);
    println!(
        "{total} bodies: {} meshed and checked, {} without symmetry and refused for it, {} refused, {} failed",
        of("meshed"),
        of("asymmetric"),
        of("refused"),
        of("failed")
    );
    println!(
        "{:.3} s a body, at most {:.1} s (seed {}), {:.0} tetrahedra a body",
        seconds / total.max(1) as f64,
        longest.0,
        longest.1,
        tetrahedra / total.max(1) as f64
    );
    for ((word, reason), seeds) in &reasons {
        let few: Vec<String> = seeds.iter().take(12).map(u64::to_string).collect();
        println!("{word} {} x {reason}: seeds {}", seeds.len(), few.join(" "));
    }
    Ok(of("failed") == 0)
}

/// A message with every number replaced, so that those of one kind are alike.
fn without_numbers(text: &str) -> String {
    let mut out = String::new();
    let mut within = false;
    for c in text.chars() {
        let part = c.is_ascii_digit() || within && matches!(c, '.' | 'e' | '-');
        if !part {
            out.push(c);
        } else if !within {
            out.push('#');
        }
        within = part;
    }
    out
}
