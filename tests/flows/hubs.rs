//! Hubs: the column around the axis as a template of its own, and the order that is chosen.

use bodies::{Body, Gear, Impeller, Placement, Prism, Ratchet, Tessellation, Tsv};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use serde_json::Value;
use support::{EXACT_STL, encode, read, run};
use tmesh::Document;

fn tsv(order: u32) -> Body {
    Tsv {
        order,
        core: 0.2,
        thickness: 0.02,
        height: 0.5,
        ..Tsv::default()
    }
    .build()
}

fn gear(teeth: u32) -> Body {
    Gear {
        order: teeth,
        ..Gear::default()
    }
    .build()
}

fn ratchet(order: u32) -> Body {
    Ratchet {
        order,
        tessellation: Tessellation::Asymmetric,
        ..Ratchet::default()
    }
    .build()
}

fn impeller(order: u32) -> Body {
    Impeller {
        order,
        twist: 0.3,
        layers: 3,
        ..Impeller::default()
    }
    .build()
}

fn found(body: &Body) -> Vec<u8> {
    run("symdetect", &["-q"], &encode(body, EXACT_STL)).success()
}

/// The seams of all templates: pairs equal under the rotation to the bit.
fn check_seams(name: &str, document: &Document) {
    for (t, template) in document.templates.iter().enumerate() {
        for seam in template.gluings.iter().filter(|gluing| gluing.is_seam(t)) {
            for &[b, a] in &seam.vertex_pairs {
                let [p, q] = [a, b].map(|v| template.vertices[v as usize]);
                assert_eq!(seam.step.apply(p), q, "{name}");
            }
        }
    }
}

/// The hub's walls meet one copy of the wedge each.
fn check_hub(name: &str, document: &Document, order: u32) {
    assert_eq!(document.templates.len(), 2, "{name}");
    let gluings = document.templates[1].gluings.iter();
    let hubs = gluings.filter(|g| g.other_than(1).is_some()).count();
    let copies = |t: u32| {
        document
            .instances
            .iter()
            .filter(|i| i.template == t)
            .count()
    };
    assert_eq!(hubs * copies(1), copies(0), "{name}");
    assert!(copies(0) == order as usize || copies(0) == 2 * order as usize);
}

/// Through all stages; the assembled mesh keeps all promises, as instances and expanded.
fn mesh(name: &str, body: &Body, cut: &[&str], refine: bool, edge: &str) -> Document {
    let cut = run("wedgecut", &[&["-q"], cut].concat(), &found(body)).success();
    check_seams(name, &read(&cut));
    let surface = if refine {
        run("periodic-surf", &["-q", "--edge-length", edge], &cut).success()
    } else {
        cut
    };
    check_seams(name, &read(&surface));
    let filled = run("tetwedge", &["-q", "--edge-length", edge], &surface).success();
    let document = read(&filled);
    check_seams(name, &document);
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &filled).success();
    for bytes in [&filled, &whole] {
        let checked = run("meshqual", &["-q", "--check", "--json", "-"], bytes);
        assert_eq!(checked.code, 0, "{name}: {}", checked.stderr);
        let report: Value = serde_json::from_slice(&checked.stdout).expect("JSON");
        for (i, material) in body.materials.iter().enumerate() {
            let regions = report["regions"].as_array().expect("regions");
            let region = regions.iter().find(|r| r["name"] == material.name.as_str());
            let region = region.or(regions.first()).expect("a region");
            let volume = region["volume"].as_f64().expect("a volume");
            assert!((volume / body.volume(i) - 1.0).abs() < 1e-9, "{name}");
        }
    }
    document
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 16,
        rng_seed: RngSeed::Fixed(21),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn hubs_of_any_radius_fit(
        kind in 0..4_u32,
        order in 5..40_u32,
        rotation in any::<bool>(),
        refine in any::<bool>(),
        part in 0.1..0.9_f64,
        seed in any::<u64>(),
        scale in -6..6_i32,
    ) {
        // Radii without faces along them; some interfaces and horizontal faces cross the hub.
        let (mut body, within) = match kind {
            0 => (tsv(order), [0.05, 0.17]),
            1 => (gear(order.min(16)), [0.1, 0.6]),
            2 => (ratchet(order.min(16)), [0.1, 0.6]),
            _ => (impeller(order.min(9)), [0.03, 0.12]),
        };
        let order = body.order;
        let scale = 10.0_f64.powi(scale);
        Placement { rotate: Some(seed), scale, jitter: 0.0 }.apply(&mut body);
        let radius = (within[0] + part * (within[1] - within[0])) * scale;
        let name = format!("kind {kind}, order {order}, radius {radius:e}, seed {seed}");
        let (radius, used) = (format!("{radius:e}"), order.to_string());
        let domain = if rotation { "rotation" } else { "auto" };
        let cut = ["--hub", &radius, "--order", &used, "--domain", domain];
        let edge = format!("{:e}", 0.3 * scale);
        let document = mesh(&name, &body, &cut, refine, &edge);
        check_hub(&name, &document, order);
    }
}

#[test]
fn a_hub_that_crosses_layers_and_holds_an_interface() {
    // The hub's polygon is outside of the liner, so that core and liner are in the hub.
    let document = mesh(
        "wide hub",
        &tsv(24),
        &["--hub", "0.4", "--order", "24"],
        false,
        "0.3",
    );
    check_hub("wide hub", &document, 24);
    let regions = |t: usize| {
        let mut all: Vec<u32> = document.templates[t]
            .tets
            .iter()
            .map(|t| t.region)
            .collect();
        all.sort_unstable();
        all.dedup();
        all.len()
    };
    assert_eq!((regions(0), regions(1)), (1, 3));
}

/// The hub keeps its surface when it is filled; where that spoils an element, a vertex is added.
/// Each of these bodies had elements, in 4 to 16 copies, with half the angle asked for.
#[test]
fn the_surface_of_a_hub_spoils_no_element() {
    for (order, thickness, ratio, volume) in [
        (8, 0.005, "1.7", "0.01"),
        (8, 0.005, "1.7", "0.001"),
        (20, 0.02, "1.7", "0.01"),
        (32, 0.005, "1.4", "0.001"),
        (56, 0.005, "1.7", "0.01"),
    ] {
        let body = Tsv {
            order,
            core: 0.2,
            thickness,
            ..Tsv::default()
        }
        .build();
        let sizes = ["-q", "--radius-edge", ratio, "--max-volume", volume];
        let cut = run("wedgecut", &sizes, &found(&body)).success();
        assert_eq!(read(&cut).templates.len(), 2, "order {order}: no hub");
        let bounds = [&sizes[..], &["--min-dihedral", "15"]].concat();
        let filled = run("tetwedge", &bounds, &cut).success();
        let most = format!("--fail-above=radius_edge_ratio={ratio}000001");
        let limits = ["-q", "--check", "--fail-below=min_dihedral_deg=15", &most];
        let checked = run("meshqual", &limits, &filled);
        assert_eq!(checked.code, 0, "order {order}: {}", checked.stderr);
    }
}

/// Smallest angles on the axis are not those of a wedge of 180/n degrees, and the count is near the
/// whole body's (a wedge of the order found has seven times as many elements).
#[test]
fn high_orders_are_meshed_well() {
    let body = tsv(64);
    let quality = |cut: &[&str]| {
        let cut = run("wedgecut", &[&["-q"], cut].concat(), &found(&body)).success();
        let filled = run("tetwedge", &["-q"], &cut).success();
        let checked = run("meshqual", &["-q", "--check", "--json", "-"], &filled).success();
        let report: Value = serde_json::from_slice(&checked).expect("JSON");
        let least = report["metrics"]["min_dihedral_deg"]["min"].as_f64();
        (
            report["tetrahedra"].as_u64().expect("a count"),
            least.expect("an angle"),
        )
    };
    let (count, least) = quality(&[]);
    let (most, sharp) = quality(&["--hub", "none", "--order", "64"]);
    assert!(2 * count < most, "{count} {most}");
    assert!(least > 8.0 && sharp < 3.0, "{least} {sharp}");
}

#[test]
fn orders_are_chosen_by_what_they_cost() {
    let chosen = |body: &Body, cut: &[&str]| {
        let cut = run("wedgecut", &[&["-q"], cut].concat(), &found(body)).success();
        let document = read(&cut);
        let notes = document.history.last().expect("history").notes.join("\n");
        assert!(notes.contains("estimated elements"), "{notes}");
        let mirrored = document.instances.iter().any(|i| i.isometry.mirrored());
        let wedges = document
            .instances
            .iter()
            .filter(|i| i.template == 0)
            .count();
        (
            wedges / if mirrored { 2 } else { 1 },
            document.templates.len(),
        )
    };
    let prism = Prism {
        order: 60,
        ..Prism::default()
    }
    .build();
    // Plain and solid: wedges as wide as elements are.
    let (order, _) = chosen(&prism, &[]);
    assert!((4..=12).contains(&order), "{order}");
    // Finer elements allow for narrower wedges.
    let (coarse, _) = chosen(&prism, &["--edge-length", "0.1"]);
    let (fine, templates) = chosen(&prism, &["--edge-length", "0.01"]);
    assert!(fine > coarse && templates == 2, "{fine} {coarse}");
    let (_, templates) = chosen(&prism, &["--hub", "none"]);
    assert_eq!(templates, 1);
    assert_eq!(chosen(&prism, &["--order", "60"]), (60, 2));
    // A thin liner makes for small elements anyway.
    let (order, templates) = chosen(&tsv(60), &[]);
    assert!(order >= 10 && templates == 2, "{order}");
}

/// What is drawn finer than edges are asked for is remeshed: elements are as large as these then, and a narrow wedge makes them smaller.
#[test]
fn lengths_that_are_longer_than_a_wedge_is_wide_get_wider_wedges() {
    let mut ratchet = Ratchet {
        order: 24,
        ..Ratchet::default()
    }
    .build();
    // Not drawn with its symmetry to the last bit.
    let placement = Placement {
        rotate: None,
        scale: 1.0,
        jitter: 1e-5,
    };
    placement.apply(&mut ratchet);
    let found = found(&ratchet);
    let meshed = |cut: &[&str]| {
        let cut = [&["-q", "--edge-length", "0.3"], cut].concat();
        let wedge = run("wedgecut", &cut, &found).success();
        let document = read(&run("tetwedge", &["-q"], &wedge).success());
        let tets = |i: &tmesh::Instance| document.templates[i.template as usize].tets.len();
        let elements: usize = document.instances.iter().map(tets).sum();
        (document.instances.len(), elements)
    };
    let (copies, elements) = meshed(&[]);
    assert!(copies <= 4, "{copies}");
    // With as many copies as there are teeth, the elements are those of narrow wedges.
    let (_, narrow) = meshed(&["--order", "24"]);
    assert!(3 * elements < narrow, "{elements} {narrow}");
}

/// Where a body is taller than it is wide, hubs that are tried are still within it.
#[test]
fn hubs_of_tall_bodies_are_within_them() {
    let shaft = Tsv {
        order: 60,
        core: 0.2,
        thickness: 0.02,
        height: 20.0,
        ..Tsv::default()
    };
    for cut in [&["-v"][..], &["-v", "--order", "60"]] {
        let cut = run("wedgecut", cut, &found(&shaft.build()));
        assert!(
            !cut.stderr.contains("there can be no hub"),
            "{}",
            cut.stderr
        );
        let document = read(&cut.success());
        assert_eq!(document.templates.len(), 2);
    }
}

/// Pieces of this body touch on the axis, where mirror planes of order 4 leave a twelfth of a right angle, those of order 3 two.
#[test]
fn orders_leave_no_sharp_angles_on_the_axis() {
    let solid = bodies::folded::folded(990).solid;
    let body = run("symdetect", &["-q"], &encode(&solid.body, solid.encoding)).success();
    let sharp = |arguments: &[&str]| {
        let cut = run("wedgecut", arguments, &body);
        (
            cut.stderr.contains("at the axis near"),
            read(&cut.success()).instances.len(),
        )
    };
    assert_eq!(sharp(&["--order", "4"]), (true, 16));
    assert_eq!(sharp(&[]), (false, 12));
}

/// Pieces of this body touch on the axis at half a right angle, of which the mirror planes of every order leave a half.
#[test]
fn mirror_planes_that_halve_an_angle_on_the_axis_are_given_up() {
    let solid = bodies::folded::folded(8).solid;
    let body = run("symdetect", &["-q"], &encode(&solid.body, solid.encoding)).success();
    let sharp = |arguments: &[&str]| {
        let cut = run("wedgecut", arguments, &body);
        let is_sharp = cut.stderr.contains("at the axis near");
        let cut = read(&cut.success());
        let is_mirror = |g: &tmesh::Gluing| g.is_mirror(0);
        let mirrors = cut.templates[0].gluings.iter().any(is_mirror);
        (is_sharp, mirrors, cut.instances.len())
    };
    assert_eq!(sharp(&["--domain", "mirror"]), (true, true, 8));
    assert_eq!(sharp(&["--order", "8"]), (true, true, 16));
    assert_eq!(sharp(&[]), (false, false, 8));
    // What was asked for stays.
    assert!(sharp(&["--start-angle", "0"]).1 && sharp(&["--hub", "0.1"]).1);
}

/// With a hub, with a seam, with both: the plane across the axis is one more wall.
#[test]
fn mirror_planes_across_the_axis_halve_wedges() {
    let via = Tsv {
        order: 16,
        core: 0.2,
        thickness: 0.01,
        ..Tsv::default()
    }
    .build();
    let mut wheel = Ratchet {
        order: 9,
        bore: 0.3,
        coating: 0.01,
        tessellation: Tessellation::Asymmetric,
        ..Ratchet::default()
    }
    .build();
    let placement = Placement {
        rotate: Some(5),
        scale: 1e3,
        ..Placement::default()
    };
    placement.apply(&mut wheel);
    for (name, body, cut, edge, templates) in [
        ("via", &via, &[][..], "0.3", 2),
        ("turned via", &via, &["--domain", "rotation"], "0.3", 2),
        ("wheel", &wheel, &[], "300", 1),
    ] {
        let halved = mesh(name, body, cut, true, edge);
        assert_eq!(halved.templates.len(), templates, "{name}");
        let flipped = |d: &Document| d.instances.iter().any(|i| i.isometry.flipped());
        assert!(flipped(&halved), "{name}");
        for template in &halved.templates {
            let level = template.gluings.iter().any(|g| g.name == "wall-level");
            assert!(level, "{name}");
            assert!(template.vertices.iter().all(|p| p.z >= 0.0), "{name}");
        }
        let off = [cut, &["--horizontal-mirror", "off"]].concat();
        let cut = run("wedgecut", &[&["-q"], &off[..]].concat(), &found(body)).success();
        assert!(!flipped(&read(&cut)), "{name}");
    }
}

#[test]
fn hubs_that_cannot_be() {
    let solid = found(&gear(12));
    let cut = |arguments: &[&str], input: &[u8]| run("wedgecut", arguments, input);
    cut(&["--hub", "2"], &solid).fails(1, &["no hub of radius 2", "farther", "--hub none"]);
    cut(&["--hub", "0.1", "--order", "2"], &solid).fails(1, &["order 2", "too wide"]);
    cut(&["--hub", "0"], &solid).fails(2, &["positive"]);
    cut(&["--hub", "-1"], &solid).fails(2, &["--hub", "positive"]);
    cut(&["--hub", "wide"], &solid).fails(2, &["auto"]);
    for (option, value) in [
        ("--max-volume", "0"),
        ("--max-volume", "nan"),
        ("--edge-length", "-1"),
        ("--edge-length", "x"),
        ("--horizontal-mirror", "on"),
    ] {
        cut(&[option, value], &solid).fails(2, &[option]);
    }
    let both = ["--max-volume", "1", "--edge-length", "1"];
    cut(&both, &solid).fails(2, &["--edge-length"]);
    let bored = Gear {
        order: 12,
        bore: 0.5,
        ..Gear::default()
    }
    .build();
    cut(&["--hub", "0.2"], &found(&bored)).fails(1, &["nothing of the body"]);
}
