//! Meshes for solvers: SU2, I-DEAS universal files, OpenFOAM; the last also judged by OpenFOAM's `checkMesh`.

use crate::referee::{close, is_there, python};
use crate::tools::{coarse_mesh, mesh, rotassemble};
use crate::{BETWEEN_BLADES, TWIST, off_plane, twisted_impeller, via};
use bodies::{Body, Prism, Ratchet};
use serde_json::Value;
use std::path::Path;
use std::process::Command;
use support::{EXACT_STL, encode, run};

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/exports/solvers.py");

#[track_caller]
fn read(kind: &str, path: &Path) -> Value {
    let mut command = Command::new(python().expect("looked for before"));
    let output = command.arg("-B").arg(SCRIPT).arg(kind).arg(path).output();
    let output = output.expect("Python runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{kind}: {errors}");
    let text = String::from_utf8_lossy(&output.stdout);
    let last = text.lines().last().unwrap_or_default();
    serde_json::from_str(last).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[track_caller]
fn export(input: &Path, output: &Path, options: &[&str]) {
    let path = output.to_str().expect("text");
    rotassemble(input, &[&["-o", path], options].concat());
}

fn volume(body: &Body) -> f64 {
    (0..body.materials.len()).map(|i| body.volume(i)).sum()
}

/// Area of a named piece of the boundary in the input.
#[track_caller]
fn area(document: &tmesh::Document, name: &str) -> f64 {
    let marker = document.markers.iter().find(|m| m.name == name);
    marker.and_then(|m| m.area).expect("a marker with an area")
}

#[test]
fn solvers_find_the_whole_mesh() {
    if !is_there() {
        return;
    }
    let body = via();
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let cut = ["--order", "8", "--hub", "none"];
    let input = coarse_mesh(folder, &encode(&body, EXACT_STL), &cut);
    let document = tmesh::read(std::fs::read(&input).expect("a file").as_slice()).expect("valid");
    let tets: usize = document.templates.iter().map(|t| t.tets.len()).sum();
    let tets = tets * document.instances.len();
    let case = folder.join("case");
    let files = [
        ("su2", folder.join("a.su2"), folder.join("a.su2")),
        ("unv", folder.join("a.unv"), folder.join("a.unv")),
        ("polymesh", case.join("constant/polyMesh"), case.clone()),
    ];
    let mut points = None;
    for (kind, output, seen) in &files {
        export(&input, output, &[]);
        let found = read(kind, seen);
        assert_eq!(found["tetrahedra"], tets, "{kind}");
        let points = points.get_or_insert(found["points"].clone());
        assert_eq!(&found["points"], points, "{kind}");
        assert!(found["least"].as_f64() > Some(0.0), "{kind}");
        // VTK's reader has points in single precision.
        close(&found["volume"], volume(&body), 1e-6, kind);
        for material in &body.materials {
            let name = &material.name;
            let index = body.materials.iter().position(|m| m.name == *name);
            let own = body.volume(index.expect("it is one of them"));
            match *kind {
                "su2" => close(&found["areas"][name], area(&document, name), 1e-6, kind),
                "unv" => {
                    close(&found["groups"][name], own, 1e-9, kind);
                    let surface = &found["groups"][&format!("{name}-2")];
                    assert!(surface.as_f64() > Some(0.0), "{found}");
                }
                _ => {
                    let patch = &found["patches"][name];
                    assert_eq!(patch["type"], "patch");
                    close(&patch["area"], area(&document, name), 1e-6, kind);
                    let zone = format!("zones/cellZones/{name}");
                    assert!(found["counts"][zone].as_u64() > Some(0), "{found}");
                    let shown = format!("boundary/{name}");
                    assert_eq!(found["counts"][shown], patch["faces"]);
                }
            }
        }
        if *kind == "polymesh" {
            assert!(found["open"].as_f64() < Some(1e-12), "{found}");
            close(&found["volume_by_faces"], volume(&body), 1e-9, kind);
            assert!(found["least_by_faces"].as_f64() > Some(0.0));
        }
    }
}

/// Checks that the sides of a sector of a given order are cyclic patches, images of each other face by face, of a closed
/// mesh.
#[track_caller]
fn assert_cyclic(found: &Value, order: u32) {
    let [a, b] = ["wall-a", "wall-b"].map(|name| &found["patches"][name]);
    let step = 1.0 / f64::from(order);
    for (patch, other, turn) in [(a, "wall-b", step), (b, "wall-a", -step)] {
        assert_eq!(
            (&patch["type"], &patch["other"]),
            (&"cyclic".into(), &other.into())
        );
        close(&patch["turn"], turn, 1e-12, "the turn");
    }
    assert_eq!(a["faces"], b["faces"]);
    let of_other = b["area"].as_f64().expect("an area");
    close(&a["area"], of_other, 1e-12, "both faces");
    assert!(found["off"].as_f64() < Some(1e-12), "{}", found["off"]);
    assert!(found["open"].as_f64() < Some(1e-12));
}

#[test]
fn a_sector_has_cyclic_patches() {
    if !is_there() {
        return;
    }
    let body = via();
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let cut = ["--domain", "rotation", "--order", "8", "--hub", "none"];
    let cut = [&cut[..], &["--horizontal-mirror", "off"]].concat();
    let input = coarse_mesh(folder, &encode(&body, EXACT_STL), &cut);
    let case = folder.join("case");
    export(&input, &case.join("constant/polyMesh"), &["--sector"]);
    let found = read("polymesh", &case);
    // The body is ten units large.
    assert_cyclic(&found, 8);
    close(
        &found["volume_by_faces"],
        volume(&body) / 8.0,
        1e-9,
        "the sector",
    );
    let deck = folder.join("a.su2");
    export(&input, &deck, &["--sector"]);
    let found = read("su2", &deck);
    close(
        &found["areas"]["wall-a"],
        found["areas"]["wall-b"].as_f64().expect("an area"),
        1e-12,
        "both faces",
    );
    let text = std::fs::read_to_string(deck).expect("a file");
    assert!(text.contains("\n% wall-b is wall-a turned by 1/8\n"));
}

#[test]
fn cyclic_patches_of_a_curved_seam_are_images() {
    if !is_there() {
        return;
    }
    let body = twisted_impeller(7);
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let input = coarse_mesh(folder, &encode(&body, EXACT_STL), &BETWEEN_BLADES);
    let document = tmesh::read(std::fs::read(&input).expect("a file").as_slice()).expect("valid");
    let off = off_plane(&document);
    assert!(off > 0.05, "{off}");
    let case = folder.join("case");
    export(&input, &case.join("constant/polyMesh"), &["--sector"]);
    let found = read("polymesh", &case);
    assert_cyclic(&found, 7);
    let seventh = body.volume(0) / 7.0;
    close(&found["volume_by_faces"], seventh, 1e-6, "the sector");
}

#[test]
fn a_passage_between_blades_has_cyclic_patches_that_follow_them() {
    if !is_there() {
        return;
    }
    let body = twisted_impeller(7);
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    // Turned as the blades are, to far beyond both ends of them.
    let seam = folder.join("seam.txt");
    let line = |r: f64, z: f64| format!("{r} {z} {}\n", TWIST.to_degrees() * z);
    let rows: String = [0.0, 3.0]
        .iter()
        .flat_map(|&r| [line(r, -2.0), line(r, 3.0)])
        .collect();
    std::fs::write(&seam, rows).expect("a file");
    let around = ["-q", "--enclosure", "cylinder:1.2", "--fluid"];
    let passage = run("symdetect", &around, &encode(&body, EXACT_STL)).success();
    let enclosed = tmesh::read(passage.as_slice()).expect("valid");
    let along = ["--hub", "none", "--seam", seam.to_str().expect("text")];
    let input = coarse_mesh(folder, &passage, &along);
    let document = tmesh::read(std::fs::read(&input).expect("a file").as_slice()).expect("valid");
    let off = off_plane(&document);
    assert!(off > 0.2, "{off}");
    let case = folder.join("case");
    export(&input, &case.join("constant/polyMesh"), &["--sector"]);
    let found = read("polymesh", &case);
    assert_cyclic(&found, 7);
    // Blades, inlet, outlet and casing.
    let blades = body.materials[0].name.as_str();
    for name in [
        blades,
        "enclosure-below",
        "enclosure-above",
        "enclosure-side",
    ] {
        let seventh = area(&enclosed, name) / 7.0;
        close(&found["patches"][name]["area"], seventh, 1e-6, name);
    }
    let all = enclosed.source.expect("known").volume;
    close(&found["volume_by_faces"], all / 7.0, 1e-6, "the passage");
}

#[test]
fn mirror_planes_of_a_sector_are_symmetry_planes() {
    if !is_there() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let cut = ["--order", "8", "--hub", "none"];
    let input = coarse_mesh(folder, &encode(&via(), EXACT_STL), &cut);
    let case = folder.join("case");
    export(&input, &case.join("constant/polyMesh"), &["--sector"]);
    let found = read("polymesh", &case);
    for wall in ["wall-a", "wall-b"] {
        assert_eq!(found["patches"][wall]["type"], "symmetryPlane", "{found}");
    }
}

/// The settings that `checkMesh` asks for before it looks at a mesh.
const DICTIONARIES: [(&str, &str); 3] = [
    (
        "controlDict",
        "application none;\nstartFrom startTime;\nstartTime 0;\nstopAt endTime;\nendTime 1;\ndeltaT 1;\n\
         writeControl timeStep;\nwriteInterval 1;\n",
    ),
    (
        "fvSchemes",
        "ddtSchemes {}\ngradSchemes {}\ndivSchemes {}\nlaplacianSchemes {}\ninterpolationSchemes {}\n\
         snGradSchemes {}\n",
    ),
    ("fvSolution", ""),
];

/// What `checkMesh` says of the mesh of a case; nothing where OpenFOAM is not installed, which is said.
#[track_caller]
fn checked(case: &Path) -> Option<String> {
    let system = case.join("system");
    std::fs::create_dir_all(&system).expect("a folder");
    for (name, entries) in DICTIONARIES {
        let head =
            format!("FoamFile {{ version 2.0; format ascii; class dictionary; object {name}; }}");
        std::fs::write(system.join(name), format!("{head}\n{entries}")).expect("a file");
    }
    let mut command = Command::new("checkMesh");
    command.args(["-constant", "-case"]).arg(case);
    if std::env::var_os("WM_PROJECT_DIR").is_none() {
        // Where Debian puts what OpenFOAM's own environment would name.
        command.env("WM_PROJECT_DIR", "/usr/share/openfoam");
    }
    match command.output() {
        Ok(output) => Some(String::from_utf8_lossy(&output.stdout).into_owned()),
        Err(error) => {
            println!("skipped: checkMesh (package openfoam): {error}");
            None
        }
    }
}

#[test]
fn openfoam_finds_no_fault() {
    let prism = Prism {
        order: 8,
        ..Prism::default()
    }
    .build();
    let ratchet = Ratchet {
        order: 12,
        ..Ratchet::default()
    }
    .build();
    for (body, options, patches) in [
        (&prism, &[][..], &[][..]),
        (&prism, &["--sector"], &["symmetryPlane"; 2]),
        (&ratchet, &["--sector"], &["cyclic"; 2]),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        let cut = ["--hub", "none", "--horizontal-mirror", "off"];
        let input = mesh(folder, &encode(body, EXACT_STL), &cut);
        let document = std::fs::read(&input).expect("a file");
        let document = tmesh::read(document.as_slice()).expect("valid");
        let case = folder.join("case");
        export(&input, &case.join("constant/polyMesh"), options);
        let boundary = std::fs::read_to_string(case.join("constant/polyMesh/boundary"));
        let boundary = boundary.expect("a file");
        for kind in patches {
            let count = boundary.matches(&format!(" {kind};")).count();
            assert_eq!(count, patches.len(), "{boundary}");
        }
        let Some(said) = checked(&case) else { return };
        assert!(said.contains("\nMesh OK.\n"), "{options:?}: {said}");
        let copies = if options.is_empty() {
            document.instances.len()
        } else {
            1
        };
        let tets = copies * document.templates[0].tets.len();
        let cells = said.lines().find_map(|l| l.trim().strip_prefix("cells:"));
        assert_eq!(cells.map(str::trim), Some(tets.to_string().as_str()));
    }
}
