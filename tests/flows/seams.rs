//! Wedges without mirrors: their surface as `periodic-surf` or `tetwedge` make it, and what becomes of it.

use bodies::{Body, Impeller, Placement, Prism, Ratchet, Screw, Tessellation};
use geom::measure::volume_of_region;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::collections::HashSet;
use support::{EXACT_STL, encode, read, run};
use tmesh::{Document, Gluing, Template};

fn seam(template: &Template) -> &Gluing {
    let seam = template.gluings.iter().find(|gluing| gluing.is_seam(0));
    seam.unwrap_or_else(|| panic!("{:?}", template.gluings))
}

/// Pairs equal under the rotation to the bit, all of both faces paired, axis vertices with
/// themselves.
fn check_seam(name: &str, document: &Document) {
    let template = &document.templates[0];
    let seam = seam(template);
    let at = |v: u32| template.vertices[v as usize];
    let mut image = vec![u32::MAX; template.vertices.len()];
    for &[b, a] in &seam.vertex_pairs {
        assert_eq!(seam.step.apply(at(a)), at(b), "{name}");
        image[a as usize] = b;
    }
    for &v in &template.axis {
        assert_eq!(image[v as usize], v, "{name}: axis");
    }
    let mut faces = HashSet::new();
    for &[b, a] in &seam.triangle_pairs {
        let [low, high] = [a, b].map(|t| template.triangles[t as usize]);
        let [i, j, k] = low.vertices.map(|v| image[v as usize]);
        assert!(
            [[i, k, j], [k, j, i], [j, i, k]].contains(&high.vertices),
            "{name}"
        );
        assert_eq!((low.front, low.back), (high.front, high.back), "{name}");
        faces.extend([a, b]);
    }
    assert_eq!(faces.len(), 2 * seam.triangle_pairs.len(), "{name}");
}

/// Every edge of the surface bounds each region an even number of times, once per direction.
fn check_closed(name: &str, template: &Template) {
    let mut sides = std::collections::HashMap::new();
    for t in &template.triangles {
        for i in 0..3 {
            let (a, b) = (t.vertices[i], t.vertices[(i + 1) % 3]);
            let sign = if a < b { 1 } else { -1 };
            *sides.entry((t.back, a.min(b), a.max(b))).or_insert(0) += sign;
            *sides.entry((t.front, a.min(b), a.max(b))).or_insert(0) -= sign;
        }
    }
    assert!(sides.values().all(|&sum| sum == 0), "{name}");
}

fn cut(name: &str, body: &Body) -> Vec<u8> {
    let found = run("symdetect", &["-q"], &encode(body, EXACT_STL)).success();
    let cut = run("wedgecut", &["-q", "--domain", "rotation"], &found).success();
    check_seam(name, &read(&cut));
    cut
}

/// Through all stages, with everything that must hold in between.
fn mesh(name: &str, body: &Body, options: &[&str]) {
    let cut = cut(name, body);
    let arguments = [&["-q"], options].concat();
    let surface = run("periodic-surf", &arguments, &cut).success();
    assert_eq!(
        surface,
        run("periodic-surf", &arguments, &cut).success(),
        "{name}: not the same twice"
    );
    let (before, after) = (read(&cut), read(&surface));
    check_seam(name, &after);
    check_closed(name, &after.templates[0]);
    for region in &before.regions {
        let volume = |d: &Document| {
            let t = &d.templates[0];
            volume_of_region(&t.vertices, t.faces(), region.id)
        };
        let (old, new) = (volume(&before), volume(&after));
        assert!((new - old).abs() <= 1e-9 * old, "{name}: {old} {new}");
    }
    let mut tetwedge = vec!["-v"];
    tetwedge.extend(options);
    let filled = run("tetwedge", &tetwedge, &surface);
    assert!(!filled.stderr.contains("as they were cut"), "{name}");
    let filled = filled.success();
    let meshed = read(&filled);
    check_seam(name, &meshed);
    let pairs = |d: &Document| {
        let s = seam(&d.templates[0]);
        (s.vertex_pairs.len(), s.triangle_pairs.len())
    };
    assert_eq!(pairs(&after), pairs(&meshed), "{name}");
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &filled).success();
    run("meshqual", &["-q", "--check"], &whole).success();
}

fn ratchet(order: u32, bore: f64, coating: f64) -> Body {
    Ratchet {
        order,
        bore,
        coating,
        tessellation: Tessellation::Asymmetric,
        ..Ratchet::default()
    }
    .build()
}

fn impeller(order: u32, bore: f64) -> Body {
    Impeller {
        order,
        bore,
        twist: 0.3,
        layers: 3,
        ..Impeller::default()
    }
    .build()
}

/// A ring with noise whose faces are cut at a small angle where its wedge is to begin: their sections differ by more than the noise, along
/// the cut.
#[test]
fn sections_of_faces_cut_at_a_small_angle_match() {
    let ring = bodies::random_solid::solid(10_215_957);
    let found = run("symdetect", &["-q"], &encode(&ring.body, ring.encoding)).success();
    let options = ["-q", "--domain", "rotation", "--start-angle", "22.165"];
    let wedge = run("wedgecut", &options, &found).success();
    check_seam("ring", &read(&wedge));
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 8,
        rng_seed: RngSeed::Fixed(20),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn chiral_bodies_keep_their_seams(
        kind in 0..4_u32,
        order in 2..14_u32,
        seed in any::<u64>(),
        scale in -6..6_i32,
        edge in 0.1..0.5_f64,
    ) {
        let mut body = match kind {
            0 => ratchet(order, 0.0, 0.0),
            1 => ratchet(order, 0.3, 0.0),
            2 => ratchet(order, 0.3, 0.02),
            _ => impeller(order.max(3), 0.0),
        };
        let scale = 10.0_f64.powi(scale);
        let placement = Placement { rotate: Some(seed), scale, jitter: 0.0 };
        placement.apply(&mut body);
        let name = format!("kind {kind}, order {order}, seed {seed}, scale {scale}, edge {edge}");
        let edge = format!("{:e}", edge * scale);
        // Volumes are those of what was drawn.
        mesh(&name, &body, &["--edge-length", &edge, "--deviation", "0"]);
    }
}

#[test]
fn thin_layers_across_the_seam_are_graded() {
    let body = ratchet(7, 0.3, 1e-2);
    let options = ["--edge-length", "0.3"];
    mesh("thin layer", &body, &options);
    let cut = cut("thin layer", &body);
    let surface = run("periodic-surf", &["-q", options[0], options[1]], &cut).success();
    let document = read(&surface);
    let template = &document.templates[0];
    let area = |t: u32| {
        let [a, b, c] = template.triangles[t as usize]
            .vertices
            .map(|v| template.vertices[v as usize]);
        geom::measure::triangle_area(a, b, c)
    };
    let areas = seam(template).triangle_pairs.iter().map(|p| area(p[0]));
    let (least, most) = areas.fold((f64::MAX, 0.0_f64), |(l, m), a| (l.min(a), m.max(a)));
    assert!(most > 100.0 * least, "{least} {most}");
}

/// Four stages are enough: what `periodic-surf` would have done, `tetwedge` does. Where surfaces are remeshed, it knows the shape that these stand for, and
/// improves elements along that.
#[test]
fn the_surface_of_seams_is_made_by_whoever_comes_first() {
    let screw = Screw {
        order: 3,
        radius: 1.0,
        bore: 0.4,
        coating: 0.0,
        height: 0.5,
        twist: 0.25,
        layers: 3,
        facets: 24,
        drawing: 1,
    };
    for (name, body) in [
        ("ratchet", ratchet(12, 0.3, 0.0)),
        ("coated ratchet", ratchet(7, 0.3, 0.02)),
        ("impeller", impeller(5, 0.3)),
        ("screw", screw.build()),
    ] {
        let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
        let size = ["-q", "--edge-length", "0.2", "--deviation", "0"];
        let cut = run("wedgecut", &size, &found).success();
        let surface = run("periodic-surf", &size, &cut).success();
        let five = run("tetwedge", &size, &surface).success();
        let four = run("tetwedge", &size[1..], &cut);
        assert!(!four.stderr.contains("as they were cut"), "{name}");
        let four = four.success();
        assert_eq!(read(&four).templates, read(&five).templates, "{name}");
        let assemble = |meshed: &[u8]| run("rotassemble", &["-q", "--to", "vtk"], meshed).success();
        assert_eq!(assemble(&four), assemble(&five), "{name}");
        // The history says what was made.
        let text = run("rotassemble", &["-q", "--to", "txt"], &four).success();
        assert!(
            String::from_utf8_lossy(&text).contains("seam of "),
            "{name}"
        );
    }
}

#[test]
fn a_surface_is_kept_where_that_is_asked_for() {
    let cut = cut("ratchet", &ratchet(12, 0.3, 0.0));
    let size = ["-q", "--edge-length", "0.1"];
    let pairs = |arguments: &[&str]| {
        let filled = run("tetwedge", &[&size, arguments].concat(), &cut).success();
        run("meshqual", &["-q", "--check"], &filled).success();
        seam(&read(&filled).templates[0]).triangle_pairs.len()
    };
    let before = seam(&read(&cut).templates[0]).triangle_pairs.len();
    assert_eq!(pairs(&["--keep-surface"]), before);
    assert_eq!(pairs(&["--no-quality"]), before);
    assert!(pairs(&[]) > 4 * before);
    // A mesh that is made again keeps what was settled.
    let once = run("tetwedge", &size, &cut).success();
    let twice = run("tetwedge", &["-q"], &once).success();
    let settled = |meshed: &[u8]| seam(&read(meshed).templates[0]).triangle_pairs.len();
    assert_eq!(settled(&once), settled(&twice));
}

#[test]
fn mirror_wedges_pass_unchanged() {
    let body = Prism {
        order: 6,
        ..Prism::default()
    }
    .build();
    let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
    let cut = run("wedgecut", &["-q"], &found).success();
    let passed = run("periodic-surf", &["-q", "--edge-length", "0.1"], &cut).success();
    assert_eq!(read(&cut).templates, read(&passed).templates);
}

#[test]
fn no_quality_keeps_the_cut() {
    let cut = cut("ratchet", &ratchet(5, 0.3, 0.0));
    let passed = run("periodic-surf", &["-q", "--no-quality"], &cut).success();
    assert_eq!(read(&cut).templates, read(&passed).templates);
}

#[test]
fn failures_of_the_surface() {
    let cut = cut("ratchet", &ratchet(5, 0.3, 0.0));
    let run = |arguments: &[&str]| run("periodic-surf", arguments, &cut);
    run(&["--max-volume", "1e-8", "--timeout", "0.1"]).fails(1, &["0.1 s", "--timeout"]);
    run(&["--max-volume", "1e-30"]).fails(1, &["tetrahedra"]);
    run(&["--region", "nowhere:max-volume=1"]).fails(2, &["nowhere"]);
    for bad in [
        ["--radius-edge", "0.5"],
        ["--min-dihedral", "80"],
        ["--max-volume", "0"],
        ["--edge-length", "x"],
        ["--optimize", "200"],
        ["--timeout", "-1"],
    ] {
        run(&bad).fails(2, &[bad[0]]);
    }
    let surface = run(&["-q", "--edge-length", "0.3"]).success();
    let filled = support::run("tetwedge", &["-q"], &surface).success();
    support::run("periodic-surf", &["-q"], &filled).fails(3, &["tetrahedra"]);
}
