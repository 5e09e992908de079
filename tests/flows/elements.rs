//! What is asked of the elements, and what comes out.

use bodies::{Body, Coating, Prism, Tessellation};
use serde_json::Value;
use support::{EXACT_STL, encode, run};

fn bodies() -> [(&'static str, Body); 2] {
    let tessellation = Tessellation::Symmetric;
    let prism = Prism {
        order: 12,
        tessellation,
        ..Prism::default()
    };
    let ring = Coating {
        order: 8,
        radius: 1.0,
        bore: 0.3,
        thickness: 0.02,
        height: 1.0,
        tessellation,
    };
    [("prism", prism.build()), ("ring", ring.build())]
}

/// Bounds are eased for the mesher where elements are improved afterwards, however far: all are met, and with fewer
/// elements than without.
#[test]
fn bounds_are_met_with_fewer_elements() {
    for (name, body) in bodies() {
        let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
        for (ratio, angle) in [("1.4", "10"), ("2", "15")] {
            let sizes = ["-q", "--radius-edge", ratio, "--max-volume", "0.002"];
            let cut = run("wedgecut", &sizes, &found).success();
            let count = |optimize: &str| {
                let asked = ["--min-dihedral", angle, "--optimize", optimize];
                let filled = run("tetwedge", &[&sizes[..], &asked].concat(), &cut).success();
                let most = format!("radius_edge_ratio={ratio}000001");
                let least = format!("min_dihedral_deg={angle}");
                let beyond = ["--count-above", &most, "--count-below", &least];
                let report = [&["-q", "--check", "--json", "-"], &beyond[..]].concat();
                let report = run("meshqual", &report, &filled).success();
                let report: Value = serde_json::from_slice(&report).expect("JSON");
                let beyond = report["beyond"].as_array().expect("counts");
                let counts: Vec<_> = beyond.iter().map(|b| b["count"].as_u64()).collect();
                (report["tetrahedra"].as_u64().expect("a count"), counts)
            };
            let (off, _) = count("off");
            for optimize in ["130", "170"] {
                let (tets, beyond) = count(optimize);
                let name = format!("{name} {ratio} {angle} {optimize}");
                assert_eq!(beyond, [Some(0), Some(0)], "{name}");
                assert!(tets < off, "{name}: {tets}, {off} without");
            }
        }
    }
}

/// Edges are as long as asked for in the mean, in meshes of hundreds of elements and of tens of thousands.
#[test]
fn edges_have_the_length_asked_for_in_the_mean() {
    for (body, edges) in [
        (bodies::cube(1.0, Tessellation::Symmetric), [0.2, 0.1, 0.05]),
        (bodies()[0].1.clone(), [0.3, 0.2, 0.1]),
    ] {
        let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
        for edge in edges {
            let asked = ["-q", "--edge-length", &edge.to_string()];
            let cut = run("wedgecut", &asked, &found).success();
            let filled = run("tetwedge", &["-q"], &cut).success();
            let report = run("meshqual", &["-q", "--json", "-"], &filled).success();
            let report: Value = serde_json::from_slice(&report).expect("JSON");
            let mean = &report["metrics"]["edge_length"]["mean"];
            let mean = mean.as_f64().expect("a length") / edge;
            assert!((mean - 1.0).abs() < 0.15, "{edge}: {mean}");
        }
    }
}

/// By a volume that holds for all TetGen divides every edge between facets that is longer than its cube root.
#[test]
fn edges_between_facets_may_be_as_long_as_those_asked_for() {
    let prism = Prism {
        order: 24,
        tessellation: Tessellation::Symmetric,
        ..Prism::default()
    };
    let found = run("symdetect", &["-q"], &encode(&prism.build(), EXACT_STL)).success();
    let cut = run("wedgecut", &["-q", "--edge-length", "0.6"], &found).success();
    let filled = run("tetwedge", &["-q"], &cut).success();
    let report = run("meshqual", &["-q", "--check", "--json", "-"], &filled).success();
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let mean = &report["metrics"]["edge_length"]["mean"];
    let mean = mean.as_f64().expect("a length") / 0.6;
    assert!((0.7..1.1).contains(&mean), "{mean}");
}
