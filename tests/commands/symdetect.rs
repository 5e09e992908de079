//! `symdetect` as a process: exit codes, messages, the report, what it writes.

use glam::DVec3;
use serde_json::Value;
use std::f64::consts::TAU;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use tmesh::{Document, OUTSIDE, Region, Template, Triangle};

/// A toothed wheel with `n` teeth of four facets each, tapered so that it has no horizontal mirror;
/// `lean` makes the teeth lean to one side.
fn wheel(n: usize, lean: bool) -> Document {
    let radii = if lean {
        [1.0, 1.06, 1.12, 1.18]
    } else {
        [1.0, 1.1, 1.2, 1.1]
    };
    let count = 4 * n;
    let mut vertices = Vec::new();
    for (z, scale) in [(0.0, 1.0), (0.5, 0.8)] {
        for i in 0..count {
            let a = TAU * i as f64 / count as f64;
            let r = scale * radii[i % 4];
            vertices.push(DVec3::new(r * a.cos(), r * a.sin(), z));
        }
    }
    vertices.extend([DVec3::ZERO, DVec3::new(0.0, 0.0, 0.5)]);
    let middle = 2 * count as u32;
    let mut triangles = Vec::new();
    for i in 0..count {
        let (a, b) = (i as u32, ((i + 1) % count) as u32);
        let (c, d) = (b + count as u32, a + count as u32);
        triangles.extend([[a, b, c], [a, c, d], [middle, b, a], [middle + 1, d, c]]);
    }
    let triangles = triangles
        .into_iter()
        .map(|vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 3,
        })
        .collect();
    let mut document = Document::single(Template {
        vertices,
        triangles,
        ..Template::default()
    });
    document.regions = vec![Region {
        id: 3,
        name: "steel".to_owned(),
        size: None,
        volume: None,
    }];
    document
}

/// The wheel with one vertex pulled out of line, so that nothing is left of its symmetry.
fn dented() -> Document {
    let mut document = wheel(7, true);
    document.templates[0].vertices[5] += DVec3::new(0.05, 0.03, -0.02);
    document
}

fn write(document: &Document, path: &Path) {
    let mut bytes = Vec::new();
    tmesh::write(document, &mut bytes).unwrap();
    std::fs::write(path, bytes).unwrap();
}

fn symdetect(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_symdetect"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

#[track_caller]
fn fails(arguments: &[&str], folder: &Path, code: i32, words: &[&str]) {
    let output = symdetect(arguments, folder);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{message}");
    assert!(output.stdout.is_empty());
    for word in words {
        assert!(message.contains(word), "'{word}' is not in: {message}");
    }
}

#[test]
fn writes_the_document_with_its_symmetry() {
    let folder = tempfile::tempdir().unwrap();
    let body = wheel(7, false);
    write(&body, &folder.path().join("wheel.tmesh"));
    let output = symdetect(&["wheel.tmesh"], folder.path());
    assert!(output.status.success());
    let found = tmesh::read(output.stdout.as_slice()).unwrap();
    let symmetry = found.symmetry.unwrap();
    assert_eq!(symmetry.group.symbol(), "C7v");
    assert!(symmetry.residual < 1e-12);
    assert_eq!(found.templates, body.templates);
    assert_eq!(found.regions, body.regions);
    assert_eq!(found.history.len(), 1);
    assert_eq!(found.history[0].tool, "symdetect");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("C7v about (0, 0, 1)"), "{message}");
    assert!(
        symdetect(&["-q", "wheel.tmesh"], folder.path())
            .stderr
            .is_empty()
    );
}

#[test]
fn the_report_has_the_keys_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    write(&wheel(7, true), &folder.path().join("wheel.tmesh"));
    let run = symdetect(
        &["wheel.tmesh", "--report", "report.json", "-o", "out.tmesh"],
        folder.path(),
    );
    assert!(run.status.success() && run.stdout.is_empty());
    let text = std::fs::read_to_string(folder.path().join("report.json")).unwrap();
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(report["group"], "C7");
    assert_eq!(report["order"], 7);
    assert_eq!(report["mirror"], false);
    assert_eq!(report["horizontal_mirror"], false);
    assert_eq!(report["axisymmetric"], false);
    assert_eq!(report["tolerance"], 1e-3);
    assert!(report["residual"].as_f64().unwrap() < 1e-12);
    assert_eq!(report["deviations"]["facets"], Value::Null);
    let remaining = &report["deviations"]["remaining"];
    assert_eq!(remaining["largest"], report["residual"]);
    assert_eq!(remaining["at"].as_array().unwrap().len(), 3);
    assert_eq!(
        report["axis"]["direction"],
        serde_json::json!([0.0, 0.0, 1.0])
    );
    assert_eq!(report["axis"]["point"].as_array().unwrap().len(), 3);
    assert_eq!(report["mirror_direction"].as_array().unwrap().len(), 3);
    assert_eq!(report["other_axes"], serde_json::json!([]));
    assert_eq!(report["triangles"], 112);
    assert_eq!(
        report["regions"],
        serde_json::json!([{"id": 3, "name": "steel"}])
    );
    let rejected = report["rejected"].as_array().unwrap();
    let double = rejected.iter().find(|r| r["order"] == 14).unwrap();
    assert!(double["residual"].as_f64().unwrap() > 1e-3);
}

#[test]
fn negative_numbers_are_values() {
    let folder = tempfile::tempdir().unwrap();
    write(&wheel(7, false), &folder.path().join("wheel.tmesh"));
    for arguments in [
        ["wheel.tmesh", "--axis", "-0,0,-1", "--center", "-0.0,0,-3"],
        ["wheel.tmesh", "--axis=0,0,-1", "--order", "7", "-v"],
    ] {
        let output = symdetect(&arguments, folder.path());
        assert!(output.status.success(), "{output:?}");
        let symmetry = tmesh::read(output.stdout.as_slice())
            .unwrap()
            .symmetry
            .unwrap();
        assert_eq!(
            (symmetry.group.order, symmetry.axis.direction[2]),
            (7, -1.0)
        );
    }
    // Only a mirror plane contains this one, and nothing the next.
    let output = symdetect(&["wheel.tmesh", "--axis", "-1,0,0"], folder.path());
    let symmetry = tmesh::read(output.stdout.as_slice())
        .unwrap()
        .symmetry
        .unwrap();
    assert_eq!(symmetry.group.symbol(), "C1v");
    fails(
        &["wheel.tmesh", "--axis", "-1,-2,0.3"],
        folder.path(),
        1,
        &["no symmetry"],
    );
}

/// A long bar over a polygon with a mirror plane, that one corner is off.
fn bar_off_its_mirror_plane() -> Document {
    let outline = [
        [1.0, 0.0],
        [0.3, 0.8],
        [-0.7, 0.3],
        [-0.7, -0.3],
        [0.3, -0.8],
    ];
    let mut document = wheel(5, false);
    let template = &mut document.templates[0];
    let corner = |z: f64, scale: f64| outline.map(|[x, y]| DVec3::new(scale * x, scale * y, z));
    template.vertices = [corner(0.0, 1.0), corner(8.0, 0.7)].concat();
    template.vertices[1].y += 5e-3;
    let ends = (1..4).flat_map(|i| [[0, i + 1, i], [5, 5 + i, 6 + i]]);
    let sides = (0..5).flat_map(|i| {
        let j = (i + 1) % 5;
        [[i, j, 5 + j], [i, 5 + j, 5 + i]]
    });
    let like = template.triangles[0];
    template.triangles = ends
        .chain(sides)
        .map(|vertices| Triangle { vertices, ..like })
        .collect();
    document
}

/// The number in the message is one that the tolerance is measured by: with a little more the plane is found.
#[test]
fn a_tolerance_as_large_as_a_mirror_plane_is_off_finds_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write(&bar_off_its_mirror_plane(), &path.join("bar.tmesh"));
    let refused = symdetect(&["bar.tmesh"], path);
    assert_eq!(refused.status.code(), Some(1));
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.contains("closest is a mirror plane"), "{said}");
    let (_, after) = said.split_once("off by ").expect("by how much");
    let off: f64 = after.split(' ').next().unwrap().parse().unwrap();
    let found = |tolerance: f64| {
        let tolerance = format!("{tolerance:e}");
        let output = symdetect(&["bar.tmesh", "--tolerance", &tolerance], path);
        output.status.success()
    };
    assert!(!found(0.5 * off) && found(1.02 * off), "{said}");
}

#[test]
fn what_cannot_be_done_says_why_and_where() {
    let folder = tempfile::tempdir().unwrap();
    write(&wheel(7, true), &folder.path().join("wheel.tmesh"));
    write(&dented(), &folder.path().join("dented.tmesh"));
    let path = folder.path();
    std::fs::write(path.join("old.tmesh"), "kept").unwrap();
    fails(
        &["dented.tmesh", "-o", "old.tmesh"],
        path,
        1,
        &[
            "no symmetry within 1e-3",
            "off by",
            " near (",
            "--tolerance",
            "--allow-asymmetric",
        ],
    );
    assert_eq!(
        std::fs::read_to_string(path.join("old.tmesh")).unwrap(),
        "kept"
    );
    fails(
        &["wheel.tmesh", "--order", "5"],
        path,
        1,
        &["order 5 does not hold", "off by", " at ("],
    );
    let output = symdetect(&["dented.tmesh", "--allow-asymmetric"], path);
    assert!(output.status.success());
    let symmetry = tmesh::read(output.stdout.as_slice())
        .unwrap()
        .symmetry
        .unwrap();
    assert_eq!(symmetry.group.symbol(), "C1");
    let loose = symdetect(&["dented.tmesh", "--tolerance", "0.1"], path);
    let symmetry = tmesh::read(loose.stdout.as_slice())
        .unwrap()
        .symmetry
        .unwrap();
    assert_eq!(symmetry.group.order, 7);
}

/// Adds a prism over a polygon around the origin to a body, or a void of its shape.
fn add_prism(document: &mut Document, polygon: &[[f64; 2]], heights: [f64; 2], is_void: bool) {
    let template = &mut document.templates[0];
    let (first, n) = (template.vertices.len() as u32, polygon.len() as u32);
    for z in heights {
        let ring = polygon.iter().map(|&[x, y]| DVec3::new(x, y, z));
        template.vertices.extend(ring);
    }
    let middles = heights.map(|z| DVec3::new(0.0, 0.0, z));
    template.vertices.extend(middles);
    for i in 0..n {
        let (a, b) = (i, (i + 1) % n);
        let (c, d) = (b + n, a + n);
        for [p, q, r] in [[a, b, c], [a, c, d], [2 * n, b, a], [2 * n + 1, d, c]] {
            let [q, r] = if is_void { [r, q] } else { [q, r] };
            template.triangles.push(Triangle {
                vertices: [p, q, r].map(|v| v + first),
                marker: 0,
                front: OUTSIDE,
                back: 3,
            });
        }
    }
}

/// A disk drawn with 50 facets, of a sagitta of 2e-3, around a void whose section is a star of eight points; one corner
/// of the disk is set in by the depth given.
fn disk(depth: f64) -> Document {
    let mut document = wheel(3, false);
    document.templates[0].vertices.clear();
    document.templates[0].triangles.clear();
    let at = |radius: f64, i: usize, n: usize| {
        let (s, c) = (TAU * i as f64 / n as f64).sin_cos();
        [radius * c, radius * s]
    };
    let radius = |i: usize| if i == 0 { 1.0 - depth } else { 1.0 };
    let circle: Vec<_> = (0..50).map(|i| at(radius(i), i, 50)).collect();
    let star: Vec<_> = (0..16).map(|i| at([0.4, 0.6][i % 2], i, 16)).collect();
    add_prism(&mut document, &circle, [0.0, 0.5], false);
    add_prism(&mut document, &star, [0.1, 0.2], true);
    document
}

/// A kernel draws a circle with as many facets as it likes: the shape counts. What facets cannot hide counts as well.
#[test]
fn facets_of_a_circle_do_not_hide_what_is_in_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let group = |depth: f64, arguments: &[&str]| {
        write(&disk(depth), &path.join("disk.tmesh"));
        let output = symdetect(&[&["disk.tmesh"], arguments].concat(), path);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{message}");
        let symmetry = tmesh::read(output.stdout.as_slice()).unwrap().symmetry;
        (symmetry.unwrap().group.symbol(), message)
    };
    let (meant, message) = group(0.0, &[]);
    assert_eq!(meant, "C8v");
    assert!(message.contains("facets of smooth surfaces"), "{message}");
    assert_eq!(group(0.0, &["--tolerance", "auto"]).0, "C8v");
    // A number is what is allowed everywhere.
    assert_eq!(group(0.0, &["--tolerance", "1e-3"]).0, "C2v");
    assert_eq!(group(0.0, &["--tolerance", "5e-3"]).0, "C8v");
    // A corner that facets do not explain leaves one mirror.
    assert_eq!(group(0.02, &[]).0, "C1v");
}

/// The report tells how far the facets are off, and how far the shape behind them is. On the disk, images of corners lie
/// above the middles of facets, on the rim; its shape is one of revolution.
#[test]
fn the_report_tells_what_facets_explain_from_what_remains() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write(&disk(0.0), &path.join("disk.tmesh"));
    let deviations = |arguments: &[&str]| {
        let common = ["disk.tmesh", "--report", "report.json", "-o", "out.tmesh"];
        let run = symdetect(&[&common, arguments].concat(), path);
        assert!(run.status.success());
        let text = std::fs::read_to_string(path.join("report.json")).unwrap();
        let report: Value = serde_json::from_str(&text).unwrap();
        (report["residual"].clone(), report["deviations"].clone())
    };
    let (residual, found) = deviations(&[]);
    let [facets, remaining] = ["facets", "remaining"].map(|part| &found[part]);
    let sagitta = 1.0 - (TAU / 100.0).cos();
    let explained = facets["largest"].as_f64().unwrap();
    assert!((0.5 * sagitta..1.01 * sagitta).contains(&explained));
    assert!((explained - residual.as_f64().unwrap()).abs() < 0.05 * sagitta);
    let [x, y] = [0, 1].map(|i| facets["at"][i].as_f64().unwrap());
    assert!((x.hypot(y) - 1.0).abs() < 2.0 * sagitta);
    assert!(remaining["largest"].as_f64().unwrap() < 0.05 * sagitta);
    // Where a tolerance is given, nothing is explained.
    let (residual, found) = deviations(&["--tolerance", "5e-3"]);
    assert_eq!(found["facets"], Value::Null);
    assert_eq!(found["remaining"]["largest"], residual);
}

#[test]
fn wrong_usage_and_bad_input() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write(&wheel(3, true), &path.join("wheel.tmesh"));
    for arguments in [
        ["--axis", "1,0"],
        ["--axis", "0,0,0"],
        ["--axis", "1,x,0"],
        ["--axis", "nan,0,0"],
        ["--tolerance", "0"],
        ["--tolerance", "-1e-3"],
        ["--order", "0"],
        ["--max-order", "1"],
        ["--order", "100000"],
    ] {
        fails(&["wheel.tmesh", arguments[0], arguments[1]], path, 2, &[]);
    }
    fails(&[], path, 3, &["empty", "did the previous stage fail?"]);
    write(
        &Document::single(Template::default()),
        &path.join("none.tmesh"),
    );
    fails(&["none.tmesh"], path, 3, &["no surface triangles"]);
    fails(&["missing.tmesh"], path, 3, &["missing.tmesh"]);
    fails(
        &["wheel.tmesh", "--report", "no/such/folder.json"],
        path,
        4,
        &["no/such/folder.json"],
    );
    fails(
        &["wheel.tmesh", "-o", "no/such/folder.tmesh"],
        path,
        4,
        &["folder.tmesh"],
    );
}

fn stl(document: &Document, path: &Path, change: impl Fn(&mut Vec<[DVec3; 3]>)) {
    let template = &document.templates[0];
    let corner = |v: u32| template.vertices[v as usize];
    let mut facets: Vec<[DVec3; 3]> = (template.triangles.iter())
        .map(|t| t.vertices.map(corner))
        .collect();
    change(&mut facets);
    let mut text = "solid part\n".to_owned();
    for facet in facets {
        text += "facet normal 0 0 0\nouter loop\n";
        for p in facet {
            text += &format!("vertex {} {} {}\n", p.x, p.y, p.z);
        }
        text += "endloop\nendfacet\n";
    }
    std::fs::write(path, text + "endsolid part\n").unwrap();
}

#[test]
fn defects_are_counted_and_placed() {
    let folder = tempfile::tempdir().unwrap();
    let report = || -> Value {
        let bytes = std::fs::read(folder.path().join("report.json")).unwrap();
        serde_json::from_slice(&bytes).unwrap()
    };
    let body = wheel(7, false);
    let path = folder.path().join("part.stl");
    let arguments = ["part.stl", "--report", "report.json", "-o", "out.tmesh"];

    // Two facets missing: their six edges, two of which they shared.
    stl(&body, &path, |facets| {
        facets.drain(0..2);
    });
    fails(&arguments, folder.path(), 3, &["4 open edges"]);
    let found = report();
    assert!(found["error"].as_str().unwrap().contains("not closed"));
    let open = &found["defects"]["open_edges"];
    assert_eq!(open["count"], 4);
    assert_eq!(open["places"].as_array().unwrap().len(), 4);
    assert_eq!(open["places"][0][0].as_array().unwrap().len(), 3);

    // The top's middle pushed out through the bottom.
    stl(&body, &path, |facets| {
        for p in facets.iter_mut().flatten() {
            if *p == DVec3::new(0.0, 0.0, 0.5) {
                p.z = -0.4;
            }
        }
    });
    let run = symdetect(
        &[&arguments[..], &["--repair", "off"]].concat(),
        folder.path(),
    );
    assert!(run.status.success());
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(said.contains("crosses or touches itself at"), "{said}");
    let crossings = &report()["defects"]["self_intersections"];
    assert!(crossings["count"].as_u64().unwrap() > 10);
    assert_eq!(crossings["at_least"], false);
    // By default it is the union of itself, which does not cross itself any more.
    let run = symdetect(&arguments, folder.path());
    assert!(run.status.success());
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(
        said.contains("it is taken as the union of its parts"),
        "{said}"
    );
    assert_eq!(report()["defects"]["self_intersections"]["count"], 0);

    // What was mended is in the report as well.
    stl(&body, &path, |facets| {
        facets[5].swap(0, 1);
        facets.push(facets[9]);
        facets.push(facets[9]);
    });
    assert!(symdetect(&arguments, folder.path()).status.success());
    let found = report();
    assert_eq!(found["group"], "C7v");
    assert_eq!(found["defects"]["self_intersections"]["count"], 0);
    let input = found["input"].to_string();
    assert!(
        input.contains("oriented against") && input.contains("twice"),
        "{input}"
    );

    // A body without symmetry.
    write(&dented(), &folder.path().join("part.tmesh"));
    let arguments = ["part.tmesh", "--report", "report.json"];
    fails(&arguments, folder.path(), 1, &["no symmetry"]);
    assert!(report()["error"].as_str().unwrap().contains("no symmetry"));
}

#[test]
fn draws_what_was_found() {
    let folder = tempfile::tempdir().unwrap();
    write(&wheel(7, false), &folder.path().join("wheel<7>.tmesh"));
    let arguments = [
        "wheel<7>.tmesh",
        "--svg",
        "wheel.svg",
        "-v",
        "-o",
        "out.tmesh",
    ];
    let run = symdetect(&arguments, folder.path());
    assert!(run.status.success());
    let drawing = std::fs::read_to_string(folder.path().join("wheel.svg")).unwrap();
    for part in [
        "wheel&lt;7&gt;.tmesh: C7v",
        "tolerance 1e-3",
        "along the axis",
        "</svg>",
    ] {
        assert!(drawing.contains(part), "no '{part}'");
    }
    assert_eq!(
        drawing.matches("<line").count(),
        7 + 1,
        "mirror planes and the axis"
    );
    assert!(drawing.contains("order 7: ") && drawing.contains("order 24: "));
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(said.contains("7 mirror planes contain the axis"), "{said}");
    let seventh = said.lines().find(|l| l.contains("     7  ")).unwrap();
    assert!(seventh.ends_with("holds"), "{seventh}");
}
