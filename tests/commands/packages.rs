//! What is packed runs where it is unpacked: the archive's folder, the wheel, the Debian package.

use bodies::facets::{binary_stl, unit_cube};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use support::binary;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const TOOLS: [&str; 6] = [
    "symdetect",
    "wedgecut",
    "periodic-surf",
    "tetwedge",
    "rotassemble",
    "meshqual",
];

fn run(command: &mut Command) -> Output {
    command.stdin(Stdio::null()).output().expect("it runs")
}

#[track_caller]
fn succeeds(command: &mut Command) -> String {
    let output = run(command);
    assert!(
        output.status.success(),
        "{command:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("text")
}

/// Installs the tools into `folder`, without the symbols for debuggers.
fn install(folder: &Path) {
    let bin = folder.join("bin");
    std::fs::create_dir_all(&bin).expect("a folder");
    for tool in TOOLS {
        succeeds(
            Command::new("strip")
                .arg("-o")
                .arg(bin.join(tool))
                .arg(binary(tool)),
        );
    }
    let script = Path::new(ROOT).join("tools/symtet/symtet");
    std::fs::copy(script, bin.join("symtet")).expect("a copy");
}

/// Meshes a cube with the tools in `bin`, and proves the mesh.
#[track_caller]
fn meshes_a_cube(bin: &Path, folder: &Path) {
    let input = folder.join("cube.stl");
    std::fs::write(&input, binary_stl(b"", &unit_cube([0.0; 3]))).expect("a file");
    let output = folder.join("cube.vtu");
    succeeds(
        Command::new(bin.join("symtet"))
            .arg(&input)
            .arg("-o")
            .arg(&output),
    );
    succeeds(
        Command::new(bin.join("meshqual"))
            .arg("--check")
            .arg(&output),
    );
}

fn with_library(folder: &Path) {
    install(folder);
    succeeds(Command::new(format!("{ROOT}/packaging/library")).arg(folder));
}

#[test]
fn the_archive_brings_the_library_that_its_tools_load() {
    let folder = tempfile::tempdir().expect("a folder");
    with_library(folder.path());
    let libraries = succeeds(Command::new("ldd").arg(folder.path().join("bin/tetwedge")));
    let tetgen = libraries.lines().find(|line| line.contains("libtet"));
    assert!(
        tetgen.is_some_and(|line| line.contains("/lib/symtet/libtet")),
        "{libraries}"
    );
    assert!(folder.path().join("share/doc/symtet/TetGen").exists());
    meshes_a_cube(&folder.path().join("bin"), folder.path());
}

#[test]
fn the_wheel_installs_tools_library_and_reader() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    if !run(Command::new("python3")
        .args(["-m", "venv"])
        .arg(path("venv")))
    .status
    .success()
    {
        println!("skipped: python3 makes no environment here (package python3-venv)");
        return;
    }
    with_library(&path("stage"));
    let wheel = || {
        let mut command = Command::new("python3");
        command
            .arg(format!("{ROOT}/packaging/wheel.py"))
            .arg(path("stage"))
            .args(["1.2.3"])
            .arg(folder.path())
            .arg(format!("{ROOT}/formats/tmesh/python/tmesh.py"));
        let printed = succeeds(&mut command);
        let file = printed.trim().to_owned();
        let bytes = std::fs::read(&file).expect("the wheel");
        (file, bytes)
    };
    let (file, bytes) = wheel();
    assert!(bytes == wheel().1, "the same bytes again");
    succeeds(
        Command::new(path("venv/bin/python"))
            .args(["-m", "pip", "install", "--quiet", "--no-index"])
            .arg(&file),
    );
    assert!(path("venv/lib/symtet").is_dir());
    let found = succeeds(Command::new(path("venv/bin/python")).args([
        "-c",
        "import importlib.metadata, importlib.util as u; \
         print(importlib.metadata.version('symtet'), u.find_spec('tmesh') is not None)",
    ]));
    assert_eq!(found.trim(), "1.2.3 True");
    meshes_a_cube(&path("venv/bin"), folder.path());
}

#[test]
fn the_debian_package_asks_for_tetgens_library() {
    if Command::new("dpkg-deb").arg("--version").output().is_err() {
        println!("skipped: dpkg-deb is not installed");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let stage = folder.path().join("stage");
    install(&stage.join("usr"));
    let package = folder.path().join("symtet.deb");
    succeeds(
        Command::new(format!("{ROOT}/packaging/deb"))
            .arg(&stage)
            .arg("1.2.3")
            .arg(&package),
    );
    let depends = succeeds(
        Command::new("dpkg-deb")
            .arg("-f")
            .arg(&package)
            .arg("Depends"),
    );
    assert!(depends.contains("libtet1.5"), "{depends}");
    let out = folder.path().join("out");
    succeeds(Command::new("dpkg-deb").arg("-x").arg(&package).arg(&out));
    meshes_a_cube(&out.join("usr/bin"), folder.path());
}
