//! Messages as objects, of every tool: `--message-format json`.

use serde_json::Value;
use std::fs::File;
use std::process::{Command, Stdio};
use support::{TOOLS, binary, run};

const PYRAMID: &[u8] = include_bytes!("../../formats/tmesh/tests/golden/pyramid.tmesh");

/// Runs a tool; its exit code and the objects on standard error.
#[track_caller]
fn objects(tool: &str, arguments: &[&str], input: &[u8]) -> (i32, Vec<Value>) {
    let output = run(tool, arguments, input);
    let objects = output.stderr.lines();
    let objects = objects.map(|line| match serde_json::from_str(line) {
        Ok(object) => object,
        Err(error) => panic!("{error}: {line}"),
    });
    (output.code, objects.collect())
}

/// The run fails with one object that says why.
#[track_caller]
fn fails(tool: &str, arguments: &[&str], input: &[u8], code: i32, part: &str) {
    let (found, objects) = objects(tool, arguments, input);
    assert_eq!(found, code, "{objects:?}");
    let errors: Vec<_> = objects.iter().filter(|o| o["level"] == "error").collect();
    assert_eq!(errors.len(), 1, "{objects:?}");
    assert_eq!(objects.last(), Some(errors[0]));
    assert_eq!(errors[0]["tool"], tool);
    assert_eq!(errors[0]["code"], code);
    let message = errors[0]["message"].as_str().expect("text");
    assert!(message.contains(part), "{message}");
}

#[test]
fn errors_are_objects() {
    for tool in TOOLS {
        let json = ["--message-format", "json"];
        fails(tool, &json, b"", 3, "did the previous stage fail?");
        fails(tool, &json, &PYRAMID[..500], 3, "cut off at byte 500");
        let nowhere = [json[0], json[1], "/nowhere/mesh.stl"];
        fails(tool, &nowhere, b"", 3, "/nowhere/mesh.stl");
        // The command line itself is wrong, before and after the option.
        let wrong = ["--odd", "--message-format=json"];
        fails(tool, &wrong, b"", 2, "unexpected argument '--odd' found");
        let wrong = ["--message-format=json", "--from", "odd"];
        fails(tool, &wrong, b"", 2, "'odd'");
        let exclusive = ["--message-format=json", "-q", "-v"];
        fails(tool, &exclusive, b"", 2, "cannot be used with");
    }
    let unmet = ["--message-format=json", "--fail-below", "volume=1e9"];
    fails("meshqual", &unmet, PYRAMID, 1, "volume");
    let nowhere = ["--message-format=json", "-o", "/nowhere/report"];
    fails("meshqual", &nowhere, PYRAMID, 4, "/nowhere/report");
}

#[test]
fn other_messages_are_objects_too() {
    let arguments = ["--message-format=json", "--allow-asymmetric", "-vv"];
    let off = b"OFF 4 4 0\n0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let (code, objects) = objects("symdetect", &arguments, off);
    assert_eq!(code, 0, "{objects:?}");
    let has = |level: &str| objects.iter().any(|o| o["level"] == level);
    assert!(has("note") && has("info") && !has("error"), "{objects:?}");
    for object in &objects {
        assert!(object["message"].is_string() && object["tool"] == "symdetect");
        assert_eq!(object["seconds"].is_number(), object["level"] == "info");
    }
}

/// The text on standard error of a run that sends standard output to a file.
#[track_caller]
fn said_to_file(tool: &str, arguments: &[&str], name: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let input = folder.path().join("pyramid.tmesh");
    std::fs::write(&input, PYRAMID).expect("a file");
    let file = File::create(folder.path().join(name)).expect("a file");
    let run = Command::new(binary(tool))
        .args(arguments)
        .arg(&input)
        .stdout(Stdio::from(file))
        .output();
    let output = run.expect("it runs");
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{errors}");
    errors
}

/// `rotassemble > a.vtu` wrote a legacy file, which no reader of `.vtu` opens, without a word.
#[test]
fn a_file_of_the_shell_that_is_named_after_another_format_is_pointed_out() {
    if !cfg!(target_os = "linux") {
        return;
    }
    let said = said_to_file("rotassemble", &[], "a.vtu");
    assert!(
        said.contains("a.vtu gets vtk: standard output is vtk"),
        "{said}"
    );
    assert!(said.contains("--to vtu"), "{said}");
    for (arguments, name) in [
        (&[][..], "a.vtk"),
        (&["--to", "vtu"], "a.vtu"),
        (&[], "mesh"),
        (&["-q"], "a.vtu"),
    ] {
        let said = said_to_file("rotassemble", arguments, name);
        assert_eq!(said, "", "{arguments:?} {name}");
    }
}

#[test]
fn formats_that_cannot_be_written_are_not_offered() {
    for to in ["obj", "ply", "odd"] {
        let said = run("rotassemble", &["--to", to], PYRAMID);
        assert_eq!(said.code, 2);
        assert!(said.stderr.contains("vtk, vtu"), "{}", said.stderr);
        assert!(!said.stderr.contains("smesh"), "{}", said.stderr);
    }
    let said = run("rotassemble", &["-o", "a.off"], PYRAMID);
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("off is not an output format"),
        "{}",
        said.stderr
    );
    let said = run("rotassemble", &["-o", "a.cgns"], PYRAMID);
    assert_eq!(said.code, 2);
    assert!(
        said.stderr.contains("su2, unv, polymesh"),
        "{}",
        said.stderr
    );
    let said = run("symdetect", &["--from", "su2"], b"");
    assert_eq!(said.code, 2);
    assert!(said.stderr.contains("tmesh, stl, obj"), "{}", said.stderr);
}

#[test]
fn a_file_of_a_cad_program_is_told_the_way_to_triangles() {
    let step = b"ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n";
    let said = run("symdetect", &[], step);
    assert_eq!(said.code, 3);
    let way = "gmsh -2 part.step -o part.msh";
    assert!(said.stderr.contains(way), "{}", said.stderr);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("wheel.igs");
    std::fs::write(&path, "S      1\n").expect("a file");
    let path = path.to_str().expect("text");
    let said = run("symdetect", &[path], b"");
    let way = format!("gmsh -2 {path} -o {}", path.replace(".igs", ".msh"));
    assert!(said.stderr.contains(&way), "{}", said.stderr);
    let said = run("symdetect", &[], b"anything");
    assert!(
        said.stderr.contains("--from: tmesh, stl"),
        "{}",
        said.stderr
    );
}

/// A surface written in another format lost its symmetry, and the next tool asked for symdetect.
#[test]
fn what_a_foreign_format_loses_is_said() {
    let off = b"OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let said = run("symdetect", &["--to", "stl"], off);
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(
        said.stderr
            .contains("stl holds the mesh, not the symmetry C3v"),
        "{}",
        said.stderr
    );
    let said = run("symdetect", &["-q", "--to", "stl"], off);
    assert_eq!(said.stderr, "");
    // VTK and VTU keep it, but not what is asked of elements.
    let said = run("symdetect", &["--to", "vtk"], off);
    assert!(!said.stderr.contains("vtk holds"), "{}", said.stderr);
    let box_with_size =
        b"8 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n\
        6 0\n1\n4 1 4 3 2\n1\n4 5 6 7 8\n1\n4 1 2 6 5\n1\n4 2 3 7 6\n1\n4 3 4 8 7\n1\n4 4 1 5 8\n\
        0\n1\n1 0.5 0.5 0.5 1 0.01\n";
    let said = run(
        "symdetect",
        &["--from", "poly", "--to", "vtk"],
        box_with_size,
    );
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(
        said.stderr
            .contains("vtk holds the mesh and its symmetry, not what is asked of the elements"),
        "{}",
        said.stderr
    );
    let detected = run("symdetect", &["-q"], off).stdout;
    let said = run("wedgecut", &["--to", "vtu"], &detected);
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(
        said.stderr
            .contains("vtu holds the pieces, not how they are placed"),
        "{}",
        said.stderr
    );
}

/// A surface that had been saved as VTK had to go through symdetect again.
#[test]
fn a_surface_in_vtk_is_cut_like_the_document() {
    let off = b"OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let pieces = ["tmesh", "vtk", "vtu"].map(|format| {
        let found = run("symdetect", &["--to", format], off);
        let cut = run("wedgecut", &["--edge-length", "0.2"], &found.stdout);
        assert_eq!(cut.code, 0, "{format}: {}", cut.stderr);
        let document = tmesh::read(cut.stdout.as_slice()).expect("valid");
        (document.templates, document.instances, document.symmetry)
    });
    assert!(pieces[0].2.is_some());
    assert_eq!(pieces[1], pieces[0]);
    assert_eq!(pieces[2], pieces[0]);
}

/// A folder of files that is there is written into; a file in its place is not replaced.
#[test]
fn a_format_of_a_folder_is_written_into_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("polyMesh");
    let path = target.to_str().expect("text");
    for _ in 0..2 {
        let said = run("rotassemble", &["-o", path], PYRAMID);
        assert_eq!(said.code, 0, "{}", said.stderr);
    }
    let mut names: Vec<_> = std::fs::read_dir(&target)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name())
        .collect();
    names.sort();
    assert_eq!(
        names,
        [
            "boundary",
            "cellZones",
            "faces",
            "neighbour",
            "owner",
            "points"
        ]
    );
    let said = run("rotassemble", &["--to", "polymesh"], PYRAMID);
    assert_eq!(said.code, 2);
    assert!(said.stderr.contains("several files"), "{}", said.stderr);
    let file = folder.path().join("a.polymesh");
    std::fs::write(&file, "kept").expect("a file");
    let said = run(
        "rotassemble",
        &["-o", file.to_str().expect("text")],
        PYRAMID,
    );
    assert_eq!(said.code, 4);
    assert_eq!(std::fs::read(&file).expect("a file"), b"kept");
}

/// A tool tried on its own in a terminal, where neither input nor output is redirected: what it reads is the first
/// thing to know, not that its output is binary.
#[test]
fn a_terminal_is_told_that_input_is_missing() {
    for tool in TOOLS {
        let inside = binary(tool);
        let output = Command::new("script")
            .args(["--quiet", "--return", "--command"])
            .arg(&inside)
            .arg("/dev/null")
            .stdin(Stdio::null())
            .output();
        let Ok(output) = output else {
            eprintln!("skipped: there is no program `script`, which gives a terminal");
            return;
        };
        let text = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(2), "{tool}: {text}");
        assert!(text.contains("no input: name a file"), "{tool}: {text}");
        assert!(!text.contains("binary"), "{tool}: {text}");
    }
}

#[test]
fn a_second_mesh_is_told_how_it_is_compared() {
    let outcome = run("meshqual", &["a.vtk", "b.vtk"], b"");
    outcome.fails(2, &["--compare b.vtk"]);
}
