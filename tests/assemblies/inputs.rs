//! Several files as one body.

use crate::motor::{NAMES, assert_regions, motor, regions, solid, write_solids};
use bodies::Encoding;
use serde_json::Value;
use std::path::Path;
use std::process::Command;
use support::{EXACT_STL, Outcome, binary, encode, finish, pipe, read, run};

/// A folder with a motor: a file for each solid, and one of all.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let motor = motor(6);
    write_solids(&motor, folder.path());
    std::fs::write(folder.path().join("all.stl"), encode(&motor, EXACT_STL)).expect("written");
    folder
}

fn symdetect(folder: &Path, arguments: &[&str], input: &[u8]) -> Outcome {
    let mut command = Command::new(binary("symdetect"));
    command.args(arguments).current_dir(folder);
    finish("symdetect", command, input)
}

const FILES: [&str; 4] = ["shaft.stl", "rotor.stl", "magnetN.stl", "magnetS.stl"];

#[test]
fn a_file_for_each_solid_is_the_same_as_one_file_of_all() {
    let folder = folder();
    let whole = symdetect(folder.path(), &["all.stl"], b"").success();
    let parts = [&FILES[..], &["--report", "report.json"]].concat();
    let joined = symdetect(folder.path(), &parts, b"").success();
    let mut documents = [&whole, &joined].map(|bytes| read(bytes));
    let arguments = &documents[1].history[0].arguments;
    assert!(FILES.iter().all(|f| arguments.iter().any(|a| a == f)));
    documents.iter_mut().for_each(|d| d.history.clear());
    assert_eq!(documents[0].regions, documents[1].regions);
    assert_eq!(documents[0].markers, documents[1].markers);
    assert_eq!(documents[0].symmetry, documents[1].symmetry);
    assert_eq!(documents[0].source, documents[1].source);
    let report = std::fs::read(folder.path().join("report.json")).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    assert_eq!(report["files"], serde_json::json!(FILES));
    let mesh = pipe(
        &[
            &["wedgecut"],
            &["tetwedge"],
            &["rotassemble", "--to", "tmesh"],
        ],
        &joined,
    )
    .pop()
    .expect("a stage")
    .success();
    run("meshqual", &["--check"], &mesh).success();
    assert_regions(&regions(&mesh), &motor(6), "the mesh");
}

#[test]
fn files_of_different_formats_and_standard_input_are_one_body() {
    let folder = folder();
    let motor = motor(6);
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("rotor.obj"), encode(&solid(&motor, 1), Encoding::Obj)).expect("written");
    std::fs::write(path("n.poly"), encode(&solid(&motor, 2), Encoding::Poly)).expect("written");
    std::fs::write(path("s.tmesh"), encode(&solid(&motor, 3), Encoding::Tmesh)).expect("written");
    let shaft = encode(&solid(&motor, 0), EXACT_STL);
    let arguments = [
        "-",
        "rotor.obj",
        "--region",
        "magnetN=n.poly",
        "--region=magnetS=s.tmesh",
    ];
    let joined = symdetect(folder.path(), &arguments, &shaft).success();
    let mut found = regions(&joined);
    assert_eq!(found[0].0, "stdin");
    found[0].0 = "shaft".to_owned();
    assert_regions(&found, &motor, "formats");
    let formats = read(&joined).source.expect("a source").format;
    assert_eq!(formats, "obj, poly, stl, tmesh");
    // Its own name for what comes through the pipe.
    let arguments = ["--region", "shaft=-", "rotor.stl"];
    let joined = symdetect(folder.path(), &arguments, &shaft).success();
    let names: Vec<String> = regions(&joined).into_iter().map(|r| r.0).collect();
    assert_eq!(names, ["rotor", "shaft"]);
}

#[test]
fn solids_of_files_keep_their_names_unless_they_clash() {
    let folder = folder();
    let motor = motor(6);
    // Two files of two solids each, one name in both.
    let two = |first: usize, second: usize, names: [&str; 2]| {
        let mut both = Vec::new();
        for (m, name) in [first, second].into_iter().zip(names) {
            let mut body = solid(&motor, m);
            body.materials[0].name = name.to_owned();
            both.extend(encode(&body, EXACT_STL));
        }
        both
    };
    std::fs::write(
        folder.path().join("inner.stl"),
        two(0, 1, ["shaft", "part"]),
    )
    .expect("written");
    std::fs::write(
        folder.path().join("outer.stl"),
        two(2, 3, ["part", "magnetS"]),
    )
    .expect("written");
    let joined = symdetect(folder.path(), &["inner.stl", "outer.stl"], b"").success();
    let names: Vec<String> = regions(&joined).into_iter().map(|r| r.0).collect();
    assert_eq!(names, ["shaft", "inner-part", "outer-part", "magnetS"]);
    // With a name of its own, a file is one region, without the faces that its solids share.
    let arguments = ["--region", "iron=inner.stl", "outer.stl", "--repair=off"];
    let outcome = symdetect(folder.path(), &arguments, b"");
    assert!(!outcome.stderr.contains("dropped"), "{}", outcome.stderr);
    let joined = outcome.success();
    let found = regions(&joined);
    let names: Vec<&str> = found.iter().map(|r| r.0.as_str()).collect();
    assert_eq!(names, ["part", "magnetS", "iron"]);
    let iron = motor.volume(0) + motor.volume(1);
    assert!((found[2].1 - iron).abs() < 1e-9 * iron);
    let document = read(&joined);
    let markers: Vec<&str> = document.markers.iter().map(|m| m.name.as_str()).collect();
    // A piece of boundary has the file's name before its own where another has that.
    assert_eq!(
        markers,
        [
            "part",
            "magnetS",
            "shaft",
            "iron-part",
            "part/iron",
            "magnetS/iron"
        ]
    );
}

#[test]
fn what_is_left_out_of_documents_is_said() {
    let folder = folder();
    let shaft = symdetect(folder.path(), &["shaft.stl"], b"").success();
    std::fs::write(folder.path().join("shaft.tmesh"), &shaft).expect("written");
    let outcome = symdetect(folder.path(), &["shaft.tmesh", "rotor.stl"], b"");
    let told = "shaft.tmesh: its symmetry left out";
    assert!(outcome.stderr.contains(told), "{}", outcome.stderr);
    let history = read(&outcome.success()).history;
    let tools: Vec<&str> = history.iter().map(|h| h.tool.as_str()).collect();
    assert_eq!(tools, ["symdetect", "symdetect"]);
    let wedge = run("wedgecut", &[], &shaft).success();
    std::fs::write(folder.path().join("wedge.tmesh"), &wedge).expect("written");
    symdetect(folder.path(), &["wedge.tmesh", "rotor.stl"], b"")
        .fails(3, &["wedge.tmesh", "cut already"]);
}

#[test]
fn what_cannot_be_one_body_is_refused_with_the_name_of_the_file() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let text = std::fs::read_to_string(path("rotor.stl")).expect("text");
    std::fs::create_dir(path("old")).expect("made");
    std::fs::write(path("old/rotor.stl"), &text).expect("written");
    let end = text.find("facet normal").expect("a facet");
    let next = text[end + 1..].find("facet normal").expect("another") + end + 1;
    std::fs::write(
        path("open.stl"),
        format!("{}{}", &text[..end], &text[next..]),
    )
    .expect("written");
    std::fs::write(path("cut.stl"), &text[..text.len() / 2]).expect("written");
    std::fs::write(path("empty.stl"), "").expect("written");
    std::fs::write(path("odd.xyz"), "what is this\n").expect("written");
    let cases: [(&[&str], i32, &[&str]); 15] = [
        (&["rotor.stl", "none.stl"], 3, &["cannot read none.stl"]),
        (&["rotor.stl", "old"], 3, &["cannot read old", "directory"]),
        (
            &["rotor.stl", "empty.stl"],
            3,
            &["empty.stl: ", "previous stage"],
        ),
        (
            &["rotor.stl", "odd.xyz"],
            3,
            &["odd.xyz: ", "not recognized"],
        ),
        (&["rotor.stl", "cut.stl"], 3, &["cut.stl: "]),
        (
            &["shaft.stl", "open.stl"],
            3,
            &["open.stl: ", "not closed: 3 open edges"],
        ),
        (
            &["rotor.stl", "old/rotor.stl"],
            2,
            &["rotor.stl and old/rotor.stl", "region 'rotor'"],
        ),
        (
            &["rotor.stl", "--region", "rotor=shaft.stl"],
            2,
            &["region 'rotor'"],
        ),
        (
            &["--region", "a=rotor.stl", "--region", "a=shaft.stl"],
            2,
            &["rotor.stl and shaft.stl", "region 'a'"],
        ),
        (
            &["-", "rotor.stl", "-"],
            2,
            &["standard input is named twice"],
        ),
        (&["--region", "=rotor.stl"], 2, &["name"]),
        (&["--region", "rotor="], 2, &["needs a file"]),
        (&["--region", "rotor.stl"], 2, &["NAME=FILE"]),
        (
            &["--region", "rotor:max-volume=1"],
            2,
            &["stages after this one"],
        ),
        (
            &["rotor.stl", "--region", "again=old/rotor.stl"],
            3,
            &["the 2 inputs together", "'rotor'", "'again'", "overlap"],
        ),
    ];
    for (arguments, code, parts) in cases {
        symdetect(folder.path(), arguments, b"").fails(code, parts);
    }
    // The report of what failed names the files, too.
    let arguments = ["shaft.stl", "open.stl", "--report", "report.json"];
    symdetect(folder.path(), &arguments, b"").fails(3, &["open.stl"]);
    let report = std::fs::read(path("report.json")).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    assert_eq!(
        report["files"],
        serde_json::json!(["shaft.stl", "open.stl"])
    );
    assert_eq!(report["defects"]["open_edges"]["count"], 3, "{report}");
    assert_eq!(NAMES.len(), FILES.len());
}
