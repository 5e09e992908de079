//! Flat faces that are bent a little: their folds are no features, unless that is asked for.

use bodies::folded::{bend, folded};
use bodies::{Body, Gear, Prism, Ratchet, Tessellation};
use serde_json::Value;
use support::{EXACT_STL, encode, read, run};

/// Bodies with mirrors and without, each flat and bent by up to an angle (degrees).
fn pairs(angle: f64) -> Vec<(String, [Body; 2])> {
    let tessellation = Tessellation::Symmetric;
    let prism = Prism {
        order: 6,
        bore: 0.2,
        tessellation,
        ..Prism::default()
    };
    let gear = Gear {
        order: 8,
        radius: 1.0,
        bore: 0.3,
        height: 0.5,
        tessellation,
    };
    let ratchet = Ratchet {
        order: 7,
        radius: 1.0,
        bore: 0.3,
        coating: 0.0,
        height: 0.5,
        tessellation,
    };
    let mut pairs = Vec::new();
    for (name, flat) in [
        ("prism", prism.build()),
        ("gear", gear.build()),
        ("ratchet", ratchet.build()),
    ] {
        for seed in 1..4 {
            // The flat one with the same triangles: bends put points into faces.
            let both = [0.0, angle].map(|angle| {
                let mut body = flat.clone();
                bend(&mut body, angle, seed);
                body
            });
            pairs.push((format!("{name} {seed}"), both));
        }
    }
    pairs
}

/// The first percentile of the smallest angles of a mesh that keeps its promises, and its bytes.
fn meshed(body: &Body, options: &[&str]) -> (f64, Vec<u8>) {
    let found = run("symdetect", &["-q"], &encode(body, EXACT_STL)).success();
    let cut = run("wedgecut", &[&["-q"], options].concat(), &found).success();
    let filled = run("tetwedge", &["-q"], &cut).success();
    let checked = ["-q", "--check", "--json", "-"];
    let report = run("meshqual", &checked, &filled).success();
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let p01 = report["metrics"]["min_dihedral_deg"]["p01"].as_f64();
    (p01.expect("a number"), filled)
}

#[test]
fn random_bodies_that_made_trouble_are_meshed() {
    // A needle that faces backwards among those of its patch let others be folded over; TetGen loses its way among seven points in
    // the order in which it sorts them.
    for seed in [68, 218] {
        let solid = folded(seed).solid;
        let found = run("symdetect", &["-q"], &encode(&solid.body, solid.encoding)).success();
        let cut = run("wedgecut", &["-q"], &found).success();
        let filled = run("tetwedge", &["-q", "--timeout", "60"], &cut).success();
        run("meshqual", &["-q", "--check"], &filled).success();
    }
}

#[test]
fn bands_are_not_twisted() {
    // Of bands 38 times as long as wide, vertices at one end were moved: each became two triangles, whose corners elements had to
    // fit into, and the first percentile 10 degrees.
    let (p01, _) = meshed(&folded(615).solid.body, &[]);
    assert!(p01 > 20.0, "{p01}");
}

#[test]
fn needles_of_a_narrow_wedge_are_remeshed() {
    // A ratchet of order 23 with facets of a 570th of its height in the bore: the seam went along the steep side of a tooth, 7 degrees from it, needles
    // in one line stayed in the remeshed bore, and the points that triangles of both sides are near to were doubled with every move there.
    let solid = folded(889).solid;
    let found = run("symdetect", &["-q"], &encode(&solid.body, solid.encoding)).success();
    let cut = run("wedgecut", &[], &found);
    assert!(!cut.stderr.contains("dihedral"), "{}", cut.stderr);
    let (p01, mesh) = meshed(&solid.body, &[]);
    let elements = read(&mesh).templates[0].tets.len();
    assert!(p01 > 20.0 && elements < 20_000, "{p01}, {elements}");
}

/// Share of the first percentile of the flat body that a bent one has at least: points are kept where faces were bent.
const LEAST: f64 = 0.9;

#[test]
fn elements_of_bodies_with_shallow_folds_are_as_good_as_those_of_flat_ones() {
    for angle in [1e-5, 1e-3, 4e-2] {
        for (name, [flat, bent]) in pairs(angle) {
            let [(of_flat, _), (of_bent, mesh)] = [flat, bent].map(|body| meshed(&body, &[]));
            assert!(
                of_bent >= LEAST * of_flat.min(20.0),
                "{name}, bent by {angle}: {of_bent} for {of_flat}"
            );
            // How far the surface was moved is in the document, and is less than the tolerance of the symmetry.
            let moved = read(&mesh).wishes.moved.unwrap_or(0.0);
            assert!(moved < 1e-3, "{name}, bent by {angle}: moved by {moved}");
        }
    }
}

#[test]
fn folds_are_kept_where_no_deviation_is_allowed() {
    let (name, [_, bent]) = pairs(1e-2).swap_remove(0);
    let (_, mesh) = meshed(&bent, &["--deviation", "0"]);
    let kept = read(&mesh);
    assert_eq!(kept.wishes.moved, None, "{name}");
    let source = kept.source.as_ref().expect("a source").volume;
    let copies = kept.instances.iter();
    let each = copies.map(|i| volume(&kept.templates[i.template as usize]));
    let volume: f64 = each.sum();
    assert!((volume / source - 1.0).abs() < 1e-10, "{name}: {volume}");
}

fn volume(template: &tmesh::Template) -> f64 {
    let tets = template.tets.iter().map(|t| {
        let [a, b, c, d] = t.vertices.map(|v| template.vertices[v as usize]);
        geom::measure::tet_volume(a, b, c, d)
    });
    tets.sum()
}
