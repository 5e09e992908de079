//! The assembly that is tested, and what is asked of it.

use bodies::{Body, Face, PolarGrid};
use serde_json::Value;
use std::path::Path;
use support::{EXACT_STL, encode, run};
use tmesh::{Group, Kind};

/// The solids of [`motor`].
pub const NAMES: [&str; 4] = ["shaft", "rotor", "magnetN", "magnetS"];

/// A rotor with `poles` magnets around it, north and south by turns, with gaps between them: of order `poles` where magnets are
/// exchanged, and of half that where they keep their names. The shaft is longer at one end.
pub fn motor(poles: usize) -> Body {
    let grid = PolarGrid {
        sectors: 4 * poles,
        radii: vec![0.0, 0.5, 1.0, 1.4],
        heights: vec![0.0, 1.0, 1.5],
    };
    let group = Group::new(Kind::Cv, poles as u32);
    grid.build(&NAMES, group, |[i, j, k]| match (j, k) {
        (0, _) => Some(0),
        (1, 0) => Some(1),
        (2, 0) if i % 4 != 3 => Some(2 + i / 4 % 2),
        _ => None,
    })
}

/// One solid of a body.
pub fn solid(body: &Body, material: usize) -> Body {
    let face = |vertices| Face {
        vertices,
        front: None,
        back: Some(0),
    };
    Body {
        faces: body.solid(material).map(face).collect(),
        materials: vec![body.materials[material].clone()],
        ..body.clone()
    }
}

/// Writes each solid of a body as a file of its own, called as the solid.
pub fn write_solids(body: &Body, folder: &Path) {
    for (m, material) in body.materials.iter().enumerate() {
        let bytes = encode(&solid(body, m), EXACT_STL);
        std::fs::write(folder.join(format!("{}.stl", material.name)), bytes)
            .expect("it can be written");
    }
}

/// Name and volume of each region of a document.
pub fn regions(document: &[u8]) -> Vec<(String, f64)> {
    let report = run("meshqual", &["--json", "-"], document).success();
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let regions = report["regions"].as_array().expect("regions");
    let of = |r: &Value| {
        let name = r["name"].as_str().expect("a name").to_owned();
        (name, r["volume"].as_f64().expect("a number"))
    };
    regions.iter().map(of).collect()
}

/// Checks that regions have the names and, but for rounding, the volumes of a body's solids.
#[track_caller]
pub fn assert_regions(found: &[(String, f64)], body: &Body, what: &str) {
    let names: Vec<&str> = found.iter().map(|r| r.0.as_str()).collect();
    let wanted: Vec<&str> = body.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, wanted, "{what}");
    for (m, (name, volume)) in found.iter().enumerate() {
        let exact = body.volume(m);
        assert!(
            (volume - exact).abs() < 1e-9 * exact,
            "{what}: {name} {volume} {exact}"
        );
    }
}
