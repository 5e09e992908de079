//! Chiral bodies drawn with facets that do not share their symmetry: the two sections of a wedge are
//! different drawings of one curve.

use bodies::{Body, Face, Placement, Ratchet, Screw};
use glam::DVec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use support::{EXACT_STL, bytes, encode, read, run};

fn screw(order: u32, facets: u32, drawing: u64, coating: f64) -> Body {
    Screw {
        order,
        radius: 1.0,
        bore: if coating > 0.0 || drawing.is_multiple_of(2) {
            0.4
        } else {
            0.0
        },
        coating,
        height: 0.5,
        twist: 0.25,
        layers: 16,
        facets,
        drawing,
    }
    .build()
}

/// The movement that a cut reports for its sections, model units, and the points inserted.
fn reported(text: &str) -> (f64, usize) {
    let after = |word: &str| text.split(word).nth(1).and_then(|t| t.split(' ').next());
    let moved = after("seam, moved by ").and_then(|t| t.parse().ok());
    let inserted = after(" at most; ").and_then(|t| t.parse().ok());
    moved.zip(inserted).unwrap_or_else(|| panic!("{text}"))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 4,
        max_shrink_iters: 0,
        rng_seed: RngSeed::Fixed(4),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn drawings_without_the_symmetry_are_meshed(
        order in 2..9_u32,
        finer in 1.0..1.8_f64,
        drawing in any::<u64>(),
        coated in any::<bool>(),
        scale in -3..4_i32,
    ) {
        // The sagitta of a thread grows with the square of its number: keep it below the tolerance.
        let facets = (finer * (90.0 + 28.0 * f64::from(order))) as u32;
        let mut body = screw(order, facets, drawing, if coated { 0.06 } else { 0.0 });
        let scale = 10.0_f64.powi(scale);
        let placement = Placement { rotate: Some(drawing), scale, jitter: 0.0 };
        placement.apply(&mut body);
        let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
        let symmetry = read(&found).symmetry.expect("a symmetry");
        prop_assert_eq!(symmetry.group.symbol(), format!("C{order}"), "{}", symmetry.residual);
        prop_assert!((5e-5..3e-3).contains(&symmetry.residual), "{}", symmetry.residual);

        let cut = run("wedgecut", &["-v", "--order", &order.to_string()], &found);
        let (moved, inserted) = reported(&cut.stderr);
        let wedge = read(&cut.success());
        prop_assert!(moved > 0.0 && inserted > 0);
        prop_assert!(moved <= 4.0 * symmetry.residual * symmetry.radius, "{moved} {}", symmetry.residual);
        let history = &wedge.history.last().expect("an entry").notes;
        prop_assert_eq!(reported(&history.join("\n")), (moved, inserted));
        let seam = &wedge.templates[0].gluings[0];
        prop_assert!(seam.is_seam(0));
        for &[b, a] in &seam.vertex_pairs {
            let [p, q] = [a, b].map(|v| wedge.templates[0].vertices[v as usize]);
            prop_assert_eq!(seam.step.apply(p), q);
        }

        let surface = run("periodic-surf", &["-q"], &cut_again(&found)).success();
        let filled = run("tetwedge", &["-q"], &surface).success();
        let whole = run("rotassemble", &["-q", "--to", "tmesh"], &filled).success();
        let json = std::env::temp_dir().join(format!("sections-{}-{drawing}.json", std::process::id()));
        run("meshqual", &["-q", "--check", "--json", &json.to_string_lossy()], &whole).success();
        let text = std::fs::read_to_string(&json).expect("a report");
        std::fs::remove_file(&json).expect("it can go");
        let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let volume = report["volume"].as_f64().expect("a volume");
        let error = (volume / body.total_volume() - 1.0).abs();
        prop_assert!(error <= 2.0 * symmetry.residual, "{error} {}", symmetry.residual);
    }
}

fn cut_again(found: &[u8]) -> Vec<u8> {
    run("wedgecut", &["-q"], found).success()
}

#[test]
fn sections_that_differ_more_are_refused() {
    let found = run(
        "symdetect",
        &["-q"],
        &encode(&screw(5, 160, 2, 0.0), EXACT_STL),
    )
    .success();
    let mut document = read(&found);
    document.symmetry.as_mut().expect("a symmetry").residual = 1e-6;
    let stated = bytes(&document);
    run("wedgecut", &[], &stated).fails(1, &["sections", "tolerance", "near ("]);
}

#[test]
fn sections_that_differ_in_topology_are_refused() {
    let body = Ratchet {
        order: 3,
        bore: 0.3,
        ..Ratchet::default()
    }
    .build();
    let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
    let direction = DVec3::from(read(&found).symmetry.expect("a symmetry").reference);
    // A void where one of the sections is.
    let mut hollow = body;
    let centre = 0.6 * direction + DVec3::new(0.0, 0.0, 0.25);
    let first = hollow.vertices.len() as u32;
    for corner in [
        [1.0, 1.0, 1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
    ] {
        hollow.vertices.push(centre + 0.01 * DVec3::from(corner));
    }
    for corners in [[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]] {
        hollow.faces.push(Face {
            vertices: corners.map(|v| first + v),
            front: Some(0),
            back: None,
        });
    }
    let hollow = encode(&hollow, EXACT_STL);
    run("symdetect", &["-q", "--order", "3"], &hollow).fails(1, &["order 3"]);
    // The symmetry as found without it.
    let mut document = read(&found);
    let with_void = run("symdetect", &["-q", "--allow-asymmetric"], &hollow).success();
    document.templates = read(&with_void).templates;
    let cut = run("wedgecut", &["--start-angle", "0"], &bytes(&document));
    cut.fails(1, &["sections", "curves against", "near ("]);
}

#[test]
fn a_seam_that_is_moved_by_more_than_the_tolerance_is_told() {
    let said = |body: &Body| {
        let found = run("symdetect", &["-q"], &encode(body, EXACT_STL)).success();
        let cut = run("wedgecut", &["--domain", "rotation"], &found);
        let text = cut.stderr.clone();
        cut.success();
        text
    };
    let coarse = said(&screw(3, 60, 2, 0.0));
    let told = "seam made the image of its other side: points moved by ";
    let relative = |text: &str| -> f64 {
        let after = text.split(" at most, ").nth(1).expect("a share");
        after
            .split(' ')
            .next()
            .and_then(|t| t.parse().ok())
            .expect("a number")
    };
    assert!(coarse.contains(told), "{coarse}");
    assert!(relative(&coarse) > 1e-3, "{coarse}");
    let fine = said(&screw(3, 400, 2, 0.0));
    assert!(!fine.contains(told), "{fine}");
}
