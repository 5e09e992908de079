//! One trial: a body of a seed goes through the pipe, and what comes out is compared with what is known.

mod commands;
mod direct;
mod pipe;
mod spoilt;
mod subject;
mod surface;
mod union;
mod verdict;
mod versus;

pub use subject::{Kind, Subject};
pub use verdict::Verdict;
pub use versus::{Figures, Versus};

use bodies::Encoding;
use spoilt::Spoilt;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use surface::Asked;

/// Where trials run.
pub struct Laboratory {
    /// Folder of the tools' binaries.
    pub binaries: PathBuf,
    /// Time limit of a pipe.
    pub limit: Duration,
    /// Every how many trials the pipe runs twice, to compare the output; 0 for never.
    pub twice: u64,
    /// What goes through the pipe.
    pub kind: Kind,
    /// Whether a deviation and sizes of surfaces are asked for, which the seed draws.
    pub surfaces: bool,
}

/// A trial that has ended.
pub struct Trial {
    /// What to think of it.
    pub verdict: Verdict,
    /// Time of the pipe and the check.
    pub time: Duration,
    /// Elements of the whole mesh; 0 if there is none.
    pub tetrahedra: u64,
    /// What the body is.
    pub description: String,
}

/// Part of the time limit of a pipe that a tool which may take long is given.
const PATIENCE: f64 = 0.45;

impl Laboratory {
    /// Runs the trial of a seed in an empty folder, which afterwards has the body, the command lines as a
    /// script, all messages and reports.
    ///
    /// # Errors
    /// Fails when files cannot be written or processes not be started.
    pub fn trial(&self, seed: u64, folder: &Path) -> io::Result<Trial> {
        let subject = Subject::of(self.kind, seed);
        let mut stages = commands::stages(&subject, seed);
        let is_sized = stages.iter().flatten().any(|word| word == "--max-volume");
        let asked = self.surfaces.then(|| Asked::of(&subject, seed, is_sized));
        let cut = stages.iter_mut().find(|stage| stage[0] == "wedgecut");
        for (stage, asked) in cut.into_iter().zip(&asked) {
            stage.extend(asked.options.iter().cloned());
        }
        // TetGen comes to no end on some bodies, as on the whole body alone: tools are asked to say so.
        let patience = format!("{:.0}", (PATIENCE * self.limit.as_secs_f64()).max(1.0));
        for stage in &mut stages {
            if matches!(stage[0].as_str(), "periodic-surf" | "tetwedge") {
                stage.extend(["--timeout".to_owned(), patience.clone()]);
            }
        }
        let mut out = BufWriter::new(File::create(folder.join("body"))?);
        // Regions of a .poly have no names, and each cell without a point is one of its own.
        let encoding = match subject.encoding {
            Encoding::Poly => Encoding::Obj,
            other => other,
        };
        bodies::write(&subject.body, encoding, &mut out)?;
        out.flush()?;
        drop(out);
        stages[0].extend(["--report".to_owned(), path(folder, "symmetry.json")]);
        let check = check(folder);
        std::fs::write(
            folder.join("run.sh"),
            script(seed, &subject.description, &stages, &check),
        )?;
        let begun = Instant::now();
        let (mut verdict, tetrahedra) =
            self.verdict(seed, (&subject, asked.as_ref()), &stages, check, folder)?;
        if verdict == Verdict::Meshed
            && let (Kind::Solids, Some(asked)) = (self.kind, &asked)
        {
            verdict = self.distance(&subject, asked.deviation, folder)?;
        }
        Ok(Trial {
            verdict,
            time: begun.elapsed(),
            tetrahedra,
            description: subject.description,
        })
    }

    /// Spoils the triangles of a file by a seed and sends them through the pipe, in an empty folder as [`Self::trial`] has it. They may
    /// be meshed, if the mesh is sound, or refused.
    ///
    /// # Errors
    /// Fails when files cannot be read or written, or processes not be started.
    pub fn spoilt(&self, file: &Path, seed: u64, folder: &Path) -> io::Result<Trial> {
        let mut spoilt = Spoilt::of(file, seed)?;
        let ways = spoilt.spoil();
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let description = format!("{name}: {ways}");
        std::fs::write(folder.join("body"), spoilt.stl())?;
        let mut stages = commands::defaults();
        stages[0].push("--allow-asymmetric".to_owned());
        let check = check(folder);
        let script = script(seed, &description, &stages, &check);
        std::fs::write(folder.join("run.sh"), script)?;
        let begun = Instant::now();
        let run = pipe::run(
            &self.binaries,
            folder,
            &stages,
            "body",
            "mesh.tmesh",
            self.limit,
        )?;
        let verdict = match verdict::of_stages(None, &run) {
            Some(verdict) => verdict,
            None => self.checked(check, folder)?.unwrap_or(Verdict::Meshed),
        };
        let tetrahedra = match verdict {
            Verdict::Meshed => report(folder, "quality.json")?["tetrahedra"].as_u64(),
            _ => None,
        };
        Ok(Trial {
            verdict,
            time: begun.elapsed(),
            tetrahedra: tetrahedra.unwrap_or(0),
            description,
        })
    }

    /// Has `meshqual` check the mesh, with the command given; what is wrong with it, if anything is.
    fn checked(&self, check: commands::Stage, folder: &Path) -> io::Result<Option<Verdict>> {
        let (input, output) = ("mesh.tmesh", "quality.txt");
        let ended = pipe::run(&self.binaries, folder, &[check], input, output, self.limit)?;
        // What meshqual refuses is a wrong mesh.
        let verdict = verdict::of_stages(None, &ended);
        Ok(verdict.map(|verdict| match verdict {
            Verdict::Refused(text) => Verdict::Failed(text),
            other => other,
        }))
    }

    /// Judges how far the surface of the mesh is from the body's.
    fn distance(&self, subject: &Subject, deviation: f64, folder: &Path) -> io::Result<Verdict> {
        // Assembled: where the symmetry exchanges regions, what is between them is in walls of the wedge.
        let whole = ["rotassemble", "--to", "tmesh"].map(str::to_owned).to_vec();
        let (input, output) = ("mesh.tmesh", "whole.tmesh");
        let ended = pipe::run(&self.binaries, folder, &[whole], input, output, self.limit)?;
        if let Some(verdict) = verdict::of_stages(Some(subject), &ended) {
            return Ok(verdict);
        }
        let report = report(folder, "symmetry.json")?;
        let distance = surface::distance(
            subject,
            &folder.join(output),
            union::is_union(&report, subject.settled),
        )?;
        let deviation = deviation + surface::moved(folder)?;
        Ok(verdict::of_distance(&report, deviation, &distance))
    }

    fn verdict(
        &self,
        seed: u64,
        (subject, asked): (&Subject, Option<&Asked>),
        stages: &[commands::Stage],
        check: commands::Stage,
        folder: &Path,
    ) -> io::Result<(Verdict, u64)> {
        let run = |stages: &[commands::Stage], input, output| {
            pipe::run(&self.binaries, folder, stages, input, output, self.limit)
        };
        let ended = run(stages, "body", "mesh.tmesh")?;
        if let Some(verdict) = verdict::of_stages(Some(subject), &ended) {
            return Ok((verdict, 0));
        }
        if let Some(wrong) = self.checked(check, folder)? {
            return Ok((wrong, 0));
        }
        let quality = report(folder, "quality.json")?;
        let tetrahedra = quality["tetrahedra"].as_u64().unwrap_or(0);
        let moved = asked.map_or(0.0, |asked| asked.deviation) + surface::moved(folder)?;
        let symmetry = report(folder, "symmetry.json")?;
        let verdict = verdict::of_reports(subject, &symmetry, &quality, moved);
        if verdict == Verdict::Meshed && self.twice > 0 && seed.is_multiple_of(self.twice) {
            // What a time limit stops the second time was not made again, and says nothing.
            let again = run(stages, "body", "again.tmesh")?;
            if let Some(verdict) = verdict::of_stages(Some(subject), &again) {
                return Ok((verdict, tetrahedra));
            }
            let [first, second] =
                ["mesh.tmesh", "again.tmesh"].map(|name| std::fs::read(folder.join(name)));
            if first? != second? {
                let text = "determinism: two runs wrote different bytes".to_owned();
                return Ok((Verdict::Failed(text), tetrahedra));
            }
        }
        Ok((verdict, tetrahedra))
    }
}

/// The command that checks a mesh and leaves its report in a folder.
fn check(folder: &Path) -> commands::Stage {
    let mut check = commands::words("meshqual --check --json");
    check.push(path(folder, "quality.json"));
    check
}

fn report(folder: &Path, name: &str) -> io::Result<serde_json::Value> {
    Ok(serde_json::from_slice(&std::fs::read(folder.join(name))?)?)
}

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_string_lossy().into_owned()
}

/// The command lines of a trial as a shell script that expects the tools on the path.
fn script(seed: u64, facts: &str, stages: &[commands::Stage], check: &[String]) -> String {
    let line = |stage: &[String]| -> String {
        let words = stage.iter().map(|word| match word.rsplit_once('/') {
            Some((_, name)) => name,
            None => word,
        });
        words.collect::<Vec<_>>().join(" ")
    };
    let pipe: Vec<String> = stages.iter().map(|s| line(s)).collect();
    format!(
        "#!/bin/sh\n# Seed {seed}: {facts}\ncd \"$(dirname \"$0\")\" || exit\n<body {} >mesh.tmesh\n{} mesh.tmesh >quality.txt\n",
        pipe.join(" |\n  "),
        line(check)
    )
}
