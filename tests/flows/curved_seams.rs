//! Seams that are no planes: wedges along the graph of an angle, through all stages.

use crate::pipe::{placed, ratchet};
use bodies::{Body, Impeller, Prism, TwistedBar};
use geom::tree::Tree;
use std::collections::HashSet;
use std::fs;
use support::{EXACT_STL, Outcome, encode, read, run};
use tmesh::Gluing;

const TWIST: f64 = 0.6;

fn impeller(order: u32, bore: f64) -> Body {
    Impeller {
        order,
        bore,
        twist: TWIST,
        layers: 4,
        ..Impeller::default()
    }
    .build()
}

/// A table of a seam that turns with the height: lines of distance, height and angle, from rows of height and degrees.
fn table(rows: &[(f64, f64)]) -> String {
    let line = |r: f64, (z, angle): &(f64, f64)| format!("{r} {z} {angle}\n");
    let of = |r: f64| rows.iter().map(move |row| line(r, row)).collect::<String>();
    of(0.1) + &of(1.0)
}

fn cut(body: &Body, seam: &str, options: &[&str]) -> Outcome {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("seam.txt");
    fs::write(&path, seam).unwrap();
    let found = run("symdetect", &["-q"], &encode(body, EXACT_STL)).success();
    let path = path.to_str().unwrap();
    let options = [&["-v", "--seam", path], options].concat();
    run("wedgecut", &options, &found)
}

/// Meshes a wedge, assembles and checks it, against the body's volume; gives the largest distance of a
/// vertex of the wedge's low face from the plane at angle 0.
fn check(name: &str, body: &Body, wedge: &[u8]) -> f64 {
    let document = read(wedge);
    let template = &document.templates[0];
    let seam = template.gluings.iter().find(|g| g.is_seam(0)).unwrap();
    for &[here, there] in &seam.vertex_pairs {
        let [p, q] = [here, there].map(|v| template.vertices[v as usize]);
        assert_eq!(seam.step.apply(q), p, "{name}");
    }
    let low = Gluing::vertices_there(seam).map(|v| template.vertices[v as usize].y.abs());
    let off = low.fold(0.0, f64::max);
    let meshed = run("tetwedge", &["-q"], wedge).success();
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &meshed).success();
    let json = tempfile::NamedTempFile::new().unwrap();
    let path = json.path().to_str().unwrap();
    run("meshqual", &["-q", "--check", "--json", path], &whole).success();
    let report: serde_json::Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
    let volume = report["volume"].as_f64().unwrap();
    let exact = body.volume(0);
    assert!(
        (volume / exact - 1.0).abs() < 1e-5,
        "{name}: {volume} {exact}"
    );
    off
}

#[test]
fn seams_follow_the_table() {
    let degrees = TWIST.to_degrees();
    for (name, bore, hub) in [
        ("bore", 0.3, &["--hub", "none"][..]),
        ("axis", 0.0, &["--hub", "none"]),
        ("hub", 0.0, &["--hub", "0.15", "--order", "6"]),
    ] {
        let body = impeller(6, bore);
        let seam = table(&[
            (0.0, 30.0),
            (0.5, 30.0 + degrees / 2.0),
            (1.0, 30.0 + degrees),
        ]);
        let cut = cut(&body, &seam, hub);
        assert!(
            cut.stderr
                .contains("the seam follows angles of 30.0 to 64.4 degrees"),
            "{name}"
        );
        let off = check(name, &body, &cut.success());
        assert!(off > 0.1, "{name}: {off}");
    }
}

/// A ring whose seam has two creases beside the middle of the hub's wall: the edge of that is as far off to one side as to the other,
/// and was taken for straight.
#[test]
fn the_edge_of_a_hub_follows_the_seam() {
    let ring = bodies::random_solid::solid(5_000_629).body;
    let found = run("symdetect", &["-q"], &encode(&ring, EXACT_STL)).success();
    let options = ["-v", "--seam", "auto", "--deviation", "2e-4"];
    let cut = run("wedgecut", &options, &found);
    assert!(cut.stderr.contains("between the blades is taken"));
    let wedge = read(&cut.success());
    let points = wedge.templates[0].vertices.len();
    assert!(points < 1000, "{points}");
}

/// A seam between the blades whose wedge has needles between edges that stay features: remeshing does not take them away, and they were said to cost
/// nothing.
#[test]
fn needles_between_features_count_against_a_seam() {
    let dish = bodies::random_solid::solid(10_215_560);
    let found = run("symdetect", &["-q"], &encode(&dish.body, dish.encoding)).success();
    let options = "-v --domain rotation --seam auto --deviation 2.68e-4 --gradation 1.047 --feature-angle 5.497";
    let options: Vec<&str> = options.split(' ').collect();
    let cut = run("wedgecut", &options, &found);
    let told = "between the blades is not taken";
    assert!(cut.stderr.contains(told), "{}", cut.stderr);
    let filled = run("tetwedge", &["-q"], &cut.success()).success();
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &filled).success();
    let check = ["-q", "--check", "--fail-below", "min_dihedral_deg.min=15"];
    run("meshqual", &check, &whole).success();
}

/// Where the wall of a hub passes a curved seam, both are on the surface: the edge of the cut is a chord of the seam there, and was left.
#[test]
fn corners_of_a_hub_lie_on_the_surface() {
    let gear = bodies::random_solid::solid(7_102_594).body;
    let found = run("symdetect", &["-q"], &encode(&gear, EXACT_STL)).success();
    let options = [
        "--domain",
        "rotation",
        "--seam",
        "auto",
        "--deviation",
        "6e-7",
    ];
    let cut = run("wedgecut", &[&["-v"], &options[..]].concat(), &found);
    assert!(cut.stderr.contains("between the blades is taken"));
    assert!(cut.stderr.contains("hub of inscribed radius"));
    let wedge = read(&cut.success());
    let input = read(&found);
    let body = &input.templates[0];
    let corner = |&v: &u32| input.frame.to_world(body.vertices[v as usize]);
    let corners = |t: &tmesh::Triangle| t.vertices.each_ref().map(corner);
    let tree = Tree::new(body.triangles.iter().map(corners));
    // Vertices of triangles that are no cut.
    for (i, template) in wedge.templates.iter().enumerate() {
        let glued = (wedge.templates.iter().enumerate()).flat_map(|(j, t)| {
            let own = move |g: &Gluing| (j == i, g.other as usize == i);
            t.gluings.iter().flat_map(move |g| {
                let (here, there) = own(g);
                let pairs = g.triangle_pairs.iter();
                pairs.flat_map(move |p| [here.then_some(p[0]), there.then_some(p[1])])
            })
        });
        let glued: HashSet<u32> = glued.flatten().collect();
        let outer = (0..)
            .zip(&template.triangles)
            .filter(|(t, _)| !glued.contains(t));
        for v in outer.flat_map(|(_, t)| t.vertices) {
            let p = wedge.frame.to_world(template.vertices[v as usize]);
            let off = tree.nearest(p, f64::INFINITY).unwrap().point.distance(p);
            assert!(off < 1e-9, "template {i}, vertex {v}: {off}");
        }
    }
}

/// Edges from the corner of a hub that pass beside its edge are not divided without end, each time nearer to it: this wedge got 78,000
/// points where the seam crosses the hub's wall, in half a minute, and no mesh.
#[test]
fn edges_beside_the_corner_of_a_hub_are_divided_a_few_times() {
    let body = bodies::random_solid::solid(9_000_073).body;
    let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
    let cut = run(
        "wedgecut",
        &["-q", "--seam", "auto", "--deviation", "7.54e-4"],
        &found,
    )
    .success();
    let wedge = read(&cut);
    assert_eq!(wedge.templates.len(), 2);
    let points = wedge.templates.iter().map(|t| t.vertices.len());
    assert!(
        points.clone().all(|n| n < 500),
        "{:?}",
        points.collect::<Vec<_>>()
    );
}

/// An impeller along whose seam two edges would be left at which no element has the angle asked for.
#[test]
fn a_seam_sharper_than_planes_is_not_taken() {
    let fan = bodies::bladed::bladed(820_619).body;
    let found = run("symdetect", &["-q"], &encode(&fan, EXACT_STL)).success();
    let cut = run("wedgecut", &["-v", "--seam", "auto"], &found);
    let said =
        "is not taken: its wedge has 2 edge(s) with angles below 10 degrees, 0 between planes";
    assert!(cut.stderr.contains(said), "{}", cut.stderr);
    cut.success();
}

#[test]
fn half_turns_are_kept_where_the_seam_is_odd() {
    let bar = TwistedBar {
        radius: 1.0,
        aspect: 1.5,
        bore: 0.0,
        height: 1.0,
        twist: TWIST,
        layers: 4,
    }
    .build();
    let turns = |seam: &str| {
        let wedge = cut(&bar, seam, &[]).success();
        let document = read(&wedge);
        check(seam, &bar, &wedge);
        document.templates[0]
            .gluings
            .iter()
            .any(|g| g.step.flipped())
    };
    assert!(turns(&table(&[(-0.5, -10.0), (0.5, 10.0)])));
    assert!(!turns(&table(&[(-0.5, 0.0), (0.5, 10.0)])));
}

#[test]
fn what_is_wrong_with_a_seam_is_said() {
    let body = impeller(5, 0.3);
    for (seam, what) in [
        ("0.1 0 3\n0.1 1\n", "line 2: a row has three numbers"),
        (
            "0.1 0 3\n1 1 2\n",
            "each distance needs an angle at each height",
        ),
        ("", "it has no rows"),
        (
            "1 0 0\n1 1e-7 20\n",
            "line 1: from distance 1 and height 0 to the next height the seam turns by 20",
        ),
    ] {
        cut(&body, seam, &[]).fails(2, &["--seam", what]);
    }
    let plain = table(&[(0.0, 0.0), (1.0, 10.0)]);
    let prism = Prism {
        order: 5,
        ..Prism::default()
    };
    cut(&prism.build(), &plain, &[]).fails(2, &["--seam", "--domain rotation"]);
    run("wedgecut", &["--seam", "/no/such/file"], b"").fails(2, &["--seam /no/such/file"]);
}

/// Points came ever nearer to those of the rim that are in line, down to a millionth of the body, and elements with them.
#[test]
fn a_seam_through_points_of_the_body_has_no_narrow_faces() {
    let body = impeller(7, 0.0);
    let at = |p: &glam::DVec3| p.truncate().length();
    let rim = body.vertices.iter().filter(|p| p.z == 0.0 && at(p) > 0.0);
    let inner = rim.clone().map(at).fold(f64::INFINITY, f64::min);
    let of_hub = rim.filter(|p| at(p) < 1.01 * inner);
    // The second of the hub's points between two blades.
    let mut angles: Vec<f64> = of_hub.map(|p| p.y.atan2(p.x).to_degrees()).collect();
    angles.sort_by(f64::total_cmp);
    let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
    let reference = read(&found).symmetry.expect("a symmetry").reference;
    let first = angles[1] - reference[1].atan2(reference[0]).to_degrees();
    let height = body.vertices.iter().map(|p| p.z).fold(0.0, f64::max);
    let seam = table(&[(0.0, first), (height, first + TWIST.to_degrees())]);
    let wedge = cut(&body, &seam, &["--hub", "none", "--start-angle", "0"]).success();
    let document = read(&wedge);
    let template = &document.templates[0];
    let gluing = template.gluings.iter().find(|g| g.is_seam(0)).unwrap();
    let least = gluing.triangles_here().map(|t| {
        let [a, b, c] =
            geom::measure::corners(&template.vertices, template.triangles[t as usize].vertices);
        let corner = |p: glam::DVec3, q: glam::DVec3, r: glam::DVec3| (q - p).angle_between(r - p);
        corner(a, b, c)
            .min(corner(b, c, a))
            .min(corner(c, a, b))
            .to_degrees()
    });
    let least = least.fold(f64::INFINITY, f64::min);
    assert!(least > 5.0, "{least}");
    check("through points", &body, &wedge);
}

/// The wedge of each seam: whether a seam between the blades was taken, and the elements of its mesh.
fn automatic(body: &Body) -> [(bool, usize); 2] {
    let found = run("symdetect", &["-q"], &encode(body, EXACT_STL)).success();
    ["plane", "auto"].map(|seam| {
        let cut = run("wedgecut", &["-v", "--seam", seam], &found);
        let is_taken = cut.stderr.contains("a seam between the blades is taken");
        let wedge = cut.success();
        check(seam, body, &wedge);
        let meshed = read(&run("tetwedge", &["-q"], &wedge).success());
        let tets = meshed.templates.iter().map(|t| t.tets.len()).sum();
        (is_taken, tets)
    })
}

#[test]
fn a_seam_between_the_blades_is_taken_where_it_costs_less() {
    let [plane, auto] = automatic(&impeller(7, 0.0));
    assert!(auto.0 && auto.1 < plane.1, "{plane:?} {auto:?}");
    let [plane, auto] = automatic(&impeller(3, 0.0));
    assert!(auto.0 || auto.1 == plane.1, "{plane:?} {auto:?}");
}

#[test]
fn a_seam_that_was_looked_for_stays_flat_where_it_is() {
    for (order, bore) in [(12, 0.3), (12, 0.0), (7, 0.3), (7, 0.0)] {
        automatic(&ratchet(order, bore));
        for seed in 1..=5 {
            automatic(&placed(ratchet(order, bore), seed, 1.0));
        }
    }
}

#[test]
fn planes_are_the_default() {
    let body = impeller(7, 0.0);
    let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
    let [plane, default] = [&["-q", "--seam", "plane"][..], &["-q"]]
        .map(|options| read(&run("wedgecut", options, &found).success()));
    assert_eq!(plane.templates, default.templates);
}

/// An inclusion wholly between a curved seam and its chords crosses neither, and would be outside of the wedge: another angle is taken, and
/// said why.
#[test]
fn pieces_beyond_a_curved_seam_are_seen() {
    let solid = bodies::random_solid::solid(9_902_529);
    let input = support::encode(&solid.body, solid.encoding);
    let found = run("symdetect", &["-q"], &input).success();
    let cut = run("wedgecut", &["-v", "--seam", "auto"], &found);
    let said = "a piece of the body lies beyond the seam, between its points, near (";
    assert!(cut.stderr.contains(said), "{}", cut.stderr);
    cut.success();
}
