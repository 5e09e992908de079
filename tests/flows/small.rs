//! Wedges of few elements, whose worst one is a matter of luck.

use bodies::folded::folded;
use serde_json::Value;
use support::{encode, pipe, run};

/// The number of elements and the smallest dihedral angle, degrees, of the mesh of a body of random folds.
fn mesh_of(seed: u64, options: &[&str]) -> (u64, f64) {
    let solid = folded(seed).solid;
    let wedgecut = [&["wedgecut", "-q"], options].concat();
    let stages: [&[&str]; 4] = [
        &["symdetect", "-q"],
        &wedgecut,
        &["tetwedge", "-q"],
        &["rotassemble", "-q", "--to", "tmesh"],
    ];
    let mesh = pipe(&stages, &encode(&solid.body, solid.encoding));
    let mesh = mesh.into_iter().last().expect("a stage").success();
    let report = run("meshqual", &["-q", "--check", "--json", "-"], &mesh).success();
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let count = report["tetrahedra"].as_u64().expect("a number");
    let angle = &report["metrics"]["min_dihedral_deg"]["min"];
    (count, angle.as_f64().expect("an angle"))
}

/// A hub has corners of its own, and a body with no others gets its elements from them: 150, 466 and 258 with the hub.
#[test]
fn bodies_of_few_corners_get_no_more_with_a_hub() {
    for (seed, most, least) in [(504, 60, 30.0), (153, 180, 25.0), (199, 100, 28.0)] {
        let (count, angle) = mesh_of(seed, &[]);
        assert!(count < most && angle > least, "{seed}: {count}, {angle}");
    }
}

/// With one mesh each, 17.6, 22.3, 24.7, 27.0, 26.6 and, with a hub, 11.4 degrees; the meshes of TetGen alone have these.
#[test]
fn small_wedges_are_the_best_of_several_meshes() {
    // By itself, the fourth is cut into larger wedges.
    let bodies: [(u64, f64, &[&str]); 6] = [
        (17, 24.2, &[]),
        (411, 26.4, &[]),
        (670, 26.6, &[]),
        (200, 31.5, &["--order", "4"]),
        (721, 29.4, &[]),
        (816, 12.7, &[]),
    ];
    for (seed, least, options) in bodies {
        let (_, angle) = mesh_of(seed, options);
        assert!(angle > least, "{seed}: {angle}");
    }
}

/// Where a length is asked for, good elements are good enough, and the best mesh is that of the fewest: with angles worth more without
/// end, there are 672, 1408, 216 and 764, with angles of 25 to 39 degrees.
#[test]
fn small_wedges_have_few_elements_where_a_length_is_asked_for() {
    for (seed, length, most) in [
        (411, "0.6", 500),
        (411, "0.35", 1150),
        (5, "0.6", 175),
        (5, "0.35", 720),
    ] {
        let (count, angle) = mesh_of(seed, &["--edge-length", length]);
        assert!(
            count < most && angle > 24.0,
            "{seed} {length}: {count} {angle}"
        );
    }
}
