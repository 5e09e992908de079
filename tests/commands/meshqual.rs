//! `meshqual` as its users run it.

use assert_cmd::Command;
use glam::DVec3;
use serde_json::Value;
use support::bytes;
use tmesh::{Document, Gluing, Instance, Isometry, OUTSIDE, Region, Template, Tet, Triangle};

/// An octagonal pyramid of radius 1 and height 1 as half-wedges of a fourfold symmetry:
/// one tetrahedron, eight times.
fn pyramid() -> Document {
    let turn = Isometry::rotation(1, 8);
    let vertices = vec![DVec3::ZERO, DVec3::X, turn.apply(DVec3::X), DVec3::Z];
    let triangle = |vertices| Triangle {
        vertices,
        marker: 0,
        front: OUTSIDE,
        back: 3,
    };
    let triangles = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]
        .map(triangle)
        .to_vec();
    let wall = |name: &str, reflection, vertices: [u32; 3], triangle| {
        Gluing::mirror(name, 0, reflection, vertices, [triangle])
    };
    let mut document = Document::single(Template {
        vertices,
        triangles,
        tets: vec![Tet {
            vertices: [0, 1, 2, 3],
            region: 3,
        }],
        gluings: vec![
            wall("wall-a", Isometry::reflection(0, 1), [0, 1, 3], 2),
            wall("wall-b", Isometry::reflection(1, 4), [0, 2, 3], 1),
        ],
        axis: vec![0, 3],
    });
    document.instances = (0..4)
        .flat_map(|k| [false, true].map(|m| Isometry::new(k, 4, m, false)))
        .map(|isometry| Instance {
            template: 0,
            isometry,
            region_map: 0,
        })
        .collect();
    document.regions = vec![Region {
        id: 3,
        name: "quartz".to_owned(),
        size: None,
        volume: None,
    }];
    document
}

fn meshqual(arguments: &[&str], input: &[u8]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_meshqual"))
        .args(arguments)
        .write_stdin(input)
        .output()
        .unwrap();
    (
        output.status.code().unwrap(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

fn json(arguments: &[&str], input: &[u8]) -> Value {
    let (code, stdout, stderr) = meshqual(&[&["--json", "-"], arguments].concat(), input);
    assert_eq!(code, 0, "{stderr}");
    serde_json::from_str(&stdout).unwrap()
}

fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<&str> = value
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect();
    keys.sort();
    keys
}

#[test]
fn the_json_report() {
    let report = json(&["--bins", "4"], &bytes(&pyramid()));
    assert_eq!(report["vertices"], 10);
    assert_eq!(report["tetrahedra"], 8);
    let volume = 8.0_f64.sqrt() / 3.0;
    let close = |value: &Value, expected: f64| {
        let value = value.as_f64().unwrap();
        assert!(
            (value - expected).abs() < 1e-14,
            "{value} is not {expected}"
        );
    };
    close(&report["volume"], volume);
    let region = &report["regions"][0];
    assert_eq!(
        keys(region),
        ["id", "metrics", "name", "tetrahedra", "volume"]
    );
    assert_eq!(
        keys(&region["metrics"]["min_dihedral_deg"]),
        ["max", "mean", "min", "p01", "p50", "p99"]
    );
    close(&region["metrics"]["volume"]["mean"], volume / 8.0);
    let worst = report["worst"].as_array().unwrap();
    assert_eq!(worst.len(), 5);
    assert_eq!(worst[1]["metric"], "min_dihedral_deg");
    assert_eq!(
        (&worst[1]["copies"], &worst[1]["region"]),
        (&8.into(), &3.into())
    );
    close(&worst[1]["place"][2], 0.25);
    assert_eq!(
        (&region["id"], &region["name"]),
        (&3.into(), &"quartz".into())
    );
    close(&region["volume"], volume);
    assert_eq!(
        keys(&report["metrics"]),
        [
            "aspect_ratio",
            "edge_length",
            "max_dihedral_deg",
            "min_dihedral_deg",
            "radius_edge_ratio",
            "volume"
        ]
    );
    for metric in keys(&report["metrics"]) {
        let metric = &report["metrics"][metric];
        assert_eq!(
            keys(metric),
            ["histogram", "max", "mean", "min", "p01", "p50", "p99"]
        );
        let histogram = &metric["histogram"];
        assert_eq!(histogram["edges"].as_array().unwrap().len(), 5);
        let counts = histogram["counts"].as_array().unwrap();
        let total: u64 = counts.iter().map(|c| c.as_u64().unwrap()).sum();
        assert!(total == 8 || total == 48);
    }
    close(&report["metrics"]["max_dihedral_deg"]["max"], 90.0);
    let angle = &report["metrics"]["min_dihedral_deg"]["min"];
    assert!((angle.as_f64().unwrap() - 45.0).abs() < 1e-12);
    let checks = &report["checks"];
    for (key, value) in [
        ("conforming", Value::from(true)),
        ("inverted", Value::from(0)),
        ("coincident_vertices", Value::from(0)),
        ("connectivity_symmetric", Value::from(true)),
        ("volume_error", Value::Null),
        ("passed", Value::from(true)),
        ("violations", Value::Array(Vec::new())),
    ] {
        assert_eq!(checks[key], value, "{key}");
    }
    assert!(checks["symmetry_residual"].as_f64().unwrap() < 1e-15);
}

#[test]
fn the_text_report_and_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let input = bytes(&pyramid());
    let (code, text, stderr) = meshqual(
        &[
            "--check",
            "--json",
            &path("r.json"),
            "--svg",
            &path("r.svg"),
        ],
        &input,
    );
    assert_eq!((code, stderr.as_str()), (0, ""));
    for part in [
        "10 vertices, 8 tetrahedra, 16 surface triangles",
        "1 template placed 8 times, symmetry of C4v",
        "quartz",
        "min_dihedral_deg",
        "100.00 % ████",
        "all promises hold",
    ] {
        assert!(text.contains(part), "no {part:?} in {text}");
    }
    let svg = std::fs::read_to_string(path("r.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert_eq!(svg.matches("<g ").count(), svg.matches("</g>").count());
    let file: Value = serde_json::from_slice(&std::fs::read(path("r.json")).unwrap()).unwrap();
    assert_eq!(file, json(&[], &input));
    // The report goes where -o says, and is the same each time.
    let (_, nothing, _) = meshqual(&["--check", "-o", &path("r.txt")], &input);
    assert_eq!(nothing, "");
    assert_eq!(std::fs::read_to_string(path("r.txt")).unwrap(), text);
}

#[test]
fn broken_promises_and_limits_end_with_one() {
    let mut inverted = pyramid();
    inverted.templates[0].tets[0].vertices.swap(0, 1);
    let input = bytes(&inverted);
    assert_eq!(meshqual(&[], &input).0, 0);
    let (code, text, stderr) = meshqual(&["--check"], &input);
    assert_eq!(code, 1);
    assert!(text.contains("BROKEN orientation: 1 tetrahedra"));
    assert!(
        stderr.contains("meshqual: error: orientation: "),
        "{stderr}"
    );
    assert!(
        stderr.contains("tetrahedron 0 is inside out near (0.426777, 0.176777, 0.25)"),
        "{stderr}"
    );

    let input = bytes(&pyramid());
    for (limit, code) in [
        ("--fail-below=min_dihedral_deg=44.9", 0),
        ("--fail-below=min_dihedral_deg=45.1", 1),
        ("--fail-below=min_dihedral_deg.p01=45.1", 1),
        ("--fail-above=max_dihedral_deg=90.1", 0),
        ("--fail-above=max_dihedral_deg=89.9", 1),
        ("--fail-above=aspect_ratio.mean=1", 1),
        ("--fail-below=min_angle=3", 2),
        ("--fail-below=volume", 2),
    ] {
        let (found, _, stderr) = meshqual(&[limit], &input);
        assert_eq!(found, code, "{limit}: {stderr}");
        if code == 1 {
            assert!(stderr.contains(" is ") && stderr.contains("deg") || stderr.contains("mean"));
        }
    }
}

#[test]
fn what_is_beyond_a_bound_is_counted() {
    let input = bytes(&pyramid());
    let counts = |arguments: &[&str]| {
        let (code, stdout, stderr) = meshqual(&[arguments, &["--json=-"]].concat(), &input);
        assert_eq!(code, 0, "{stderr}");
        let report: serde_json::Value = serde_json::from_str(&stdout).unwrap();
        report["beyond"].clone()
    };
    let all = counts(&["--count-above=min_dihedral_deg=44.9"]);
    let whole = all[0]["count"].as_u64().unwrap();
    assert!(whole > 0 && all[0]["share"] == 1.0, "{all}");
    let some = counts(&[
        "--count-above=min_dihedral_deg=45.1",
        "--count-below=min_dihedral_deg=45.1",
    ]);
    // Below come first.
    assert_eq!(some[0]["above"], false);
    assert_eq!(some[0]["metric"], "min_dihedral_deg");
    assert_eq!(some[0]["count"], whole);
    assert_eq!(
        (&some[1]["count"], &some[1]["value"]),
        (&0.into(), &45.1.into())
    );
    // Nothing is there that was not asked for.
    assert!(counts(&[]).is_null());
    let (_, stdout, _) = meshqual(&["--count-below=volume=-1"], &input);
    assert!(stdout.contains("volume below -1: 0 (0.0000 %)"), "{stdout}");
    for wrong in ["--count-below=volume", "--count-above=volume.p01=3"] {
        let (code, stdout, stderr) = meshqual(&[wrong], &input);
        assert_eq!((code, stdout.as_str()), (2, ""), "{stderr}");
        assert!(
            stderr.contains(wrong.split('=').next().unwrap()),
            "{stderr}"
        );
    }
}

#[test]
fn comparison_with_the_assembled_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("whole.tmesh");
    Command::new(env!("CARGO_BIN_EXE_rotassemble"))
        .args(["-q", "--to", "tmesh", "-o"])
        .arg(&path)
        .write_stdin(bytes(&pyramid()))
        .assert()
        .success();
    let path = path.to_str().unwrap();
    let input = bytes(&pyramid());
    let report = json(&["--check", "--compare", path], &input);
    let other = &report["compare"];
    assert_eq!(other["name"], path);
    for key in ["vertices", "tetrahedra"] {
        assert_eq!(report[key], other[key]);
    }
    for metric in keys(&report["metrics"]) {
        let edges = |r: &Value| r["metrics"][metric]["histogram"]["edges"].clone();
        assert_eq!(edges(&report), edges(other));
    }
    let (code, text, _) = meshqual(&["--compare", path], &input);
    assert_eq!(code, 0);
    assert!(text.contains("  compared"));
    let (code, _, stderr) = meshqual(&["--compare", "/nowhere.tmesh"], &input);
    assert_eq!(code, 3);
    assert!(stderr.contains("cannot read /nowhere.tmesh"), "{stderr}");
    // The assembled mesh passes on its own, and says what it was checked for.
    let whole = json(&["--check", path], &[]);
    assert_eq!(whole["checks"]["connectivity_symmetric"], true);
    assert_eq!(whole["symmetry"]["order"], 4);
    assert_eq!(whole["symmetry"]["mirror"], true);
}

#[test]
fn wrong_usage() {
    let input = bytes(&pyramid());
    for arguments in [
        &["--json", "-", "--svg", "-"][..],
        &["--to", "vtk"],
        &["--bins", "0"],
        &["--bins", "1000000"],
    ] {
        let (code, stdout, _) = meshqual(arguments, &input);
        assert_eq!((code, stdout.as_str()), (2, ""), "{arguments:?}");
    }
}

#[test]
fn the_page() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("r.html");
    let path = page.to_str().unwrap();
    let (code, _, stderr) = meshqual(&["--html", path, "--worst", "3"], &bytes(&pyramid()));
    assert_eq!((code, stderr.as_str()), (0, ""));
    let html = std::fs::read_to_string(&page).unwrap();
    assert!(html.starts_with("<!DOCTYPE html>") && html.ends_with("</html>\n"));
    assert_eq!(
        html.matches("src=\"data:image/png;base64,iVBORw0KGgo")
            .count(),
        2
    );
    assert_eq!(html.matches("<svg ").count(), 6);
    assert!(!html.contains("alt=\"\"") && html.contains("alt=\"Surface, by region\""));
    // One element has few neighbours among the worst.
    assert_eq!(html.matches("<td>min_dihedral_deg</td>").count(), 2);
    for tag in ["table", "tr", "td", "figure", "figcaption", "h2"] {
        let open = html.matches(&format!("<{tag}>")).count();
        assert_eq!(open, html.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    let (_, again, _) = meshqual(&["--html", "-", "--worst", "3"], &bytes(&pyramid()));
    assert_eq!(again, html);
    let (code, _, stderr) = meshqual(&["--html", "-", "--json", "-"], &bytes(&pyramid()));
    assert_eq!(code, 2, "{stderr}");
}
