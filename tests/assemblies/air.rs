//! Bodies in air.

use crate::motor::{assert_regions, motor, regions};
use bodies::{
    AlternatingWheel, Antiprism, Body, Gear, HelicalGear, Impeller, Material, Placement, Prism,
    Ratchet, SawWheel, Tessellation, cube,
};
use serde_json::Value;
use support::{EXACT_STL, encode, pipe, read, run};

/// The mesh that all stages make of a body in air, which is checked; and the document before it is cut.
fn meshed(body: &Body, arguments: &[&str]) -> (Vec<u8>, Vec<u8>) {
    let arguments = [&["symdetect"], arguments].concat();
    let bytes = encode(body, EXACT_STL);
    let found = run("symdetect", &arguments[1..], &bytes).success();
    let stages: [&[&str]; 3] = [
        &["wedgecut"],
        &["tetwedge"],
        &["rotassemble", "--to", "tmesh"],
    ];
    let mesh = pipe(&stages, &found).pop().expect("a stage").success();
    run("meshqual", &["--check"], &mesh).success();
    (found, mesh)
}

/// Area of a regular polygon around a circle.
fn around(sides: u32, radius: f64) -> f64 {
    f64::from(sides) * radius * radius * (std::f64::consts::PI / f64::from(sides)).tan()
}

/// Checks volumes and names of a body in air whose outer boundary has this volume.
#[track_caller]
fn assert_in_air(body: &Body, mesh: &[u8], outer: f64, what: &str) {
    let mut found = regions(mesh);
    let (name, volume) = found.pop().expect("a region");
    assert_eq!(name, "air", "{what}");
    let air = outer - body.total_volume();
    assert!((volume - air).abs() < 1e-9 * air, "{what}: {volume} {air}");
    assert_regions(&found, body, what);
}

#[test]
fn a_motor_in_a_cylinder_of_air() {
    for (poles, sides) in [(2, 24), (6, 24), (10, 30)] {
        let body = motor(poles);
        let (found, mesh) = meshed(&body, &["--enclosure", "cylinder:2"]);
        let outer = around(sides, 2.8) * 3.0;
        assert_in_air(&body, &mesh, outer, &format!("{poles} poles"));
        let document = read(&found);
        let symmetry = document.symmetry.expect("found");
        assert_eq!(symmetry.group.symbol(), format!("C{poles}v"));
        assert!((symmetry.radius - 2.8).abs() < 0.1);
        let marker = document.markers.last().expect("a marker");
        assert_eq!(marker.name, "enclosure");
        let sheath =
            2.0 * f64::from(sides) * 2.8 * (std::f64::consts::PI / f64::from(sides)).tan() * 3.0;
        let area = 2.0 * around(sides, 2.8) + sheath;
        assert!((marker.area.expect("known") - area).abs() < 1e-9 * area);
        assert!((document.source.expect("known").boundary_area - area).abs() < 1e-9 * area);
    }
}

#[test]
fn bodies_of_other_groups_anywhere_in_space() {
    let antiprism = Antiprism {
        order: 5,
        radius: 1.0,
        bore: 0.4,
        height: 0.8,
    };
    let [radius, bore, height] = [1.0, 0.4, 0.5];
    let alternating = AlternatingWheel {
        order: 4,
        radius,
        bore,
        height,
    };
    let saw = SawWheel {
        order: 9,
        radius,
        bore,
        height,
    };
    let bodies: [(&str, Body); 7] = [
        ("antiprism", antiprism.build()),
        ("alternating", alternating.build()),
        ("saw", saw.build()),
        (
            "ratchet",
            Ratchet {
                order: 7,
                ..Ratchet::default()
            }
            .build(),
        ),
        (
            "gear",
            Gear {
                order: 5,
                ..Gear::default()
            }
            .build(),
        ),
        (
            "helical",
            HelicalGear {
                order: 5,
                radius: 1.0,
                bore: 0.4,
                height: 0.6,
                twist: 0.3,
                layers: 3,
            }
            .build(),
        ),
        (
            "prism",
            Prism {
                order: 6,
                ..Prism::default()
            }
            .build(),
        ),
    ];
    for (name, mut body) in bodies {
        let placement = Placement {
            rotate: Some(3),
            ..Placement::default()
        };
        placement.apply(&mut body);
        let (found, mesh) = meshed(&body, &["--enclosure", "cylinder:1.5"]);
        let document = read(&found);
        let air = document
            .regions
            .last()
            .and_then(|r| r.volume)
            .expect("known");
        let outer = air + body.total_volume();
        assert_in_air(&body, &mesh, outer, name);
    }
}

#[test]
fn a_box_of_air_where_angles_are_right() {
    let mut body = cube(2.0, Tessellation::Symmetric);
    body.materials = vec![Material {
        name: "copper".to_owned(),
    }];
    let (_, mesh) = meshed(&body, &["--enclosure", "box:1.5"]);
    assert_in_air(&body, &mesh, 27.0, "cube");
    let body = motor(4);
    let (_, mesh) = meshed(&body, &["--enclosure", "box:2"]);
    let found = regions(&mesh);
    assert_eq!(found.last().map(|r| r.0.as_str()), Some("air"));
    assert_regions(&found[..4], &body, "in a square box");
    // Two magnets are longer than wide.
    let body = motor(2);
    let (found, mesh) = meshed(&body, &["--enclosure", "box:2"]);
    assert_regions(&regions(&mesh)[..4], &body, "in a box");
    assert_eq!(read(&found).symmetry.expect("found").group.symbol(), "C2v");
}

#[test]
fn a_body_without_symmetry_is_in_a_box_along_the_coordinates() {
    let mut body = cube(1.0, Tessellation::Symmetric);
    for p in &mut body.vertices {
        let q = *p;
        p.x += 3.0 + 0.21 * q.y * q.z + 0.1 * q.x * q.y;
        p.y += 0.17 * q.x * q.z + 0.05 * q.y * q.y;
    }
    let mut low = glam::DVec3::INFINITY;
    let mut high = glam::DVec3::NEG_INFINITY;
    for p in &body.vertices {
        (low, high) = (low.min(*p), high.max(*p));
    }
    let arguments = [
        "--allow-asymmetric",
        "--tolerance",
        "1e-6",
        "--enclosure",
        "box:2",
    ];
    let (found, mesh) = meshed(&body, &arguments);
    assert_eq!(read(&found).symmetry.expect("said").group.symbol(), "C1");
    assert_in_air(
        &body,
        &mesh,
        8.0 * (high - low).element_product(),
        "asymmetric",
    );
}

#[test]
fn empty_space_within_is_air_too() {
    let mut body = cube(2.0, Tessellation::Symmetric);
    let hollow = cube(1.0, Tessellation::Symmetric);
    let first = body.vertices.len() as u32;
    let shift = glam::DVec3::new(0.0, 0.0, 0.5);
    body.vertices
        .extend(hollow.vertices.iter().map(|p| p + shift));
    body.faces.extend(hollow.faces.iter().map(|f| bodies::Face {
        vertices: f.vertices.map(|v| v + first),
        front: f.back,
        back: f.front,
    }));
    let (_, mesh) = meshed(&body, &["--enclosure", "box:2"]);
    assert_in_air(&body, &mesh, 64.0, "hollow");
}

#[test]
fn what_flows_past_a_body_is_left_alone_of_it() {
    let impeller = Impeller::default().build();
    let ratchet = Ratchet::default().build();
    let helical = HelicalGear {
        order: 6,
        radius: 1.0,
        bore: 0.3,
        height: 0.5,
        twist: 0.2,
        layers: 2,
    }
    .build();
    for (what, body, parts) in [
        ("impeller", impeller, &["below", "above", "side"][..]),
        // A mirror plane, or half turns, take one end to the other.
        ("ratchet", ratchet, &["ends", "side"]),
        ("helical gear", helical, &["ends", "side"]),
    ] {
        let around = ["--enclosure", "cylinder:1.5"];
        let (both, _) = meshed(&body, &around);
        let (found, mesh) = meshed(&body, &[&around[..], &["--fluid"]].concat());
        let air = read(&both).regions.pop().and_then(|r| r.volume);
        let air = air.expect("known");
        let of_mesh = regions(&mesh);
        assert_eq!(of_mesh.len(), 1, "{what}");
        assert_eq!(of_mesh[0].0, "air", "{what}");
        assert!((of_mesh[0].1 - air).abs() < 1e-9 * air, "{what}");
        let document = read(&found);
        let source = document.source.expect("known");
        assert!((source.volume - air).abs() < 1e-9 * air, "{what}");
        // The surface of the body, and the outer boundary by its parts.
        let mut names = vec![body.materials[0].name.clone()];
        names.extend(parts.iter().map(|part| format!("enclosure-{part}")));
        let markers = document.markers.iter();
        let (found, areas): (Vec<_>, Vec<_>) = markers
            .map(|m| (m.name.clone(), m.area.expect("known")))
            .unzip();
        assert_eq!(found, names, "{what}");
        let all: f64 = areas.iter().sum();
        let boundary = source.boundary_area;
        assert!((all - boundary).abs() < 1e-9 * boundary, "{what}");
    }
}

#[test]
fn enclosures_that_cannot_be_are_refused() {
    let motor = encode(&motor(6), EXACT_STL);
    let cases: [(&str, i32, &[&str]); 7] = [
        (
            "box:2",
            1,
            &[
                "a box cannot have the symmetry C6v",
                "cylinder:FACTOR",
                "--order 2",
            ],
        ),
        ("cylinder:1e300", 1, &["too far away"]),
        ("cylinder:1", 2, &["greater than 1"]),
        ("box:-2", 2, &["greater than 1"]),
        ("cylinder", 2, &["cylinder:FACTOR or box:FACTOR"]),
        ("ball:2", 2, &["cylinder:FACTOR or box:FACTOR"]),
        ("cylinder:wide", 2, &["'wide'"]),
    ];
    for (enclosure, code, parts) in cases {
        let arguments = [format!("--enclosure={enclosure}")];
        run(
            "symdetect",
            &arguments.each_ref().map(String::as_str),
            &motor,
        )
        .fails(code, parts);
    }
    run("symdetect", &["--fluid"], &motor).fails(2, &["--enclosure"]);
    // As the message says.
    let arguments = ["--order", "2", "--enclosure", "box:2"];
    run("symdetect", &arguments, &motor).success();
    let mut named = cube(1.0, Tessellation::Symmetric);
    named.materials[0].name = "air".to_owned();
    let arguments = ["--enclosure", "box:2"];
    run("symdetect", &arguments, &encode(&named, EXACT_STL)).fails(1, &["region 'air' already"]);
    // The report of the failure is written, nothing else is.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("report.json");
    let path = path.to_str().expect("a plain path");
    let arguments = ["--enclosure", "box:2", "--report", path];
    run("symdetect", &arguments, &motor).fails(1, &["a box"]);
    let report = std::fs::read(path).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    assert!(
        report["error"]
            .as_str()
            .is_some_and(|e| e.contains("a box"))
    );
}
