//! The command line of `rotassemble`, over the real binary.

#[allow(dead_code)]
#[path = "../tools/rotassemble/tests/common/structured.rs"]
mod structured;

use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use structured::Structured;
use tmesh::Document;

fn wedge() -> Structured {
    Structured {
        order: 6,
        mirror: true,
        flip: false,
        bore: 0.0,
        radius: 2.0,
        cells: [3, 2, 2],
    }
}

fn bytes(document: &Document) -> Vec<u8> {
    let mut bytes = Vec::new();
    tmesh::write(document, &mut bytes).unwrap();
    bytes
}

/// Runs the tool with the given standard input.
fn run(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_rotassemble"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_vec();
    // The tool may end without reading.
    let feeder = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    feeder.join().unwrap();
    output
}

#[track_caller]
fn succeeds(arguments: &[&str], input: &[u8]) -> Vec<u8> {
    let output = run(arguments, input);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
    assert_eq!(stderr, "");
    output.stdout
}

#[track_caller]
fn fails(arguments: &[&str], input: &[u8], code: i32, sentence: &str) {
    let output = run(arguments, input);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{stderr}");
    assert!(stderr.contains(sentence), "{stderr}");
    assert!(output.stdout.is_empty());
}

#[test]
fn legacy_vtk_by_default() {
    let output = succeeds(&[], &bytes(&wedge().document()));
    let text = String::from_utf8_lossy(&output);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("# vtk DataFile Version 3.0"));
    let title = "symtet C6v order=6 mirror=1 axis=0,0,0,0,0,1,1,0,0";
    assert_eq!(lines.next(), Some(title));
    assert!(!text.contains("marker"));
    let with_boundary = succeeds(&["--boundary"], &bytes(&wedge().document()));
    assert!(String::from_utf8_lossy(&with_boundary).contains("\nmarker 1 "));
}

#[test]
fn the_expanded_document_can_be_assembled_again() {
    let input = bytes(&wedge().document());
    let expanded = succeeds(&["--to", "tmesh"], &input);
    let document = tmesh::read(expanded.as_slice()).unwrap();
    assert!(document.is_plain());
    assert_eq!(document.history.len(), 1);
    assert_eq!(document.history[0].arguments, ["--to", "tmesh"]);
    let promise = document.symmetry.unwrap().promise.unwrap();
    assert_eq!((promise.order, promise.mirror), (6, true));
    assert!(succeeds(&[], &expanded) == succeeds(&[], &input));
}

#[test]
fn instances_and_sector() {
    let document = wedge().document();
    let input = bytes(&document);
    let kept = tmesh::read(succeeds(&["--instances"], &input).as_slice()).unwrap();
    assert_eq!(
        (kept.templates, kept.instances.len()),
        (document.templates.clone(), 12)
    );
    let sector = succeeds(&["--sector", "--to", "tmesh"], &input);
    let sector = tmesh::read(sector.as_slice()).unwrap();
    assert_eq!(
        (sector.templates, sector.instances.len()),
        (document.templates, 1)
    );
    let wedge = succeeds(&["--sector", "--boundary"], &input);
    let text = String::from_utf8_lossy(&wedge);
    assert!(text.contains("1 wall-a\n2 wall-b\n"), "{text}");
    fails(
        &["--instances", "--to", "vtk"],
        &input,
        2,
        "vtk has no instances",
    );
    fails(
        &["--instances", "--sector"],
        &input,
        2,
        "cannot be used with",
    );
}

#[test]
fn surfaces_and_listings() {
    let mut document = wedge().document();
    let listing = succeeds(&["--to", "txt"], &bytes(&document));
    let listing = String::from_utf8(listing).unwrap();
    assert!(listing.contains("instances: 12\n"), "{listing}");
    assert!(listing.contains("WALL"), "{listing}");
    document.templates[0].tets.clear();
    let stl = succeeds(&["--to", "stl"], &bytes(&document));
    let all = succeeds(&["--to", "stl", "--surface", "all"], &bytes(&document));
    assert!(84 < stl.len() && stl.len() < all.len());
    let vtk = succeeds(&[], &bytes(&document));
    assert!(String::from_utf8_lossy(&vtk).contains("\nmarker 1 "));
}

#[test]
fn the_format_follows_the_extension() {
    let folder = tempfile::tempdir().unwrap();
    let input = bytes(&wedge().document());
    let heads: [(&str, &[u8]); 5] = [
        ("a.vtk", b"# vtk DataFile Version 3.0\n"),
        ("a.vtu", b"<?xml version=\"1.0\"?>\n<VTKFile"),
        ("a.tmesh", &tmesh::MAGIC),
        ("a.stl", b"binary STL"),
        ("a.txt", b"tmesh document"),
    ];
    for (name, head) in heads {
        let path = folder.path().join(name);
        let output = succeeds(&["-o", path.to_str().unwrap()], &input);
        assert!(output.is_empty());
        assert!(fs::read(&path).unwrap().starts_with(head), "{name}");
    }
    let path = folder.path().join("a.off");
    fails(
        &["-o", path.to_str().unwrap()],
        &input,
        2,
        "off is not an output format",
    );
    // Nothing unfinished is left behind.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), heads.len());
}

#[test]
fn failures() {
    let input = bytes(&wedge().document());
    fails(&[], &[], 3, "did the previous stage fail?");
    fails(&[], &input[..input.len() / 2], 3, "cut off");
    fails(&["-o", "/no/such/folder/a.vtk"], &input, 4, "cannot write");
    let mut gap = wedge().document();
    gap.instances.truncate(5);
    fails(&[], &bytes(&gap), 3, "has no neighbour");
    let mut bare = wedge().document();
    for wall in &mut bare.templates[0].walls {
        if let tmesh::Wall::Mirror(wall) = wall {
            wall.triangles.clear();
        }
    }
    bare.templates[0].triangles.clear();
    fails(
        &["--to", "stl"],
        &bytes(&bare),
        1,
        "nothing to write as stl",
    );
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported() {
    if Path::new("/dev/full").exists() {
        let input = bytes(&wedge().document());
        for format in ["vtk", "vtu", "tmesh", "stl", "txt"] {
            fails(
                &["--to", format, "-o", "/dev/full"],
                &input,
                4,
                "cannot write /dev/full",
            );
        }
    }
}

#[test]
fn a_reader_that_leaves_ends_it_quietly() {
    // Far more than a pipe holds.
    let large = Structured {
        order: 64,
        cells: [8, 4, 8],
        ..wedge()
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.tmesh");
    fs::write(&path, bytes(&large.document())).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_rotassemble"))
        .arg(&path)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut some = [0; 100];
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut some).unwrap();
    drop(stdout);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(4));
    assert!(
        output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
