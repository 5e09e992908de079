//! What `symdetect` repairs, says and refuses of torn exports.

use bodies::facets::{Facet, binary_stl, unit_cube};
use bodies::torn::torn;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

/// Runs `symdetect` on facets in a folder, with a report.
fn symdetect(folder: &Path, facets: &[Facet], options: &[&str]) -> (Output, Value) {
    std::fs::write(folder.join("body.stl"), binary_stl(b"", facets)).expect("it can be written");
    let output = Command::new(env!("CARGO_BIN_EXE_symdetect"))
        .args(["body.stl", "-o", "body.tmesh", "--report", "report.json"])
        .args(options)
        .current_dir(folder)
        .output()
        .expect("it runs");
    let report = std::fs::read(folder.join("report.json")).unwrap_or_default();
    (output, serde_json::from_slice(&report).unwrap_or_default())
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A cube, one triangle of which has a corner on its edge that its neighbour has not.
fn with_a_corner_on_an_edge() -> Vec<Facet> {
    let mut facets = unit_cube([0.0; 3]);
    let [a, b, c] = facets[0];
    let middle = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
    facets[0] = [a, middle, c];
    facets.push([middle, b, c]);
    facets
}

#[test]
fn a_stitched_corner_is_told_and_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let (output, report) = symdetect(folder.path(), &with_a_corner_on_an_edge(), &[]);
    let text = said(&output);
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert!(
        text.contains("1 corner on an edge: stitched, which closes the surface"),
        "{text}"
    );
    assert_eq!(report["group"], "D4h");
    assert_eq!(report["repairs"][0]["name"], "stitched-corners");
    assert_eq!(report["repairs"][0]["count"], 1);
    assert_eq!(report["repairs"][0]["largest_gap"], 0.0);
}

#[test]
fn with_repairs_off_an_open_surface_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let off = ["--repair", "off"];
    let (output, report) = symdetect(folder.path(), &with_a_corner_on_an_edge(), &off);
    let text = said(&output);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("3 open edges (the first from"), "{text}");
    assert_eq!(report["defects"]["open_edges"]["count"], 3);
    let (output, report) = symdetect(folder.path(), &unit_cube([0.0; 3]), &off);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(report["repairs"], Value::Array(Vec::new()));
}

#[test]
fn a_wide_gap_is_refused_with_count_and_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut facets = unit_cube([0.0; 3]);
    facets[7][1][2] += 0.01;
    let (output, _) = symdetect(folder.path(), &facets, &[]);
    let text = said(&output);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(
        text.contains("1 gap is wider than the facets there explain, 0.00999"),
        "{text}"
    );
}

/// Groups found in torn exports and in the same body whole: (alike, others).
fn groups(seeds: std::ops::Range<u64>) -> (usize, usize) {
    let (mut alike, mut others) = (0, 0);
    for seed in seeds {
        let torn = torn(seed);
        let folder = tempfile::tempdir().expect("a folder");
        let run = |facets: &[Facet]| symdetect(folder.path(), facets, &["--allow-asymmetric"]);
        let (output, report) = run(&torn.facets);
        match output.status.code() {
            Some(0) => {}
            Some(3) => continue,
            _ => panic!("seed {seed}: {}", said(&output)),
        }
        let (_, whole) = run(&torn.whole);
        match report["group"] == whole["group"] {
            true => alike += 1,
            false => others += 1,
        }
        let order = report["order"].as_u64().expect("an order");
        let is_known = u64::from(torn.order).is_multiple_of(order) || order <= 2;
        // Sides of a prism that turn by less than 30 degrees may stand for a cylinder, which has all orders.
        let is_round = torn.name.starts_with("prism") && torn.order > 12;
        assert!(
            is_known || is_round || report["axisymmetric"] == true,
            "seed {seed}, {}: order {order} of {}",
            torn.name,
            torn.order
        );
    }
    (alike, others)
}

#[test]
fn torn_exports_have_the_group_of_the_whole() {
    let (alike, others) = groups(0..16);
    assert!(alike > others, "{alike} alike, {others} others");
}

#[test]
#[ignore = "takes minutes: run with --ignored --nocapture for the figures"]
fn five_hundred_torn_exports_have_the_group_of_the_whole() {
    let (alike, others) = groups(0..500);
    println!("{alike} groups are that of the whole, {others} are others");
}
