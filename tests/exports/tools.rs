//! Running the tools.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use support::binary;

#[track_caller]
fn run(tool: &str, arguments: &[&str], input: &Path, output: &Path) {
    let result = Command::new(binary(tool))
        .arg("-q")
        .args(arguments)
        .arg(input)
        .arg("-o")
        .arg(output)
        .stdin(Stdio::null())
        .output()
        .expect("it runs");
    let errors = String::from_utf8_lossy(&result.stderr);
    assert!(result.status.success(), "{tool}: {errors}");
}

/// Takes a surface through all stages up to the mesh of a wedge; returns its path.
#[track_caller]
pub fn mesh(folder: &Path, surface: &[u8], cut: &[&str]) -> PathBuf {
    stages(folder, surface, cut, true)
}

/// The same with few elements: the faces of the wedge stay as they are cut.
#[track_caller]
pub fn coarse_mesh(folder: &Path, surface: &[u8], cut: &[&str]) -> PathBuf {
    stages(folder, surface, cut, false)
}

#[track_caller]
fn stages(folder: &Path, surface: &[u8], cut: &[&str], graded: bool) -> PathBuf {
    let path = |name: &str| folder.join(name);
    let input = path("surface");
    std::fs::write(&input, surface).expect("a file");
    let mut before = input;
    // As cut, so that a solver is done with the whole in seconds.
    let faces: &[&str] = if graded { &[] } else { &["--keep-surface"] };
    for (tool, arguments, name) in [
        ("symdetect", &[][..], "detected.tmesh"),
        ("wedgecut", cut, "wedge.tmesh"),
        ("periodic-surf", &[], "surface.tmesh"),
        ("tetwedge", faces, "mesh.tmesh"),
    ] {
        if tool == "periodic-surf" && !graded {
            continue;
        }
        let after = path(name);
        run(tool, arguments, &before, &after);
        before = after;
    }
    before
}

/// Runs `rotassemble`, which must succeed.
#[track_caller]
pub fn rotassemble(input: &Path, arguments: &[&str]) {
    let result = Command::new(binary("rotassemble"))
        .arg("-q")
        .args(arguments)
        .arg(input)
        .output()
        .expect("it runs");
    let errors = String::from_utf8_lossy(&result.stderr);
    assert!(result.status.success(), "{arguments:?}: {errors}");
}
