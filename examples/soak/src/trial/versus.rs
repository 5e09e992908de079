//! The mesh of the pipe beside the direct one of the whole body.

use super::pipe;
use super::subject::Subject;
use super::{Laboratory, check, commands, direct, path, report, surface, verdict};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::time::Instant;

/// What a mesh is like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// Elements of the whole body.
    pub tetrahedra: u64,
    /// First percentile of the smallest dihedral angles of elements, degrees.
    pub p01: f64,
    /// The least of them, degrees.
    pub min: f64,
    /// Volume, in the body's units.
    pub volume: f64,
    /// Time of all processes, seconds.
    pub seconds: f64,
}

/// Both meshes of a body.
pub struct Versus {
    /// That of the pipe, or why there is none.
    pub ours: Result<Figures, String>,
    /// That of TetGen on the whole body, if there is one.
    pub direct: Option<Figures>,
    /// The largest distance between the surfaces of the body and the pipe's mesh, relative to the radius about the axis.
    pub distance: f64,
    /// By how much the pipe's volume differs from the body's, relative to it.
    pub volume: f64,
    /// What the body is.
    pub subject: Subject,
}

impl Laboratory {
    /// Meshes the body of a seed by the pipe with its defaults, and directly with `tetgen`, in an empty folder.
    ///
    /// # Errors
    /// Fails when files cannot be written or processes not be started.
    pub fn versus(&self, tetgen: &Path, seed: u64, folder: &Path) -> io::Result<Versus> {
        let subject = Subject::of(self.kind, seed);
        let mut out = BufWriter::new(File::create(folder.join("body"))?);
        bodies::write(&subject.body, subject.encoding, &mut out)?;
        out.flush()?;
        drop(out);
        let direct = direct::mesh(tetgen, &subject.body, folder, self.limit)?;
        let mut versus = Versus {
            ours: Err(String::new()),
            direct,
            distance: f64::NAN,
            volume: f64::NAN,
            subject,
        };
        versus.ours = self.piped(&mut versus, folder)?;
        Ok(versus)
    }

    /// The mesh of the pipe.
    fn piped(&self, versus: &mut Versus, folder: &Path) -> io::Result<Result<Figures, String>> {
        let subject = &versus.subject;
        let mut stages = commands::defaults();
        if subject.symmetry.order() == 1 {
            stages[0].push("--allow-asymmetric".to_owned());
        }
        stages[0].extend(["--report".to_owned(), path(folder, "symmetry.json")]);
        let begun = Instant::now();
        let ended = pipe::run(
            &self.binaries,
            folder,
            &stages,
            "body",
            "mesh.tmesh",
            self.limit,
        )?;
        let seconds = begun.elapsed().as_secs_f64();
        let checked = match verdict::of_stages(Some(subject), &ended) {
            None => self.checked(check(folder), folder)?,
            failed => failed,
        };
        if let Some(failed) = checked {
            return Ok(Err(format!("{failed:?}")));
        }
        let quality = report(folder, "quality.json")?;
        let angles = &quality["metrics"]["min_dihedral_deg"];
        let number = |value: &serde_json::Value| value.as_f64().unwrap_or(f64::NAN);
        let figures = Figures {
            tetrahedra: quality["tetrahedra"].as_u64().unwrap_or(0),
            p01: number(&angles["p01"]),
            min: number(&angles["min"]),
            volume: number(&quality["volume"]),
            seconds,
        };
        let measured = surface::distance(subject, &folder.join("mesh.tmesh"), false)?;
        let known: f64 = subject.regions.iter().map(|r| r.volume).sum();
        versus.distance = measured.distance / measured.radius;
        versus.volume = (figures.volume - known) / known;
        Ok(Ok(figures))
    }
}
