//! Assemblies whose rotation exchanges solids.

use crate::motor::{NAMES, assert_regions, motor, regions};
use bodies::assembly::assembly;
use bodies::{Body, PolarGrid};
use serde_json::{Value, json};
use support::{EXACT_STL, encode, pipe, read, run};
use tmesh::{Document, Group, Kind};

/// What `symdetect` finds, its report and what it says.
fn detect(body: &Body, arguments: &[&str]) -> (Vec<u8>, Value, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("report.json");
    let path = path.to_str().expect("a plain path");
    let arguments = [arguments, &["--report", path]].concat();
    let outcome = run("symdetect", &arguments, &encode(body, EXACT_STL));
    let said = outcome.stderr.clone();
    let found = outcome.success();
    let report = std::fs::read(path).expect("a report");
    (found, serde_json::from_slice(&report).expect("JSON"), said)
}

/// The mesh that the stages after `symdetect` make, which is checked.
fn mesh(found: &[u8], cut: &[&str], fill: &[&str]) -> Vec<u8> {
    let cut = [&["wedgecut"], cut].concat();
    let fill = [&["tetwedge"], fill].concat();
    let stages: [&[&str]; 3] = [&cut, &fill, &["rotassemble", "--to", "tmesh"]];
    let mesh = pipe(&stages, found).pop().expect("a stage").success();
    run("meshqual", &["--check"], &mesh).success();
    mesh
}

/// Tetrahedra in a region, and the largest volume of one.
fn largest(document: &Document, region: u32) -> (usize, f64) {
    let template = &document.templates[0];
    let volumes = template
        .tets
        .iter()
        .filter(|t| t.region == region)
        .map(|t| {
            let [a, b, c, d] = t.vertices.map(|v| template.vertices[v as usize]);
            (b - a).cross(c - a).dot(d - a) / 6.0
        });
    volumes.fold((0, 0.0), |(n, most), v| (n + 1, v.max(most)))
}

#[test]
fn magnets_by_turns_are_images_of_each_other_unless_names_are_to_be_kept() {
    for poles in [2, 4, 6, 10] {
        let body = motor(poles);
        let half = poles / 2;
        let (found, report, said) = detect(&body, &[]);
        assert_eq!(report["group"], format!("C{poles}v"));
        assert_eq!(report["exchanged_regions"], json!([[3, 4]]));
        let keeping = json!({"group": format!("C{half}v"), "order": half});
        assert_eq!(report["keeping_regions"], keeping);
        let told = format!(
            "order {poles} (C{poles}v) exchanging regions magnetN and magnetS; order {half} (C{half}v) keeping them"
        );
        assert!(said.contains(&told), "{said}");
        assert_regions(&regions(&mesh(&found, &[], &[])), &body, "exchanged");

        let (kept, report, said) = detect(&body, &["--regions", "keep"]);
        assert_eq!(report["group"], format!("C{half}v"));
        assert_eq!(report["exchanged_regions"], Value::Null);
        assert_eq!(report["keeping_regions"], Value::Null);
        assert!(!said.contains("exchanging"), "{said}");
        let cut = read(&run("wedgecut", &[], &kept).success());
        assert!(cut.region_maps.is_empty(), "instances rename regions");
        assert_regions(&regions(&mesh(&kept, &[], &[])), &body, "kept");
    }
}

#[test]
fn an_order_that_exchanges_regions_does_not_hold_where_they_are_kept() {
    let body = encode(&motor(6), EXACT_STL);
    run("symdetect", &["--order", "6"], &body).success();
    run("symdetect", &["--order", "3", "--regions", "keep"], &body).success();
    let arguments = ["--order", "6", "--regions", "keep"];
    run("symdetect", &arguments, &body).fails(1, &["order 6 does not hold"]);
    run("symdetect", &["--regions", "swap"], &body).fails(2, &["--regions"]);
}

#[test]
fn balls_and_phases_that_are_regions_each_are_one_orbit() {
    // A ring of twelve balls between races, and coils of three phases around them; every ball has a name of its own.
    let balls: Vec<String> = (0..12).map(|i| format!("ball{i}")).collect();
    let mut names = vec!["race", "a", "b", "c"];
    names.extend(balls.iter().map(String::as_str));
    let grid = PolarGrid {
        sectors: 48,
        radii: vec![0.6, 1.0, 1.2, 1.4, 1.7],
        heights: vec![0.0, 0.4],
    };
    let body = grid.build(&names, Group::new(Kind::Dh, 12), |[i, j, _]| match j {
        0 | 2 => Some(0),
        1 => (i % 4 < 2).then_some(4 + i / 4),
        _ => (i % 4 < 2).then_some(1 + i / 4 % 3),
    });
    let (found, report, said) = detect(&body, &[]);
    assert_eq!(report["group"], "D12h");
    // How far other orders are off is measured wherever regions are.
    let rejected = report["rejected"].as_array().expect("orders");
    let off = |r: &Value| r["residual"].as_f64().expect("a number");
    assert!(!rejected.is_empty() && rejected.iter().all(|r| off(r) > 1e-3 && off(r) < 0.2));
    let orbits: Vec<Vec<u32>> = vec![(2..=4).collect(), (5..=16).collect()];
    assert_eq!(report["exchanged_regions"], json!(orbits));
    // The mirror plane across the axis keeps all.
    assert_eq!(
        report["keeping_regions"],
        json!({"group": "C1h", "order": 1})
    );
    let told = "exchanging regions a, b and c, and ball0, ball1, ball2 and 9 more; order 1 (C1h)";
    assert!(said.contains(told), "{said}");
    let whole = mesh(&found, &[], &[]);
    assert_regions(&regions(&whole), &body, "D12h");
    for order in ["3", "4"] {
        let part = mesh(&found, &["--order", order, "--domain", "rotation"], &[]);
        assert_regions(&regions(&part), &body, order);
    }
    let (kept, report, _) = detect(&body, &["--regions", "keep"]);
    // The same mirror plane: without a rotation, the axis lies in it.
    assert_eq!(report["group"], "C1v");
    assert_regions(&regions(&mesh(&kept, &[], &[])), &body, "kept");
}

#[test]
fn solids_of_other_shapes_are_not_exchanged() {
    // One of the magnets is a little higher than the others.
    let grid = PolarGrid {
        sectors: 12,
        radii: vec![0.5, 1.0, 1.4],
        heights: vec![0.0, 1.0, 1.1],
    };
    let names = ["rotor", "north", "south"];
    let body = grid.build(&names, Group::new(Kind::Cv, 2), |[i, j, k]| match (j, k) {
        (0, 0) => Some(0),
        (1, 0) if i % 3 < 2 => Some(1 + i / 3 % 2),
        (1, 1) if i % 6 < 2 => Some(1),
        _ => None,
    });
    let (found, report, said) = detect(&body, &[]);
    assert_eq!(
        (&report["group"], &report["exchanged_regions"]),
        (&json!("C2v"), &Value::Null)
    );
    assert!(!said.contains("exchanging"), "{said}");
    assert_regions(&regions(&mesh(&found, &[], &[])), &body, "unlike");
}

#[test]
fn a_size_for_a_solid_holds_in_its_images() {
    let body = motor(6);
    let (found, _, _) = detect(&body, &[]);
    for name in ["magnetN", "magnetS"] {
        let size = format!("{name}:max-volume=0.001");
        let bytes = mesh(&found, &["--region", &size], &[]);
        let document = read(&bytes);
        for id in [3, 4] {
            let (count, most) = largest(&document, id);
            assert!(
                count > 500 && most < 0.0013,
                "{name} in {}: {count} {most}",
                NAMES[id as usize - 1]
            );
        }
        let (_, most) = largest(&document, 2);
        assert!(most > 0.002, "{name}: {most} in the rotor");
    }
}

/// A curved seam through solids that the rotation exchanges has one of them on either side: vertices inside of it moved as
/// they do in one solid, by which regions of the wedge had other volumes, and the mesh was refused.
#[test]
fn a_curved_seam_through_exchanged_solids_keeps_their_volumes() {
    let pieces = assembly(556_582);
    let found = run("symdetect", &["-q"], &encode(&pieces.body, pieces.encoding)).success();
    let cut = [
        "--domain",
        "rotation",
        "--seam",
        "auto",
        "--deviation",
        "1.22e-5",
    ];
    let wedge = run("wedgecut", &cut, &found).success();
    let surface = run("periodic-surf", &["-q"], &wedge).success();
    let filled = run("tetwedge", &["-q"], &surface).success();
    run("meshqual", &["-q", "--check"], &filled).success();
}
