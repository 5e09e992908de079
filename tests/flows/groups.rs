//! Bodies whose groups turn the axis over: the whole pipe uses every element of the group.

use bodies::{AlternatingWheel, Antiprism, Body, HelicalGear, Placement, SawWheel, TwistedBar};
use serde_json::Value;
use support::{EXACT_STL, encode, run};

/// Runs the pipe up to the meshed wedge at the order of the group, checks what the assembled mesh promises, and
/// that the mesh is made of `copies` copies of the wedge.
#[track_caller]
fn is_meshed_in_copies(body: Body, copies: usize) {
    is_meshed_in_copies_with(body, copies, &[]);
}

/// The same, cut with more options.
#[track_caller]
fn is_meshed_in_copies_with(mut body: Body, copies: usize, more: &[&str]) {
    assert_eq!(body.group.size() as usize, copies);
    let placement = Placement {
        rotate: Some(11),
        scale: 1.0,
        jitter: 0.0,
    };
    placement.apply(&mut body);
    let name = body.group.symbol();
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("symmetry.json");
    let report = report.to_str().expect("text");
    let stl = encode(&body, EXACT_STL);
    let found = run("symdetect", &["-q", "--report", report], &stl).success();
    let report = std::fs::read(report).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    assert_eq!(report["group"], name.as_str());

    let order = body.order.to_string();
    let options = [&["-q", "--order", &order], more].concat();
    let wedge = run("wedgecut", &options, &found).success();
    let surface = run("periodic-surf", &["-q"], &wedge).success();
    let meshed = run("tetwedge", &["-q"], &surface).success();
    let document = tmesh::read(meshed.as_slice()).expect("it is sound");
    assert_eq!(tmesh::validate(&document), []);
    let of_wedge = document.instances.iter().filter(|i| i.template == 0);
    assert_eq!(of_wedge.count(), copies, "{name}");

    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &meshed).success();
    for mesh in [meshed, whole] {
        let checked = run("meshqual", &["-q", "--check", "--json", "-"], &mesh);
        let quality: Value = serde_json::from_slice(&checked.success()).expect("JSON");
        let checks = &quality["checks"];
        assert_eq!(checks["passed"], true, "{name}: {checks}");
        let volume = quality["volume"].as_f64().expect("a number");
        let error = (volume / body.total_volume() - 1.0).abs();
        assert!(error < 1e-9, "{name}: {error:e}");
    }
}

fn helical_gear(order: u32, bore: f64) -> Body {
    HelicalGear {
        order,
        radius: 1.0,
        bore,
        height: 0.6,
        twist: 0.3,
        layers: 4,
    }
    .build()
}

fn twisted_bar(aspect: f64, bore: f64) -> Body {
    TwistedBar {
        radius: 1.0,
        aspect,
        bore,
        height: 3.0,
        twist: 1.2,
        layers: 6,
    }
    .build()
}

fn antiprism(order: u32, bore: f64) -> Body {
    Antiprism {
        order,
        radius: 1.0,
        bore,
        height: 0.8,
    }
    .build()
}

fn alternating_wheel(order: u32, bore: f64) -> Body {
    AlternatingWheel {
        order,
        radius: 1.0,
        bore,
        height: 0.5,
    }
    .build()
}

#[test]
fn a_helical_gear_has_half_turns_across_the_axis() {
    // By themselves, its bore would not stay as it is drawn, in strips that cost 3.6 times the elements, nor what the cuts leave of
    // its faces, for 1.6 times.
    for bore in [0.3, 0.0] {
        is_meshed_in_copies_with(helical_gear(16, bore), 32, &["--deviation", "0"]);
    }
}

#[test]
fn a_twisted_bar_has_half_turns_across_the_axis() {
    for bore in [0.0, 0.2] {
        is_meshed_in_copies(twisted_bar(2.0, bore), 4);
        is_meshed_in_copies(twisted_bar(1.0, bore), 8);
    }
}

#[test]
fn an_antiprism_has_mirror_planes_between_its_half_turns() {
    is_meshed_in_copies(antiprism(7, 0.4), 28);
    is_meshed_in_copies(antiprism(7, 0.0), 28);
    is_meshed_in_copies(antiprism(6, 0.4), 24);
}

#[test]
fn a_rotary_reflection_meshes_an_alternating_wheel() {
    is_meshed_in_copies(alternating_wheel(4, 0.3), 8);
    is_meshed_in_copies(alternating_wheel(4, 0.0), 8);
    is_meshed_in_copies(alternating_wheel(3, 0.3), 6);
}

#[test]
fn a_wheel_without_mirror_planes_through_the_axis_is_halved() {
    for bore in [0.0, 0.3] {
        let wheel = SawWheel {
            order: 12,
            radius: 1.0,
            bore,
            height: 0.5,
        };
        is_meshed_in_copies(wheel.build(), 24);
    }
}

/// The wedge of a random body, at a size of elements.
fn wedge_of(seed: u64, options: &[&str]) -> Vec<u8> {
    let solid = bodies::random_solid::solid(seed);
    let found = run("symdetect", &["-q"], &encode(&solid.body, solid.encoding)).success();
    run("wedgecut", &[&["-q"], options].concat(), &found).success()
}

/// Walls on the half turns' axes cut slivers off this body of D7, which cost hundreds of times its elements.
#[test]
fn half_turns_whose_walls_cut_slivers_are_given_up() {
    let wedge = wedge_of(1861, &["--order", "7", "--max-volume", "7.484e8"]);
    let document = tmesh::read(wedge.as_slice()).expect("it is sound");
    assert_eq!(document.instances.len(), 7);
}

/// This body of D4 meets two half-turn walls in edges only, which the mesher divided, and copies were not welded there.
#[test]
fn bodies_that_touch_a_half_turn_wall_are_welded_there() {
    let wedge = wedge_of(1939, &["--max-volume", "3.076e-12"]);
    let document = tmesh::read(wedge.as_slice()).expect("it is sound");
    let gluings = &document.templates[0].gluings;
    assert!(
        gluings
            .iter()
            .all(|gluing| gluing.triangle_pairs.is_empty())
    );
    let surface = run("periodic-surf", &["-q"], &wedge).success();
    let meshed = run("tetwedge", &["-q"], &surface).success();
    run("meshqual", &["-q", "--check"], &meshed).success();
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &meshed).success();
    run("meshqual", &["-q", "--check"], &whole).success();
}

/// A cyclic symmetry model would couple the sector with one that is not turned over.
#[test]
fn sectors_that_their_neighbours_turn_over_have_no_deck() {
    for body in [helical_gear(6, 0.3), alternating_wheel(4, 0.3)] {
        let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
        let wedge = run(
            "wedgecut",
            &["-q", "--order", &body.order.to_string()],
            &found,
        )
        .success();
        let meshed = run("tetwedge", &["-q"], &wedge).success();
        let told = ["is turned over", "wedgecut --domain rotation"];
        run("rotassemble", &["--sector", "--to", "inp"], &meshed).fails(1, &told);
        run("rotassemble", &["-q", "--sector", "--to", "msh"], &meshed).success();
    }
}
