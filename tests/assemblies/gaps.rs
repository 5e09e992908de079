//! Gaps that stay between solids are said.

use bodies::{Body, Face, Material};
use glam::DVec3;
use serde_json::Value;
use support::{EXACT_STL, encode, finish};
use tmesh::Group;

/// Boxes by their lowest and highest corners, a solid each.
fn boxes(list: &[[DVec3; 2]]) -> Body {
    let mut body = Body {
        vertices: Vec::new(),
        faces: Vec::new(),
        materials: Vec::new(),
        order: 1,
        group: Group::TRIVIAL,
    };
    for (i, [low, high]) in list.iter().enumerate() {
        let first = body.vertices.len() as u32;
        body.vertices.extend((0..8).map(|c| {
            let pick = |bit: usize, axis: usize| match c & bit {
                0 => low[axis],
                _ => high[axis],
            };
            DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
        }));
        for [a, b, c, d] in [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ] {
            for t in [[a, b, c], [a, c, d]] {
                body.faces.push(Face {
                    vertices: t.map(|v| v + first),
                    front: None,
                    back: Some(i),
                });
            }
        }
        body.materials.push(Material {
            name: format!("box{i}"),
        });
    }
    body
}

/// What symdetect says of boxes, and the gaps of its report.
fn said(list: &[[DVec3; 2]], arguments: &[&str]) -> (String, Vec<Value>) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("report.json");
    let mut command = std::process::Command::new(support::binary("symdetect"));
    command.arg("--allow-asymmetric").args(arguments);
    command.arg("--report").arg(&path);
    let outcome = finish("symdetect", command, &encode(&boxes(list), EXACT_STL));
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    let report = std::fs::read(path).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let gaps = report.get("gaps").and_then(Value::as_array).cloned();
    (outcome.stderr, gaps.unwrap_or_default())
}

fn corner(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

#[test]
fn the_narrowest_gap_is_said_and_all_pairs_are_reported() {
    let stack = [
        [corner(0.0, 0.0, 0.0), corner(4.0, 4.0, 1.0)],
        // Beams that cross in their middles, whose corners are not over each other.
        [corner(-3.0, 1.0, 1.25), corner(7.0, 2.0, 2.0)],
        [corner(1.0, -3.0, 2.125), corner(2.0, 7.0, 3.0)],
        // Too far away to be a gap.
        [corner(0.0, 0.0, 30.0), corner(1.0, 1.0, 31.0)],
    ];
    let (stderr, gaps) = said(&stack, &[]);
    let line = "between 'box1' and 'box2' a gap of 0.125 stays near";
    assert!(stderr.contains(line), "{stderr}");
    assert!(stderr.contains("2 pairs of solids"), "{stderr}");
    assert!(stderr.contains("--contact-gap LENGTH"), "{stderr}");
    let found: Vec<(&Value, f64)> = (gaps.iter())
        .map(|g| (&g["regions"], g["width"].as_f64().expect("a number")))
        .collect();
    let [one, other] = [["box1", "box2"], ["box0", "box1"]].map(|pair| serde_json::json!(pair));
    assert_eq!(found, [(&one, 0.125), (&other, 0.25)]);
    let z = gaps[0]["near"][2].as_f64().expect("a number");
    assert!((z - 2.0625).abs() < 1e-12, "{z}");
}

#[test]
fn solids_that_touch_and_gaps_that_are_closed_are_no_gaps() {
    let near = [
        [corner(0.0, 0.0, 0.0), corner(4.0, 4.0, 1.0)],
        [corner(1.0, 1.0, 1.0625), corner(2.0, 2.0, 2.0)],
    ];
    let (stderr, gaps) = said(&near, &[]);
    assert!(stderr.contains("a gap of 0.0625"), "{stderr}");
    assert_eq!(gaps.len(), 1);
    let (stderr, gaps) = said(&near, &["--contact-gap", "0.1"]);
    assert!(!stderr.contains("a gap of"), "{stderr}");
    assert!(gaps.is_empty(), "{gaps:?}");
    let touching = [near[0], [corner(1.0, 1.0, 1.0), corner(2.0, 2.0, 2.0)]];
    let (stderr, gaps) = said(&touching, &[]);
    assert!(!stderr.contains("a gap of"), "{stderr}");
    assert!(gaps.is_empty(), "{gaps:?}");
}
