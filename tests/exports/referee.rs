//! Running the readers.

use serde_json::Value;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/exports/read.py");

/// A file to be read.
#[derive(Clone, Debug)]
pub struct Job {
    /// Who reads it.
    pub reader: &'static str,
    /// The format.
    pub kind: &'static str,
    path: String,
}

impl Job {
    /// The reader is `gmsh`, `meshio`, `vtk`, `ranks` (several processes), or `manual`.
    pub fn new(reader: &str, kind: &str, path: &str) -> Self {
        let known = ["gmsh", "meshio", "vtk", "ranks", "manual"];
        let kinds = [
            "msh", "msh2", "mesh", "inp", "bdf", "node", "vtk", "vtu", "pvtu",
        ];
        let find = |list: &[&'static str], word: &str| {
            let found = list.iter().find(|w| **w == word);
            *found.unwrap_or_else(|| panic!("no {word}"))
        };
        Self {
            reader: find(&known, reader),
            kind: find(&kinds, kind),
            path: path.to_owned(),
        }
    }
}

impl fmt::Display for Job {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} on {} ({})", self.reader, self.path, self.kind)
    }
}

/// The Python that has the readers, if an environment is named.
pub fn python() -> Option<PathBuf> {
    let folder = std::env::var_os("REFEREE")?;
    Some(Path::new(&folder).join("bin/python"))
}

/// Whether the readers can be used; says so if not.
pub fn is_there() -> bool {
    let Some(python) = python() else {
        println!("skipped: REFEREE does not name an environment with the readers; run make test");
        return false;
    };
    let check = Command::new(&python)
        .args(["-c", "import meshio, vtk, gmsh"])
        .output();
    match check {
        Ok(output) if output.status.success() => true,
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stderr).into_owned();
            println!("skipped: {}", text.lines().last().unwrap_or_default());
            false
        }
        Err(error) => {
            println!("skipped: {}: {error}", python.display());
            false
        }
    }
}

/// What each reader finds.
#[track_caller]
pub fn read(jobs: &[Job]) -> Vec<Value> {
    let mut command = Command::new(python().expect("looked for before"));
    command.arg(SCRIPT);
    for job in jobs {
        command.args([job.reader, job.kind, job.path.as_str()]);
    }
    let output = command.output().expect("Python runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    let found: Vec<Value> = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(found.len(), jobs.len());
    found
}

/// Checks a number to a relative tolerance.
#[track_caller]
pub fn close(value: &Value, expected: f64, tolerance: f64, what: &str) {
    let found = value.as_f64().unwrap_or_else(|| panic!("{what}: {value}"));
    let error = (found / expected - 1.0).abs();
    assert!(
        error <= tolerance,
        "{what}: {found}, not {expected}: {error:e}"
    );
}
