//! Assemblies whose solids touch, overlap or cross themselves, each drawn for itself.

use bodies::Dice;
use bodies::facets::{Facet, ascii_stl, binary_stl, cuboid};
use bodies::rounds::{Circle, Scattered, cylinder, tube};
use serde_json::Value;
use support::{encode, pipe, run};

/// The mesh that the pipe makes, which must pass its check.
fn mesh_of(solids: &[(&str, Vec<Facet>)]) -> Vec<u8> {
    let stages: [&[&str]; 4] = [
        &["symdetect", "--allow-asymmetric"],
        &["wedgecut"],
        &["tetwedge"],
        &["rotassemble", "--to", "tmesh"],
    ];
    let mesh = pipe(&stages, &ascii_stl(solids)).pop().expect("a stage");
    let mesh = mesh.success();
    run("meshqual", &["--check"], &mesh).success();
    mesh
}

/// Volumes of regions of a mesh.
fn volumes_of(mesh: &[u8]) -> Vec<(String, f64)> {
    let report = run("meshqual", &["--json", "-"], mesh).success();
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    let regions = report["regions"].as_array().expect("regions").iter();
    let region = |r: &Value| {
        let name = r["name"].as_str().expect("a name").to_owned();
        (name, r["volume"].as_f64().expect("a number"))
    };
    regions.map(region).collect()
}

fn meshed(solids: &[(&str, Vec<Facet>)]) -> Vec<(String, f64)> {
    volumes_of(&mesh_of(solids))
}

fn expect(solids: &[(&str, Vec<Facet>)], wanted: &[(&str, f64)]) {
    let found = meshed(solids);
    assert_eq!(found.len(), wanted.len());
    for ((name, volume), (known, exact)) in found.iter().zip(wanted) {
        assert_eq!(name, known);
        assert!(
            (volume / exact - 1.0).abs() < 1e-5,
            "{name}: {volume} for {exact}"
        );
    }
}

#[test]
fn posts_on_a_plate() {
    let post = |x: f64, y: f64| cuboid([x - 0.5, y - 0.5, 1.0], [x + 0.5, y + 0.5, 2.0]);
    let solids = [
        ("plate", cuboid([-3.0, -3.0, 0.0], [3.0, 3.0, 1.0])),
        (
            "posts",
            [
                post(1.5, 0.0),
                post(-1.5, 0.0),
                post(0.0, 1.5),
                post(0.0, -1.5),
            ]
            .concat(),
        ),
    ];
    expect(&solids, &[("plate", 36.0), ("posts", 4.0)]);
}

#[test]
fn blocks_that_overlap() {
    let solids = [
        ("first", cuboid([0.0; 3], [2.0, 1.0, 1.0])),
        ("second", cuboid([1.5, 0.25, 0.25], [3.0, 0.75, 0.75])),
    ];
    expect(&solids, &[("first", 2.0 - 0.125), ("second", 0.375)]);
}

#[test]
fn a_surface_that_crosses_itself() {
    let cross = [
        cuboid([-3.0, -0.5, -0.5], [3.0, 0.5, 0.5]),
        cuboid([-0.5, -3.0, -0.5], [0.5, 3.0, 0.5]),
    ];
    expect(&[("cross", cross.concat())], &[("cross", 11.0)]);
}

#[test]
fn a_shaft_in_a_bore_that_is_drawn_with_other_corners() {
    let circle = |radius: f64, corners: u32, phase: f64| Circle {
        radius,
        corners,
        phase,
    };
    let solids = [
        ("shaft", cylinder(circle(5.0, 48, 0.0), [-2.0, 6.0])),
        (
            "hub",
            tube(circle(5.0, 32, 0.5), circle(8.0, 32, 0.0), [0.0, 4.0]),
        ),
    ];
    let found = meshed(&solids);
    let [shaft, hub] = [0, 1].map(|i| found[i].1);
    let disc = circle(5.0, 3, 0.0).disc();
    // Facets of one of both stand for the interface: the bounds are reached, to rounding.
    let within = |volume: f64, low: f64, high: f64| {
        let [low, high] = [low * (1.0 - 1e-12), high * (1.0 + 1e-12)];
        assert!(
            low <= volume && volume <= high,
            "{volume} of {low} to {high}"
        );
    };
    within(shaft, 8.0 * circle(5.0, 32, 0.0).area(), 8.0 * disc);
    let ring = |bore: f64| 4.0 * (circle(8.0, 32, 0.0).area() - bore);
    within(hub, ring(disc), ring(circle(5.0, 32, 0.0).area()));
}

/// A shaft in a sleeve, as a mesher draws each of them that knows nothing of the other one: the facets of one of both are the interface, so
/// that no sliver is between them, and all that a sleeve and a shaft have between them is what facets are off the bore.
#[test]
fn a_shaft_and_a_sleeve_that_are_meshed_apart() {
    let mut dice = Dice::new(7);
    for [corners, others] in [[24, 20], [36, 36], [30, 48], [48, 25]] {
        let circle = |radius: f64, corners: u32| Circle {
            radius,
            corners,
            phase: 0.0,
        };
        let shaft = Scattered::new(circle(1.0, corners), [-1.5, 2.5], 15, &mut dice);
        let sleeve = Scattered::new(circle(1.0, others), [0.0, 1.5], 7, &mut dice);
        let solids = [
            ("shaft", shaft.cylinder()),
            ("sleeve", sleeve.tube(circle(1.8, others))),
        ];
        let mesh = mesh_of(&solids);
        run(
            "meshqual",
            &["--fail-below", "min_dihedral_deg.min=10"],
            &mesh,
        )
        .success();
        let volumes = volumes_of(&mesh);
        let most = circle(1.0, 360).disc();
        let [shaft, sleeve] = [0, 1].map(|i: usize| volumes[i].1);
        let off = 4.0 * most - shaft;
        assert!(off > 0.0 && off < 0.05 * 4.0 * most, "a shaft of {shaft}");
        let both = 2.5 * most + 1.5 * circle(1.8, others).area();
        let lost = both - shaft - sleeve;
        assert!(
            lost > 0.0 && lost < 0.05 * 2.5 * most,
            "both of {}",
            shaft + sleeve
        );
    }
}

/// A shaft whose wall is divided along its length, in a coarser bore: few of its vertices are corners of flat faces in there, and
/// the others touch the bore as these do.
#[test]
fn a_shaft_divided_in_rows_in_a_coarser_bore() {
    let circle = |radius: f64, corners: u32, phase: f64| Circle {
        radius,
        corners,
        phase,
    };
    let shaft = circle(5.0, 96, 0.0);
    let is_end = |f: &Facet| f[0][2] == f[1][2] && f[1][2] == f[2][2];
    let rows = (-4..12).map(|k| [0.5 * f64::from(k), 0.5 * f64::from(k + 1)]);
    let walls = rows
        .flat_map(|row| cylinder(shaft, row))
        .filter(|f| !is_end(f));
    let ends = cylinder(shaft, [-2.0, 6.0]).into_iter().filter(is_end);
    let solids = [
        ("shaft", walls.chain(ends).collect()),
        (
            "hub",
            tube(circle(5.0, 24, 0.5), circle(8.0, 32, 0.0), [0.0, 4.0]),
        ),
    ];
    let found = run("symdetect", &[], &ascii_stl(&solids));
    assert!(
        found.stderr.contains("solids that touch"),
        "{}",
        found.stderr
    );
    assert!(!found.stderr.contains("overlap"), "{}", found.stderr);
    meshed(&solids);
}

/// Where solids share triangles, the curved face between them is read from either as it is from a solid by itself: circles of 26
/// corners are round to the four pins on them, though a quarter of a turn takes corners between corners.
#[test]
fn facets_that_solids_share_are_of_curved_faces() {
    let circle = |radius: f64| Circle {
        radius,
        corners: 26,
        phase: 0.0,
    };
    let pin = |x: f64, y: f64| cuboid([x - 0.5, y - 0.5, 1.0], [x + 0.5, y + 0.5, 4.0]);
    let pins = [(10.0, 0.0), (0.0, 10.0), (-10.0, 0.0), (0.0, -10.0)];
    let pins = pins.into_iter().flat_map(|(x, y)| pin(x, y)).collect();
    let heights = [-3.0, 1.0];
    let solids = [
        ("core", cylinder(circle(7.0), heights)),
        ("ring", tube(circle(7.0), circle(12.0), heights)),
        ("pins", pins),
    ];
    let found = run("symdetect", &[], &ascii_stl(&solids));
    assert!(found.stderr.contains("C4v about"), "{}", found.stderr);
}

/// Facets turned about z and then x, moved, and rounded to so many significant digits.
fn printed(facets: Vec<Facet>, [about_z, about_x]: [f64; 2], digits: usize) -> Vec<Facet> {
    let ([s, c], [t, d]) = (
        [about_z.sin(), about_z.cos()],
        [about_x.sin(), about_x.cos()],
    );
    let place = |[x, y, z]: [f64; 3]| {
        let (y, z) = (d * y - t * z, t * y + d * z);
        [c * x - s * y + 20.0, s * x + c * y - 30.0, z + 10.0].map(|x| {
            let text = format!("{x:.0$e}", digits - 1);
            text.parse::<f64>().expect("a number")
        })
    };
    facets.into_iter().map(|f| f.map(place)).collect()
}

/// Where no more is known of coordinates than the six digits that are printed of them, faces that touch cross by what was rounded
/// away; and where they were rounded before they were turned and printed with all digits.
#[test]
fn solids_that_touch_as_far_as_coordinates_are_known() {
    let circle = |radius: f64| Circle {
        radius,
        corners: 26,
        phase: 0.0,
    };
    for (step, digits) in [(2.0, 6), (3.0, 6), (6.0, 6), (2.0, 8), (3.0, 8), (6.0, 8)] {
        let placed = |facets| {
            let rounded = printed(facets, [0.7 * step, 0.4 * step], digits);
            match digits {
                8 => printed(rounded, [0.3 * step, 0.5 * step], 17),
                _ => rounded,
            }
        };
        let solids = [
            ("core", placed(cylinder(circle(7.0), [-6.0, 4.0]))),
            ("ring", placed(tube(circle(7.0), circle(12.0), [-3.0, 1.0]))),
            ("plate", placed(tube(circle(7.0), circle(14.0), [1.0, 2.0]))),
        ];
        let found = run("symdetect", &[], &ascii_stl(&solids));
        let says = |what: &str| assert!(found.stderr.contains(what), "{}", found.stderr);
        says("coordinates are known less well than their digits tell");
        says("C26v about");
        let [core, ring, plate] = [7.0, 12.0, 14.0].map(|r| circle(r).area());
        let exact = [10.0 * core, 4.0 * (ring - core), plate - core];
        for ((name, volume), exact) in meshed(&solids).into_iter().zip(exact) {
            assert!(
                (volume / exact - 1.0).abs() < 1e-4,
                "{name}: {volume} for {exact}"
            );
        }
    }
}

/// Names and volumes of the regions of a mesh whose solids are the shells of the one that the file has.
fn meshed_by_shells(facets: Vec<Facet>) -> Vec<(String, f64)> {
    let stages: [&[&str]; 4] = [
        &["symdetect", "--solids", "shells"],
        &["wedgecut"],
        &["tetwedge"],
        &["rotassemble", "--to", "tmesh"],
    ];
    let mesh = pipe(&stages, &ascii_stl(&[("all", facets)])).pop();
    let mesh = mesh.expect("a stage").success();
    run("meshqual", &["--check"], &mesh).success();
    volumes_of(&mesh)
}

/// An assembly that was written as one solid: a pin in two collars.
#[test]
fn shells_of_one_solid_are_solids_where_that_is_asked_for() {
    let circle = |radius: f64, corners: u32| Circle {
        radius,
        corners,
        phase: 0.0,
    };
    let collar = |z| tube(circle(7.0, 26), circle(12.0, 26), z);
    let solids = [
        cylinder(circle(7.0, 26), [-6.0, 4.0]),
        collar([-3.0, 1.0]),
        collar([1.0, 2.0]),
    ];
    let all = solids.concat();
    let found = meshed_by_shells(all.clone());
    let [core, ring] = [7.0, 12.0].map(|r| circle(r, 26).area());
    let exact = [10.0 * core, 4.0 * (ring - core), ring - core];
    assert_eq!(found.len(), 3);
    for ((name, volume), (known, exact)) in found
        .iter()
        .zip(["all", "all-2", "all-3"].iter().zip(exact))
    {
        assert_eq!(name, known);
        assert!(
            (volume / exact - 1.0).abs() < 1e-6,
            "{name}: {volume} for {exact}"
        );
    }
    // Otherwise they are one body.
    let whole = meshed(&[("all", all)]);
    let sum: f64 = exact.iter().sum();
    assert!((whole[0].1 / sum - 1.0).abs() < 1e-6, "{whole:?}");
    assert_eq!(whole.len(), 1);
}

/// An assembly that was written as one solid is the union of its shells, which touch as solids do: as symmetric as these, and without
/// slivers between facets of faces that are one.
#[test]
fn shells_of_one_solid_that_touch_are_its_parts() {
    // Three blocks, as single precision leaves them: two lie in each other by a rounding, and two are apart by one.
    let rounding = 4e-9;
    let arch = |gap: f64| {
        [
            cuboid([-0.015, 0.02, -0.06], [0.015, 0.05, 0.04]),
            cuboid(
                [-0.015, -0.02 + gap, -0.06],
                [0.015, 0.02 + rounding, -0.025],
            ),
            cuboid([-0.015, -0.05, -0.06], [0.015, -0.02, 0.04]),
        ]
        .concat()
    };
    let single = |facets: Vec<Facet>| -> Vec<Facet> {
        let rounded = |x: f64| f64::from(x as f32);
        facets
            .into_iter()
            .map(|f| f.map(|p| p.map(rounded)))
            .collect()
    };
    for gap in [-rounding, 0.0, rounding] {
        let arch = binary_stl(b"", &single(arch(gap)));
        let found = run("symdetect", &[], &arch);
        assert!(
            found.stderr.contains("C2v about"),
            "{gap}: {}",
            found.stderr
        );
        let stages: [&[&str]; 4] = [
            &["symdetect"],
            &["wedgecut"],
            &["tetwedge"],
            &["rotassemble", "--to", "tmesh"],
        ];
        let mesh = pipe(&stages, &arch).pop().expect("a stage").success();
        let good = ["--check", "--fail-below", "min_dihedral_deg.min=15"];
        run("meshqual", &good, &mesh).success();
        let volumes = volumes_of(&mesh);
        let exact = 2.0 * 0.03 * 0.03 * 0.1 + 0.03 * 0.04 * 0.035;
        assert_eq!(volumes.len(), 1);
        assert!((volumes[0].1 / exact - 1.0).abs() < 1e-6, "{volumes:?}");
    }
    // What is apart by more stays so.
    let apart = run("symdetect", &[], &binary_stl(b"", &single(arch(1e-4))));
    assert!(apart.stderr.contains("C1v about"), "{}", apart.stderr);
}

/// A shaft with 48 facets in a bore with 36, and pins in both that are drawn otherwise: facets of two faces that are one cross everywhere,
/// and hardly any where their images do.
#[test]
fn curved_shells_of_one_solid_that_touch_are_its_parts() {
    let circle = |radius: f64, corners: u32, phase: f64| Circle {
        radius,
        corners,
        phase,
    };
    let shaft = cylinder(circle(5.0, 48, 0.1), [-2.0, 6.0]);
    let hub = tube(circle(5.0, 36, 0.3), circle(9.0, 36, 0.0), [0.0, 4.0]);
    let found = run(
        "symdetect",
        &[],
        &binary_stl(b"", &[shaft.clone(), hub.clone()].concat()),
    );
    let apart = run("symdetect", &[], &ascii_stl(&[("a", shaft), ("b", hub)]));
    let group = |told: &str| {
        let line = told
            .lines()
            .find(|l| l.contains(" about "))
            .map(str::to_owned);
        line.and_then(|l| l.split_whitespace().nth(1).map(str::to_owned))
    };
    assert!(group(&apart.stderr).is_some(), "{}", apart.stderr);
    assert_eq!(
        group(&found.stderr),
        group(&apart.stderr),
        "{}",
        found.stderr
    );
}

/// Parts need not be symmetric for their union to be: a bar, and two stubs that make it a cross.
#[test]
fn the_union_of_parts_may_be_more_symmetric_than_they_are() {
    let cross = [
        cuboid([-5.0, -1.0, 0.0], [5.0, 1.0, 1.0]),
        cuboid([-1.0, 0.5, 0.0], [1.0, 5.0, 1.0]),
        cuboid([-1.0, -5.0, 0.0], [1.0, -1.0, 1.0]),
    ];
    let found = run("symdetect", &[], &binary_stl(b"", &cross.concat()));
    assert!(found.stderr.contains("D4h about"), "{}", found.stderr);
}

/// A shell that looks inwards is no solid, whether or not another one fills it.
#[test]
fn shells_that_look_inwards_are_cavities() {
    let cube = |half: f64| cuboid([-half; 3], [half; 3]);
    let inwards = |half: f64| cube(half).into_iter().map(|[a, b, c]| [a, c, b]);
    let hollow: Vec<Facet> = cube(6.0).into_iter().chain(inwards(2.0)).collect();
    let of = |facets: &[Vec<Facet>]| -> Vec<f64> {
        let found = meshed_by_shells(facets.concat());
        found
            .into_iter()
            .map(|(_, volume)| volume.round())
            .collect()
    };
    assert_eq!(of(std::slice::from_ref(&hollow)), [1664.0]);
    assert_eq!(of(&[hollow.clone(), cube(2.0)]), [1664.0, 64.0]);
    assert_eq!(of(&[hollow, cube(1.0)]), [1664.0, 8.0]);
}

#[test]
fn shells_that_are_open_or_no_choice_end_in_a_message() {
    let mut facets = cuboid([-1.0; 3], [1.0; 3]);
    facets.pop();
    let open = run(
        "symdetect",
        &["--solids", "shells"],
        &ascii_stl(&[("all", facets)]),
    );
    open.fails(3, &["the surface is not closed"]);
    let unknown = run("symdetect", &["--solids", "bodies"], b"");
    unknown.fails(2, &["bodies", "--solids"]);
}

/// A layer of a ten millionth of its solids that touches them with other triangles is thinner than single precision tells, and stays where
/// coordinates are exact.
#[test]
fn a_layer_thinner_than_single_precision_tells_is_no_rounding() {
    let square = |half: f64, [low, high]: [f64; 2]| {
        cylinder(
            Circle {
                radius: half,
                corners: 4,
                phase: 0.0,
            },
            [low, high],
        )
    };
    let solids = [
        ("base", square(7.0, [-6.0, 0.0])),
        ("oxide", square(5.0, [0.0, 1e-6])),
        ("gate", square(3.0, [1e-6, 4.0])),
    ];
    let found = run("symdetect", &[], &ascii_stl(&solids));
    assert!(found.stderr.contains("C4v about"), "{}", found.stderr);
    assert!(
        !found.stderr.contains("known less well"),
        "{}",
        found.stderr
    );
    let document = tmesh::read(&found.stdout[..]).expect("a document");
    let volume = document.regions[1].volume.expect("a volume");
    assert!((volume / 50e-6 - 1.0).abs() < 1e-6, "{volume}");
}

/// A wedge that touches the axis along an edge only, whose surface is kept with the lengths asked for: vertices that divide this
/// edge belong to all copies, which had one of their own each.
#[test]
fn copies_that_only_touch_share_what_divides_their_edge() {
    let solid = bodies::random_solid::solid(10_208_996);
    let found = run("symdetect", &["-q"], &encode(&solid.body, solid.encoding)).success();
    let options =
        "-q --horizontal-mirror off --deviation 2.58e-2 --edge-length 1.695e-1 --gradation 1.417";
    let options: Vec<&str> = options.split(' ').collect();
    let wedge = run("wedgecut", &options, &found).success();
    let filled = run("tetwedge", &["-q"], &wedge).success();
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &filled).success();
    run("meshqual", &["-q", "--check"], &whole).success();
}

/// A shaft and a sleeve with numbers of corners that have a small divisor in common: what has that order is not what is around them.
#[test]
fn a_divisor_of_two_counts_is_no_number_of_facets() {
    let circle = |radius: f64, corners: u32| Circle {
        radius,
        corners,
        phase: 0.0,
    };
    let any = "order 840 stands for any";
    for (corners, told) in [
        ([93, 102], any),
        ([96, 48], "with 48 facets around the axis"),
        ([15, 90], "with 15 facets around the axis"),
    ] {
        let [bore, outer] = [circle(1.0, corners[0]), circle(2.0, corners[1])];
        let solids = [
            ("shaft", cylinder(bore, [-2.0, 2.5])),
            ("sleeve", tube(bore, outer, [-0.5, 0.5])),
        ];
        let found = run("symdetect", &[], &ascii_stl(&solids));
        assert!(found.stderr.contains(told), "{corners:?}: {}", found.stderr);
        found.success();
    }
}

/// Rings around each other with as many corners as they like have any order. Wedges that are narrower than what the remeshed surface asks for would
/// get many times the elements.
#[test]
fn bodies_of_revolution_are_cut_no_narrower_than_pays() {
    let circle = |radius: f64, corners: u32| Circle {
        radius,
        corners,
        phase: 0.25,
    };
    for corners in [[50, 37, 41], [31, 64, 45]] {
        let [bore, middle, outer] =
            [(1.0, corners[0]), (1.4, corners[1]), (2.0, corners[2])].map(|(r, n)| circle(r, n));
        let solids = [
            ("shaft", cylinder(bore, [-1.0, 2.5])),
            ("bush", tube(bore, middle, [-0.5, 1.5])),
            ("ring", tube(middle, outer, [0.0, 1.0])),
        ];
        let found = run("symdetect", &[], &ascii_stl(&solids)).success();
        let count = |arguments: &[&str]| {
            let wedge = run("wedgecut", arguments, &found).success();
            let stages: [&[&str]; 2] = [&["tetwedge"], &["rotassemble", "--to", "tmesh"]];
            let mesh = pipe(&stages, &wedge).pop().expect("a stage").success();
            let report = run("meshqual", &["--json", "-"], &mesh).success();
            let report: Value = serde_json::from_slice(&report).expect("JSON");
            report["tetrahedra"].as_u64().expect("a count")
        };
        let [free, wide] = [count(&[]), count(&["--order", "4"])];
        assert!(free < 3 * wide, "{corners:?}: {free} for {wide}");
    }
}

/// Where facets are alike all around, they stay so; otherwise those of one solid stand for both.
#[test]
fn interfaces_are_drawn_once_where_facets_are_not_alike() {
    let circle = |radius: f64, corners: u32| Circle {
        radius,
        corners,
        phase: 0.0,
    };
    let told = |solids: &[(&str, Vec<Facet>)]| {
        let found = run("symdetect", &[], &ascii_stl(solids));
        let told = found.stderr.contains("drawn once");
        found.success();
        told
    };
    let [bore, outer] = [circle(1.0, 48), circle(1.8, 24)];
    let alike = [
        ("shaft", cylinder(circle(1.0, 96), [-1.5, 2.5])),
        ("sleeve", tube(bore, outer, [0.0, 1.5])),
    ];
    assert!(!told(&alike));
    for (seed, corners, others) in [(12, 24, 20), (12, 36, 36), (8, 30, 48)] {
        let mut dice = Dice::new(seed);
        let shaft = Scattered::new(circle(1.0, corners), [-1.5, 2.5], 15, &mut dice);
        let sleeve = Scattered::new(circle(1.0, others), [0.0, 1.5], 7, &mut dice);
        let scattered = [
            ("shaft", shaft.cylinder()),
            ("sleeve", sleeve.tube(circle(1.8, others))),
        ];
        assert!(told(&scattered), "{corners} {others}");
        let mesh = mesh_of(&scattered);
        let arguments = ["--fail-below", "min_dihedral_deg.min=10"];
        run("meshqual", &arguments, &mesh).success();
    }
}

/// The surface of a ball between `count` meridians, which has vertices on these at `bands` steps from pole to pole, the middle ones moved
/// along them by a share of a step.
fn globe(radius: f64, count: u32, bands: u32, shift: f64) -> Vec<Facet> {
    let point = |meridian: u32, band: u32| {
        let is_pole = band == 0 || band == bands;
        let step = f64::from(band) + if is_pole { 0.0 } else { shift };
        let (s, c) = libm::sincos(std::f64::consts::PI * step / f64::from(bands));
        let (y, x) =
            libm::sincos(std::f64::consts::TAU * f64::from(meridian % count) / f64::from(count));
        let s = if is_pole { 0.0 } else { s };
        [radius * s * x, radius * s * y, radius * c]
    };
    let mut facets = Vec::new();
    for k in 0..count {
        for band in 0..bands {
            let [a, b] = [point(k, band), point(k + 1, band)];
            let [c, d] = [point(k, band + 1), point(k + 1, band + 1)];
            if band > 0 {
                facets.push([a, d, b]);
            }
            if band + 1 < bands {
                facets.push([a, c, d]);
            }
        }
    }
    facets
}

/// A layer on a ball is thinner than its facets are off the round shape, and they turn so far that meridians are edges: the vertices on
/// the outside of the layer are no vertices of the ball.
#[test]
fn layers_thinner_than_facets_explain() {
    for (bands, shift, thickness) in [(8, 0.2, 0.03), (8, 0.15, 0.03), (10, 0.3, 0.02)] {
        let inside = globe(1.0, 11, bands, shift);
        let inside = inside.into_iter().map(|[a, b, c]| [a, c, b]);
        let outside = globe(1.0 + thickness, 11, bands, 0.5 * shift);
        let solids = [
            ("ball", globe(1.0, 11, bands, 0.0)),
            ("layer", inside.chain(outside).collect()),
        ];
        let found = run("symdetect", &["--allow-asymmetric"], &ascii_stl(&solids));
        assert!(!found.stderr.contains("overlap"), "{}", found.stderr);
        let (_, moved) = (found.stderr.split_once("moved by more than ")).expect("a contact");
        let moved: f64 = moved
            .lines()
            .next()
            .expect("a line")
            .parse()
            .expect("a number");
        assert!(moved < thickness, "{moved}");
        mesh_of(&solids);
    }
}

/// A cube in the middle of a block that is no larger than what is moved onto cut planes.
#[test]
fn regions_of_which_nothing_is_left_are_told() {
    let block = |half: f64| cuboid([-half; 3], [half; 3]);
    let solids = [("block", block(1.0)), ("dot", block(1e-3))];
    let found = run("symdetect", &[], &ascii_stl(&solids)).success();
    run("wedgecut", &[], &found).success();
    let told = [
        "nothing is left of region 2 'dot', of volume 8.0e-9",
        "--snap",
    ];
    run("wedgecut", &["--snap", "1e-2"], &found).fails(1, &told);
}

/// A sleeve around the z axis from `radii[0]` to `radii[1]`, of cells: as many around the axis as are given, and in rows of a height; without
/// those that are `open`, by their number around the axis and their row.
fn windowed(
    radii: [f64; 2],
    (around, rows, height): (u32, u32, f64),
    open: impl Fn(u32, u32) -> bool,
) -> Vec<Facet> {
    let point = |radius: f64, [k, row]: [u32; 2]| {
        let (s, c) =
            libm::sincos(std::f64::consts::TAU * f64::from(k % around) / f64::from(around));
        [radius * c, radius * s, height * f64::from(row)]
    };
    let is_full = |k: u32, row: u32| row < rows && !open(k % around, row);
    let mut facets = Vec::new();
    let mut quad = |[a, b, c, d]: [[f64; 3]; 4]| facets.extend([[a, b, c], [a, c, d]]);
    for k in 0..around {
        for row in (0..rows).filter(|&row| is_full(k, row)) {
            let cell = [[k, row], [k + 1, row], [k + 1, row + 1], [k, row + 1]];
            let [inner, outer] = radii.map(|radius| cell.map(|at| point(radius, at)));
            quad(outer);
            quad([inner[3], inner[2], inner[1], inner[0]]);
            let below = row > 0 && is_full(k, row - 1);
            let next = [is_full(k + 1, row), is_full(k, row + 1)];
            let sides = [below, next[0], next[1], is_full(k + around - 1, row)];
            for (i, _) in sides.iter().enumerate().filter(|side| !side.1) {
                let j = (i + 1) % 4;
                quad([outer[j], outer[i], inner[i], inner[j]]);
            }
        }
    }
    facets
}

/// The shaft has long facets, and between windows of the sleeve nothing of it but what is imprinted there: facets from one window to
/// another are chords across several of its own, and far from the sleeve.
#[test]
fn a_shaft_in_a_sleeve_with_windows() {
    let shaft = Circle {
        radius: 1.0,
        corners: 63,
        phase: 0.3,
    };
    let open = |k: u32, row: u32| row % 2 == 1 && (k + row).is_multiple_of(4);
    let solids = [
        ("shaft", cylinder(shaft, [0.0, 2.8])),
        ("sleeve", windowed([1.0, 1.2], (40, 7, 0.4), open)),
    ];
    let found = run("symdetect", &[], &ascii_stl(&solids));
    assert!(found.stderr.contains("drawn once"), "{}", found.stderr);
    let mesh = mesh_of(&solids);
    let arguments = ["--fail-below", "min_dihedral_deg.min=10"];
    run("meshqual", &arguments, &mesh).success();
}
