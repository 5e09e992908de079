//! Bodies whose rotation exchanges regions: two parts that follow each other around the axis.

use bodies::{Body, Face, Tessellation, cube};
use glam::DVec3;
use serde_json::Value;
use support::{EXACT_STL, encode, pipe, run};

/// `2 n` blocks around the axis, of two parts by turns; `shift`, in steps between blocks, turns all.
fn blocks(n: u32, shift: f64) -> Body {
    let block = cube(1.0, Tessellation::Symmetric);
    let mut body = Body {
        vertices: Vec::new(),
        faces: Vec::new(),
        ..block.clone()
    };
    for i in 0..2 * n {
        let first = body.vertices.len() as u32;
        body.vertices.extend(block.vertices.iter().map(|p| {
            let (radius, middle) = (1.25 + 0.5 * p.x, f64::from(i) + shift);
            let angle = std::f64::consts::PI * (middle + 0.6 * p.y) / f64::from(n);
            DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.4 * p.z)
        }));
        body.faces.extend(block.faces.iter().map(|f| Face {
            vertices: f.vertices.map(|v| v + first),
            front: None,
            back: Some(i as usize % 2),
        }));
    }
    body.materials.push(body.materials[0].clone());
    for (material, name) in body.materials.iter_mut().zip(["copper", "steel"]) {
        material.name = name.to_owned();
    }
    body
}

/// Volume of each region of the mesh that the pipe makes.
fn volumes(body: &[u8], cut: &[&str]) -> Vec<f64> {
    let stages: [&[&str]; 4] = [
        &["symdetect"],
        &[&["wedgecut"], cut].concat(),
        &["tetwedge"],
        &["rotassemble", "--to", "tmesh"],
    ];
    let mesh = pipe(&stages, body).pop().expect("a stage").success();
    run("meshqual", &["--check"], &mesh).success();
    let report = run("meshqual", &["--json", "-"], &mesh).success();
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let regions = report["regions"].as_array().expect("regions");
    let volume = |r: &Value| r["volume"].as_f64().expect("a number");
    regions.iter().map(volume).collect()
}

#[test]
fn parts_by_turns_keep_their_volumes_however_they_are_cut() {
    for n in [2, 3, 5] {
        for shift in [0.0, 0.5] {
            let body = encode(&blocks(n, shift), EXACT_STL);
            let step = 180.0 / f64::from(2 * n);
            let angles = [0, 1, 2, -1].map(|k| (f64::from(k) * step).to_string());
            let mut cuts: Vec<Vec<&str>> = vec![vec![]];
            for order in ["1", "2", "3", "5"] {
                if (2 * n).is_multiple_of(order.parse().expect("a number")) {
                    cuts.push(vec!["--order", order]);
                    cuts.push(vec!["--order", order, "--domain", "rotation"]);
                    for angle in &angles {
                        cuts.push(vec!["--order", order, "--start-angle", angle]);
                    }
                }
            }
            for cut in cuts {
                let found = volumes(&body, &cut);
                let [copper, steel] = found[..] else {
                    panic!("{n} {shift} {cut:?}: {found:?}")
                };
                let off = (copper - steel).abs() / copper;
                assert!(off < 1e-9, "{n} {shift} {cut:?}: {found:?}");
            }
        }
    }
}

#[test]
fn regions_that_are_not_what_the_document_says_are_told() {
    let found = run("symdetect", &[], &encode(&blocks(3, 0.0), EXACT_STL)).success();
    let mut document = tmesh::read(found.as_slice()).expect("valid");
    let symmetry = document.symmetry.as_mut().expect("stated");
    assert_eq!(symmetry.rotation_regions().pairs, [[1, 2], [2, 1]]);
    symmetry.regions.clear();
    let mut wrong = Vec::new();
    tmesh::write(&document, &mut wrong).expect("memory");
    let told = [
        "give region 1 the volume",
        "regions are less symmetric than stated",
    ];
    run("wedgecut", &["--order", "6"], &wrong).fails(1, &told);
}

#[test]
fn nastran_meshes_come_back_through_the_tools() {
    let body = encode(&blocks(3, 0.0), EXACT_STL);
    let stages: [&[&str]; 4] = [
        &["symdetect"],
        &["wedgecut"],
        &["tetwedge"],
        &["rotassemble", "--to", "bdf"],
    ];
    let deck = pipe(&stages, &body).pop().expect("a stage").success();
    let regions = |mesh: &[u8]| {
        let report = run("meshqual", &["--json", "-"], mesh).success();
        let report: Value = serde_json::from_slice(&report).expect("JSON");
        report["regions"].as_array().expect("regions").clone()
    };
    // From standard input, where the content alone shows the format.
    let again = run("rotassemble", &["--to", "bdf"], &deck).success();
    let [first, second] = [&deck, &again].map(|mesh| regions(mesh));
    assert_eq!(first, second);
    let names: Vec<&Value> = first.iter().map(|r| &r["name"]).collect();
    assert_eq!(names, ["copper", "steel"]);
    let text = String::from_utf8(deck).expect("text");
    let at = text
        .lines()
        .position(|l| l.starts_with("CTETRA"))
        .expect("an element");
    let damaged = text.replacen("CTETRA  ", "CPENTA  ", 1);
    let line = format!("line {}", at + 1);
    run("meshqual", &[], damaged.as_bytes()).fails(3, &["bdf", &line, "tetrahedra"]);
}
