//! The script that runs the four stages behind each other.

use bodies::facets::{binary_stl, unit_cube};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder whose name has a blank, with a cube in it.
fn folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let inner = folder.path().join("a b");
    std::fs::create_dir(&inner).expect("it can be made");
    std::fs::write(
        inner.join("cube.stl"),
        binary_stl(b"", &unit_cube([0.0; 3])),
    )
    .expect("it can be written");
    (folder, inner)
}

fn symtet(folder: &Path, arguments: &[&str]) -> Output {
    let tools = Path::new(env!("CARGO_BIN_EXE_symdetect")).parent();
    Command::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tools/symtet/symtet"))
        .env("SYMTET_BIN", tools.expect("a folder of tools"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("it runs")
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn the_stages_get_their_options_and_are_kept() {
    let (_folder, inner) = folder();
    let arguments = [
        "cube.stl",
        "-q",
        "-o",
        "mesh out.vtu",
        "--keep",
        "all stages",
        "--order",
        "2",
        "--edge-length=0.3",
    ];
    let output = symtet(&inner, &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(said(&output), "");
    let mesh = std::fs::read(inner.join("mesh out.vtu")).expect("the mesh is there");
    assert!(mesh.starts_with(b"<?xml"));
    // The same stages by hand end with the same bytes.
    let run = |tool: &str, arguments: &[&str]| {
        let output = Command::new(tool)
            .args(arguments)
            .current_dir(&inner)
            .output();
        assert!(output.expect("it runs").status.success());
    };
    run(
        env!("CARGO_BIN_EXE_symdetect"),
        &["-q", "cube.stl", "-o", "1.tmesh"],
    );
    let wishes = [
        "-q",
        "--order",
        "2",
        "--edge-length=0.3",
        "1.tmesh",
        "-o",
        "2.tmesh",
    ];
    run(env!("CARGO_BIN_EXE_wedgecut"), &wishes);
    run(
        env!("CARGO_BIN_EXE_tetwedge"),
        &["-q", "--edge-length=0.3", "2.tmesh", "-o", "3.tmesh"],
    );
    run(
        env!("CARGO_BIN_EXE_rotassemble"),
        &["-q", "3.tmesh", "-o", "by hand.vtu"],
    );
    assert!(mesh == std::fs::read(inner.join("by hand.vtu")).expect("it is there"));
    for stage in ["symdetect", "wedgecut", "tetwedge"] {
        assert!(
            inner.join(format!("all stages/{stage}.tmesh")).exists(),
            "{stage}"
        );
    }
}

#[test]
fn a_stage_that_fails_is_named_with_its_code() {
    let (_folder, inner) = folder();
    let cases: [(&[&str], i32, &str); 5] = [
        (
            &["cube.stl", "-o", "x.vtu", "--order", "3"],
            1,
            "symtet: stopped at wedgecut",
        ),
        (
            &["none.stl", "-o", "x.vtu"],
            3,
            "symtet: stopped at symdetect",
        ),
        (
            &["cube.stl", "-o", "x.vtu", "--nonsense"],
            2,
            "symtet: no stage has --nonsense",
        ),
        (&["cube.stl"], 2, "symtet: say where the mesh goes"),
        (
            &["cube.stl", "other.stl", "-o", "x.vtu"],
            3,
            "cannot read other.stl",
        ),
    ];
    for (arguments, code, message) in cases {
        let output = symtet(&inner, arguments);
        assert_eq!(
            output.status.code(),
            Some(code),
            "{arguments:?} {}",
            said(&output)
        );
        assert!(
            said(&output).contains(message),
            "{arguments:?} {}",
            said(&output)
        );
        assert!(output.stdout.is_empty() && !inner.join("x.vtu").exists());
    }
}

#[test]
fn several_inputs_are_one_body_with_a_region_each() {
    let (_folder, inner) = folder();
    std::fs::write(
        inner.join("it's two.stl"),
        binary_stl(b"", &unit_cube([1.0, 0.0, 0.0])),
    )
    .expect("it can be written");
    let cases: [(&[&str], [&str; 2]); 2] = [
        (&["cube.stl", "it's two.stl"], ["cube", "it's two"]),
        (
            &["cube.stl", "--region", "copper bar=it's two.stl"],
            ["cube", "copper bar"],
        ),
    ];
    let sizes = ["max-volume=0.01", "edge-length=0.3"];
    for ((inputs, names), size) in cases.into_iter().zip(sizes) {
        let size = format!("--region={}:{size}", names[1]);
        let arguments = [inputs, &["-q", "-o", "out.tmesh", "--to", "tmesh", &size]].concat();
        let output = symtet(&inner, &arguments);
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        let bytes = std::fs::read(inner.join("out.tmesh")).expect("the mesh is there");
        let mesh = tmesh::read(bytes.as_slice()).expect("valid");
        let found: Vec<&str> = mesh.regions.iter().map(|r| r.name.as_str()).collect();
        assert_eq!(found, names);
        let tets = |id| {
            let all = mesh.templates.iter().flat_map(|t| &t.tets);
            all.filter(|t| t.region == id).count()
        };
        assert!(tets(2) > 100, "the size is for the second region");
        assert!(mesh.history[0].arguments.iter().any(|a| a.contains("two")));
    }
}
