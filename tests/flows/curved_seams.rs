//! Seams that are no planes: wedges along the graph of an angle, through all stages.

use bodies::{Body, Impeller, Prism, TwistedBar};
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

#[test]
fn planes_are_kept_where_a_seam_between_the_blades_costs_more() {
    let body = impeller(7, 0.0);
    let found = run("symdetect", &["-q"], &encode(&body, EXACT_STL)).success();
    let plane = run("wedgecut", &["-q", "--seam", "plane"], &found).success();
    let auto = run("wedgecut", &["-v", "--seam", "auto"], &found);
    assert!(
        auto.stderr
            .contains("a seam between the blades is not taken: narrow faces"),
        "{}",
        auto.stderr
    );
    let [plane, auto] = [plane, auto.success()].map(|bytes| read(&bytes));
    assert_eq!(plane.templates, auto.templates);
    let default = run("wedgecut", &["-q"], &found).success();
    assert_eq!(read(&default).templates, plane.templates);
}
