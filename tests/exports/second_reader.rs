//! The reader in Python, `formats/tmesh/python`, against the one in Rust.

use crate::referee::{close, python};
use crate::tools::{coarse_mesh, mesh, rotassemble};
use bodies::{Encoding, Impeller, Tsv};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use support::{EXACT_STL, encode};
use tmesh::{Document, Isometry};

const SCRIPT: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/tests/exports/second_reader.py"
);
const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/formats/tmesh/tests/golden");

/// The Python that can import some modules, of the environment named or of the system; says so if there is none.
fn python_with(modules: &str) -> Option<PathBuf> {
    let candidates = python().into_iter().chain([PathBuf::from("python3")]);
    let imports = format!("import {modules}");
    let can = |python: &PathBuf| {
        let check = Command::new(python).args(["-c", &imports]).output();
        check.is_ok_and(|output| output.status.success())
    };
    let found = candidates.into_iter().find(can);
    if found.is_none() {
        println!("skipped: no Python that can import {modules}; run make test");
    }
    found
}

fn run(python: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(python);
    command.arg("-B").arg(SCRIPT).args(arguments);
    command.output().expect("Python runs")
}

#[track_caller]
fn succeeds(python: &Path, arguments: &[&str]) -> String {
    let output = run(python, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Expands a document both ways and compares.
#[track_caller]
fn agrees(python: &Path, folder: &Path, document: &Path) {
    let whole = folder.join("whole.tmesh");
    let whole = whole.to_str().expect("text");
    rotassemble(document, &["--to", "tmesh", "-o", whole]);
    succeeds(python, &["same", whole, document.to_str().expect("text")]);
}

#[test]
fn expanded_documents_agree_to_the_bit() {
    let Some(python) = python_with("numpy") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    for name in ["pyramid.tmesh", "column.tmesh", "sized.tmesh"] {
        agrees(&python, folder, &Path::new(GOLDEN).join(name));
    }
    let via = Tsv {
        order: 16,
        core: 0.3,
        thickness: 5e-2,
        ..Tsv::default()
    };
    let via = encode(&via.build(), EXACT_STL);
    let impeller = Impeller {
        order: 5,
        height: 1.0,
        twist: 0.4,
        layers: 3,
        ..Impeller::default()
    };
    let impeller = encode(&impeller.build(), Encoding::Obj);
    for (surface, cut) in [
        (&via, &["--hub", "0.15"][..]),
        (&via, &["--domain", "rotation", "--hub", "none"]),
        (&impeller, &["--hub", "0.15", "--order", "5"]),
        (&impeller, &["--hub", "none"]),
    ] {
        let document = coarse_mesh(folder, surface, cut);
        agrees(&python, folder, &document);
    }
    // Bodies that their group turns over: half turns, rotary reflections.
    let bar = bodies::TwistedBar {
        radius: 1.0,
        aspect: 2.0,
        bore: 0.0,
        height: 3.0,
        twist: 1.2,
        layers: 6,
    };
    let wheel = bodies::AlternatingWheel {
        order: 4,
        radius: 1.0,
        bore: 0.3,
        height: 0.5,
    };
    for body in [bar.build(), wheel.build()] {
        let document = coarse_mesh(folder, &encode(&body, Encoding::Obj), &["--hub", "none"]);
        agrees(&python, folder, &document);
    }
}

#[test]
fn cosines_and_sines_agree_to_the_bit() {
    let Some(python) = python_with("numpy") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("angles");
    let small = (1..=128_u32).flat_map(|n| (0..n).map(move |k| (k, n)));
    let large = (0..4096_u32).map(|i| (i * 15 + 1, 65_536 - i));
    let mut bytes = Vec::new();
    let mut count = 0;
    for (k, n) in small.chain(large).filter(|(k, n)| k < n) {
        let turn = Isometry::rotation(i64::from(k), n);
        let (cos, sin) = turn.cos_sin();
        for word in [
            u64::from(turn.k()),
            turn.n().into(),
            cos.to_bits(),
            sin.to_bits(),
        ] {
            bytes.extend(word.to_le_bytes());
        }
        count += 1;
    }
    std::fs::write(&path, bytes).expect("a file");
    let found = succeeds(&python, &["angles", path.to_str().expect("text")]);
    assert_eq!(found.trim(), count.to_string());
}

#[test]
fn what_is_written_in_python_is_the_same_document() {
    let Some(python) = python_with("numpy") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["pyramid.tmesh", "column.tmesh", "sized.tmesh"] {
        let golden = Path::new(GOLDEN).join(name);
        let copy = folder.path().join(name);
        let paths = [&golden, &copy].map(|p| p.to_str().expect("text"));
        succeeds(&python, &["copy", paths[0], paths[1]]);
        let [golden, copy] = [&golden, &copy].map(|p| std::fs::read(p).expect("a file"));
        let [golden, copy] = [&golden, &copy].map(|b| tmesh::read(b.as_slice()).expect("valid"));
        assert_eq!(golden, copy, "{name}");
    }
}

/// Makes a document break a rule.
type Break = fn(&mut Document);

#[test]
fn what_the_specification_forbids_is_refused_by_both() {
    let Some(python) = python_with("numpy") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let golden = std::fs::read(Path::new(GOLDEN).join("column.tmesh")).expect("a file");
    let document = tmesh::read(golden.as_slice()).expect("valid");
    let breaks: [(&str, Break); 12] = [
        ("frame", |d| d.frame.rotation.x_axis.y += 1e-9),
        ("coordinate", |d| d.templates[0].vertices[4].y += 1e-15),
        ("axis", |d| d.templates[1].axis.reverse()),
        ("instance", |d| d.instances[3] = d.instances[1]),
        ("missing", |d| d.instances.truncate(7)),
        ("region", |d| d.templates[0].triangles[0].back = 77),
        ("vertex", |d| d.templates[0].triangles[0].vertices[1] = 0),
        ("facing", |d| {
            d.templates[0].triangles[4].vertices.swap(0, 1)
        }),
        ("pairs", |d| {
            d.templates[0].gluings[0].vertex_pairs.reverse()
        }),
        ("turns", |d| {
            d.instances[0].isometry = Isometry::rotation(1, 65_535);
        }),
        ("name", |d| d.regions[0].name.push('\n')),
        ("table", |d| d.regions.reverse()),
    ];
    let mut paths = Vec::new();
    let mut add = |name: &str, bytes: &[u8]| {
        assert!(tmesh::read(bytes).is_err(), "{name}");
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("a file");
        paths.push(path.to_str().expect("text").to_owned());
    };
    for (name, damage) in breaks {
        let mut broken = document.clone();
        damage(&mut broken);
        let mut bytes = Vec::new();
        tmesh::write(&broken, &mut bytes).expect("memory");
        add(name, &bytes);
    }
    // Every byte of the first chunks and of the last, and every length.
    for place in (0..200).chain(golden.len() - 100..golden.len()) {
        let mut damaged = golden.clone();
        damaged[place] ^= 0x10;
        add(&format!("byte-{place}"), &damaged);
    }
    for length in (0..golden.len()).step_by(37) {
        add(&format!("length-{length}"), &golden[..length]);
    }
    let mut arguments = vec!["refused"];
    arguments.extend(paths.iter().map(String::as_str));
    let said = succeeds(&python, &arguments);
    assert_eq!(said.lines().count(), paths.len(), "{said}");
}

#[test]
fn other_libraries_open_documents() {
    let Some(python) = python_with("numpy, meshio, vtk, pyvista") else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let body = Tsv {
        order: 8,
        core: 0.3,
        thickness: 5e-2,
        ..Tsv::default()
    }
    .build();
    let document = mesh(folder.path(), &encode(&body, EXACT_STL), &[]);
    let path = document.to_str().expect("text");
    let found: Value =
        serde_json::from_str(&succeeds(&python, &["libraries", path])).expect("JSON");
    let document = tmesh::read(std::fs::read(path).expect("a file").as_slice()).expect("valid");
    let tets = |i: &tmesh::Instance| document.templates[i.template as usize].tets.len();
    let tets: usize = document.instances.iter().map(tets).sum();
    let volume: f64 = (0..body.materials.len()).map(|i| body.volume(i)).sum();
    for library in ["meshio", "vtk", "pyvista"] {
        assert_eq!(found[library][1], tets, "{found}");
        assert_eq!(found[library][0], found["meshio"][0], "{found}");
        close(&found[library][2], volume, 1e-9, library);
    }
    let names: Vec<Value> = document
        .regions
        .iter()
        .map(|r| r.name.clone().into())
        .collect();
    assert_eq!(found["names"], Value::Array(names));
    let sets = found["sets"].as_object().expect("sets");
    for name in document.markers.iter().map(|m| &m.name) {
        assert!(sets.contains_key(name), "{name}: {found}");
    }
}
