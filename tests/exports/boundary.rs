//! Names of boundary pieces, from the input to the assembled mesh.

use crate::referee::{self, Job, close, read};
use crate::tools::{mesh, rotassemble};
use std::collections::BTreeMap;
use std::fmt::Write;

const ORDER: usize = 6;
const HEIGHT: f64 = 0.8;

/// A triangle's corners, by index, and the name of its piece.
type Facet = ([usize; 3], &'static str);

/// A hexagonal prism: points, triangles with names, and the area of each piece.
fn prism() -> (Vec<[f64; 3]>, Vec<Facet>, BTreeMap<&'static str, f64>) {
    let mut points = Vec::new();
    for z in [0.0, HEIGHT] {
        for k in 0..ORDER {
            let angle = std::f64::consts::TAU * k as f64 / ORDER as f64;
            points.push([libm::cos(angle), libm::sin(angle), z]);
        }
    }
    let mut facets = Vec::new();
    for k in 1..ORDER - 1 {
        facets.push(([0, k + 1, k], "ground"));
        facets.push(([ORDER, ORDER + k, ORDER + k + 1], "inlet"));
    }
    for k in 0..ORDER {
        let next = (k + 1) % ORDER;
        facets.push(([k, next, ORDER + next], "outer-wall"));
        facets.push(([k, ORDER + next, ORDER + k], "outer-wall"));
    }
    let base = 1.5 * 3.0_f64.sqrt();
    let areas = BTreeMap::from([
        ("ground", base),
        ("inlet", base),
        ("outer-wall", 6.0 * HEIGHT),
    ]);
    (points, facets, areas)
}

const PIECES: [&str; 3] = ["ground", "inlet", "outer-wall"];

fn as_stl(points: &[[f64; 3]], facets: &[Facet]) -> String {
    let mut text = String::new();
    for piece in PIECES {
        let _ = writeln!(text, "solid {piece}");
        for (corners, _) in facets.iter().filter(|f| f.1 == piece) {
            text += "facet normal 0 0 0\nouter loop\n";
            for &c in corners {
                let [x, y, z] = points[c];
                let _ = writeln!(text, "vertex {x} {y} {z}");
            }
            text += "endloop\nendfacet\n";
        }
        let _ = writeln!(text, "endsolid {piece}");
    }
    text
}

fn as_obj(points: &[[f64; 3]], facets: &[Facet]) -> String {
    let mut text = String::new();
    for [x, y, z] in points {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for piece in PIECES {
        let _ = writeln!(text, "g {piece}");
        for (corners, _) in facets.iter().filter(|f| f.1 == piece) {
            let [a, b, c] = corners.map(|c| c + 1);
            let _ = writeln!(text, "f {a} {b} {c}");
        }
    }
    text
}

/// Markers 11, 12, 13 instead of names.
fn as_poly(points: &[[f64; 3]], facets: &[Facet]) -> String {
    let mut text = format!("{} 3 0 0\n", points.len());
    for (i, [x, y, z]) in points.iter().enumerate() {
        let _ = writeln!(text, "{} {x} {y} {z}", i + 1);
    }
    let _ = writeln!(text, "{} 1", facets.len());
    for (corners, piece) in facets {
        let marker = 11 + PIECES.iter().position(|p| p == piece).expect("a piece");
        let [a, b, c] = corners.map(|c| c + 1);
        let _ = writeln!(text, "1 0 {marker}\n3 {a} {b} {c}");
    }
    text += "0\n1\n1 0.01 0.02 0.4 7\n";
    text
}

fn as_msh(points: &[[f64; 3]], facets: &[Facet]) -> String {
    let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n".to_owned();
    for (i, piece) in PIECES.iter().enumerate() {
        let _ = writeln!(text, "2 {} \"{piece}\"", 21 + i);
    }
    let _ = writeln!(
        text,
        "3 4 \"steel\"\n$EndPhysicalNames\n$Nodes\n{}",
        points.len()
    );
    for (i, [x, y, z]) in points.iter().enumerate() {
        let _ = writeln!(text, "{} {x} {y} {z}", i + 1);
    }
    let _ = writeln!(text, "$EndNodes\n$Elements\n{}", facets.len());
    for (i, (corners, piece)) in facets.iter().enumerate() {
        let tag = 21 + PIECES.iter().position(|p| p == piece).expect("a piece");
        let [a, b, c] = corners.map(|c| c + 1);
        let _ = writeln!(text, "{} 2 2 {tag} {tag} {a} {b} {c}", i + 1);
    }
    text += "$EndElements\n";
    text
}

#[test]
fn names_given_in_the_input_are_on_the_triangles_of_the_mesh() {
    if !referee::is_there() {
        return;
    }
    let (points, facets, areas) = prism();
    let inputs = [
        ("stl", as_stl(&points, &facets), PIECES),
        ("obj", as_obj(&points, &facets), PIECES),
        ("poly", as_poly(&points, &facets), ["11", "12", "13"]),
        ("msh", as_msh(&points, &facets), PIECES),
    ];
    let temporary = tempfile::tempdir().expect("a folder");
    for (format, text, names) in inputs {
        for domain in ["mirror", "rotation"] {
            let folder = temporary.path().join(format!("{format}-{domain}"));
            std::fs::create_dir(&folder).expect("a folder");
            let input = mesh(
                &folder,
                text.as_bytes(),
                &["--domain", domain, "--order", "6"],
            );
            let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
            let [msh, inp, vtu] = ["a.msh", "a.inp", "a.vtu"].map(path);
            for output in [&msh, &inp, &vtu] {
                rotassemble(&input, &["--boundary", "-o", output]);
            }
            let jobs = [
                Job::new("gmsh", "msh", &msh),
                Job::new("manual", "inp", &inp),
                Job::new("vtk", "vtu", &vtu),
            ];
            for (job, found) in jobs.iter().zip(read(&jobs)) {
                let what = format!("{format}, {domain} domain, {job}");
                for (piece, name) in PIECES.iter().zip(names) {
                    // Names there begin with a letter.
                    let fitted = format!("n{name}");
                    let digits = name.starts_with(|c: char| c.is_ascii_digit());
                    let name = if job.kind == "inp" && digits {
                        &fitted
                    } else {
                        name
                    };
                    close(&found["areas"][name], areas[piece], 1e-6, &what);
                }
                assert_eq!(
                    found["areas"].as_object().expect("areas").len(),
                    3,
                    "{what}"
                );
            }
            if format == "msh" {
                let found = read(&jobs[..1]);
                close(
                    &found[0]["volumes"]["steel"],
                    1.2 * 3.0_f64.sqrt(),
                    1e-9,
                    "steel",
                );
            }
        }
    }
}
