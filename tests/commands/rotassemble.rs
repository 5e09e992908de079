//! The command line of `rotassemble`, over the real binary.

use bodies::structured::Structured;
use bodies::{Placement, Tsv};
use serde_json::{Value, json};
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use support::{EXACT_STL, Outcome, bytes, encode};
use tmesh::Outside;

fn wedge() -> Structured {
    Structured {
        order: 6,
        mirror: true,
        flip: false,
        bore: 0.0,
        radius: 2.0,
        cells: [3, 2, 2],
    }
}

/// Runs the tool with the given standard input.
fn run(arguments: &[&str], input: &[u8]) -> Outcome {
    support::run("rotassemble", arguments, input)
}

#[track_caller]
fn succeeds(arguments: &[&str], input: &[u8]) -> Vec<u8> {
    let output = run(arguments, input);
    assert_eq!((output.code, output.stderr.as_str()), (0, ""));
    output.stdout
}

#[track_caller]
fn fails(arguments: &[&str], input: &[u8], code: i32, sentence: &str) {
    let output = run(arguments, input);
    let stderr = &output.stderr;
    assert_eq!(output.code, code, "{stderr}");
    assert!(stderr.contains(sentence), "{stderr}");
    assert!(output.stdout.is_empty());
}

#[test]
fn legacy_vtk_by_default() {
    let output = succeeds(&[], &bytes(&wedge().document()));
    let text = String::from_utf8_lossy(&output);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("# vtk DataFile Version 3.0"));
    let title = "symtet C6v axis=0,0,0,0,0,1,1,0,0";
    assert_eq!(lines.next(), Some(title));
    assert!(!text.contains("marker"));
    let with_boundary = succeeds(&["--boundary"], &bytes(&wedge().document()));
    assert!(String::from_utf8_lossy(&with_boundary).contains("\nmarker 1 "));
}

#[test]
fn the_expanded_document_can_be_assembled_again() {
    let input = bytes(&wedge().document());
    let expanded = succeeds(&["--to", "tmesh"], &input);
    let document = tmesh::read(expanded.as_slice()).unwrap();
    assert!(document.is_plain());
    assert_eq!(document.history.len(), 1);
    assert_eq!(document.history[0].arguments, ["--to", "tmesh"]);
    assert_eq!(document.promise.unwrap().group.symbol(), "C6v");
    assert!(succeeds(&[], &expanded) == succeeds(&[], &input));
}

/// Runs `meshqual --check`; the exit code, the symmetry in the report, and what is broken of it.
fn checked(input: &[u8]) -> (i32, Value, String) {
    let arguments = ["-q", "--check", "--json", "-"];
    let output = support::run("meshqual", &arguments, input);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let broken = report["checks"]["violations"].as_array().unwrap().iter();
    let texts = broken.filter(|b| b["promise"] == "symmetry");
    let texts: Vec<_> = texts.map(|b| b["text"].as_str().unwrap()).collect();
    (output.code, report["symmetry"].clone(), texts.join("\n"))
}

/// A filled via, placed anyhow, whose wedge of order 16 is meshed around a hub of a lower order.
fn via_with_a_hub(cut: &[&str]) -> Vec<u8> {
    let mut body = Tsv {
        order: 16,
        core: 0.2,
        thickness: 0.02,
        height: 0.5,
        ..Tsv::default()
    }
    .build();
    let place = Placement {
        rotate: Some(3),
        ..Placement::default()
    };
    place.apply(&mut body);
    let mut meshed = encode(&body, EXACT_STL);
    let cut = [&["-q", "--hub", "0.1", "--order", "16"], cut].concat();
    for (tool, arguments) in [
        ("symdetect", &cut[..1]),
        ("wedgecut", &cut),
        ("tetwedge", &cut[..1]),
    ] {
        meshed = support::run(tool, arguments, &meshed).success();
    }
    meshed
}

/// Part of the hub adjoins other sectors alone: a deck would leave its face free.
#[test]
fn a_sector_of_a_hub_of_another_order_is_no_deck() {
    let mirrors = via_with_a_hub(&[]);
    let deck = ["--sector", "--to", "inp"];
    for options in [&[][..], &["--mirror", "symmetric"], &["--mirror", "none"]] {
        fails(
            &[&deck, options].concat(),
            &mirrors,
            1,
            "wedgecut --hub none",
        );
    }
    let turns = via_with_a_hub(&["--domain", "rotation", "--horizontal-mirror", "off"]);
    fails(&deck, &turns, 1, "wedgecut --hub none");
    // As a mesh it is welcome.
    assert!(
        !run(&["--sector", "--to", "vtk"], &turns)
            .success()
            .is_empty()
    );
}

#[test]
fn with_a_hub_the_order_of_the_wedge_holds_outside() {
    let meshed = via_with_a_hub(&[]);
    let (code, symmetry, errors) = checked(&meshed);
    assert_eq!(code, 0, "{errors}");
    let whole = symmetry["order"].as_u64().unwrap();
    assert!(whole < 16 && 16 % whole == 0, "{symmetry}");
    let outside = &symmetry["outside"];
    assert_eq!(
        (&outside["order"], &outside["mirror"]),
        (&json!(16), &json!(true))
    );
    let radius = outside["radius"].as_f64().unwrap();
    assert!((0.1..0.11).contains(&radius), "{radius}");
    // Said in fewer digits of the assembled mesh.
    let rounded = (radius * 1e6).ceil() / 1e6;
    for format in ["tmesh", "vtk", "vtu"] {
        let mut symmetry = symmetry.clone();
        symmetry["outside"]["radius"] = json!(rounded);
        let assembled = succeeds(&["--to", format], &meshed);
        assert_eq!(checked(&assembled), (0, symmetry, String::new()));
    }

    let assembled = succeeds(&["--to", "tmesh"], &meshed);
    let document = tmesh::read(assembled.as_slice()).unwrap();
    let promised = |change: &dyn Fn(&mut Outside)| {
        let mut changed = document.clone();
        let promise = changed.promise.as_mut().unwrap();
        change(promise.outside.as_mut().unwrap());
        checked(&bytes(&changed))
    };
    let (code, _, errors) = promised(&|outside| outside.group.order = 32);
    assert!(code == 1 && errors.contains("order 32 outside"), "{errors}");
    // The hub does not have that order.
    let (code, _, errors) = promised(&|outside| outside.radius = 0.0);
    assert!(code == 1 && errors.contains("order 16 outside"), "{errors}");
    // Slices of the outer part are another material, in a way that keeps the lower order.
    let mut disturbed = document.clone();
    let promise = disturbed.promise.clone().unwrap();
    let axis = |i: usize| glam::DVec3::from_array(promise.rotation.map(|row| row[i]));
    let (x, y, origin) = (axis(0), axis(1), glam::DVec3::from_array(promise.origin));
    let template = &mut disturbed.templates[0];
    let corner = |v: &u32| {
        let p = template.vertices[*v as usize] - origin;
        glam::DVec2::new(x.dot(p), y.dot(p))
    };
    let steps = whole as f64 / std::f64::consts::TAU;
    let mut changed = 0;
    for tet in &mut template.tets {
        let middle = tet.vertices.iter().map(corner).sum::<glam::DVec2>() / 4.0;
        let of_step = (middle.to_angle() * steps).rem_euclid(1.0);
        // The eighth on either side of the mirror planes of the lower order.
        if middle.length() > 0.3 && !(0.125..0.875).contains(&of_step) {
            tet.region = 2;
            changed += 1;
        }
    }
    assert!(changed > 0);
    let (code, _, text) = checked(&bytes(&disturbed));
    assert_eq!(code, 1);
    assert!(text.contains("order 16 outside"), "{text}");
    assert!(!text.contains(&format!("order {whole} ")), "{text}");
}

#[test]
fn instances_and_sector() {
    let document = wedge().document();
    let input = bytes(&document);
    let kept = tmesh::read(succeeds(&["--instances"], &input).as_slice()).unwrap();
    assert_eq!(
        (kept.templates, kept.instances.len()),
        (document.templates.clone(), 12)
    );
    let sector = succeeds(&["--sector", "--to", "tmesh"], &input);
    let sector = tmesh::read(sector.as_slice()).unwrap();
    assert_eq!(
        (sector.templates, sector.instances.len()),
        (document.templates, 1)
    );
    let wedge = succeeds(&["--sector", "--boundary"], &input);
    let text = String::from_utf8_lossy(&wedge);
    assert!(text.contains("wall_names 2 1 int"), "{text}");
    assert!(text.contains("wall-a\nwall-b\n"), "{text}");
    fails(
        &["--instances", "--to", "vtk"],
        &input,
        2,
        "vtk has no instances",
    );
    fails(
        &["--instances", "--sector"],
        &input,
        2,
        "cannot be used with",
    );
}

#[test]
fn surfaces_and_listings() {
    let mut document = wedge().document();
    let listing = succeeds(&["--to", "txt"], &bytes(&document));
    let listing = String::from_utf8(listing).unwrap();
    assert!(listing.contains("instances: 12\n"), "{listing}");
    assert!(listing.contains("GLUE"), "{listing}");
    document.templates[0].tets.clear();
    let stl = succeeds(&["--to", "stl"], &bytes(&document));
    let all = succeeds(&["--to", "stl", "--surface", "all"], &bytes(&document));
    assert!(84 < stl.len() && stl.len() < all.len());
    let vtk = succeeds(&[], &bytes(&document));
    assert!(String::from_utf8_lossy(&vtk).contains("\nmarker 1 "));
}

#[test]
fn the_format_follows_the_extension() {
    let folder = tempfile::tempdir().unwrap();
    let input = bytes(&wedge().document());
    let heads: [(&str, &[u8]); 9] = [
        ("a.msh", b"$MeshFormat\n4.1 1 8\n"),
        ("a.msh2", b"$MeshFormat\n2.2 1 8\n"),
        ("a.mesh", b"MeshVersionFormatted 2\n"),
        ("a.inp", b"*HEADING\nsymtet C6v axis="),
        ("a.vtk", b"# vtk DataFile Version 3.0\n"),
        ("a.vtu", b"<?xml version=\"1.0\"?>\n<VTKFile"),
        ("a.tmesh", &tmesh::MAGIC),
        ("a.stl", b"binary STL"),
        ("a.txt", b"tmesh document"),
    ];
    for (name, head) in heads {
        let path = folder.path().join(name);
        let output = succeeds(&["-o", path.to_str().unwrap()], &input);
        assert!(output.is_empty());
        assert!(fs::read(&path).unwrap().starts_with(head), "{name}");
    }
    let path = folder.path().join("a.off");
    fails(
        &["-o", path.to_str().unwrap()],
        &input,
        2,
        "off is not an output format",
    );
    // Nothing unfinished is left behind.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), heads.len());
}

#[test]
fn failures() {
    let input = bytes(&wedge().document());
    fails(&[], &[], 3, "did the previous stage fail?");
    fails(&[], &input[..input.len() / 2], 3, "cut off");
    fails(&["-o", "/no/such/folder/a.vtk"], &input, 4, "cannot write");
    let mut gap = wedge().document();
    gap.instances.truncate(5);
    fails(&[], &bytes(&gap), 3, "has no neighbour");
    let mut bare = wedge().document();
    for gluing in &mut bare.templates[0].gluings {
        gluing.triangle_pairs.clear();
    }
    bare.templates[0].triangles.clear();
    fails(
        &["--to", "stl"],
        &bytes(&bare),
        1,
        "nothing to write as stl",
    );
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported() {
    if Path::new("/dev/full").exists() {
        let input = bytes(&wedge().document());
        for format in [
            "vtk", "vtu", "tmesh", "stl", "txt", "msh", "msh2", "mesh", "inp",
        ] {
            fails(
                &["--to", format, "-o", "/dev/full"],
                &input,
                4,
                "cannot write /dev/full",
            );
        }
    }
}

#[test]
fn a_reader_that_leaves_ends_it_quietly() {
    // Far more than a pipe holds.
    let large = Structured {
        order: 64,
        cells: [8, 4, 8],
        ..wedge()
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.tmesh");
    fs::write(&path, bytes(&large.document())).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_rotassemble"))
        .arg(&path)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut some = [0; 100];
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut some).unwrap();
    drop(stdout);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(4));
    assert!(
        output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// A wedge of a body without mirror planes.
fn chiral() -> Structured {
    Structured {
        mirror: false,
        ..wedge()
    }
}

#[test]
fn meshes_of_several_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let input = bytes(&wedge().document());
    succeeds(&["-o", &path("a.ele")], &input);
    let count = |name: &str| -> usize {
        let text = fs::read_to_string(path(name)).unwrap();
        let first = text.split_whitespace().next().unwrap();
        first.parse().unwrap()
    };
    let whole = succeeds(&["--to", "tmesh"], &input);
    let whole = &tmesh::read(whole.as_slice()).unwrap().templates[0];
    assert_eq!(count("a.node"), whole.vertices.len());
    assert_eq!(count("a.ele"), whole.tets.len());
    assert_eq!(count("a.face"), whole.triangles.len());

    succeeds(&["-o", &path("b.pvtu"), "--compress"], &input);
    let list = fs::read_to_string(path("b.pvtu")).unwrap();
    assert_eq!(list.matches("<Piece Source=\"b/b_").count(), 12);
    assert_eq!(fs::read_dir(path("b")).unwrap().count(), 12);

    let sentence = "is several files; give a path with rotassemble -o, such as mesh.";
    for format in ["node", "pvtu"] {
        fails(&["--to", format], &input, 2, sentence);
        fails(&["--to", format, "-o", "-"], &input, 2, sentence);
    }
    // A folder that cannot be made leaves nothing behind.
    fs::write(path("c"), "").unwrap();
    fails(&["-o", &path("c.pvtu")], &input, 4, "cannot write");
    assert!(!Path::new(&path("c.pvtu")).exists());
}

#[test]
fn the_table_of_pairs() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let document = chiral().document();
    let input = bytes(&document);
    let seam = &document.templates[0].gluings[0];
    let (csv, json) = (path("p.csv"), path("p.json"));
    succeeds(&["--sector", "--to", "vtk", "--pairs", &csv], &input);
    let text = fs::read_to_string(csv).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("coupling,kind,low,high,residual"));
    let mut nodes = Vec::new();
    let mut faces = 0;
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let pair = [fields[2], fields[3]].map(|f| f.parse::<u32>().unwrap());
        if fields[1] == "face" {
            faces += 1;
            continue;
        }
        assert_eq!(fields[1] == "axis", pair[0] == pair[1]);
        assert!(fields[4].parse::<f64>().unwrap() < 1e-14);
        nodes.push(pair);
    }
    let mut pairs: Vec<[u32; 2]> = seam.vertex_pairs.iter().map(|&[b, a]| [a, b]).collect();
    pairs.sort_unstable();
    assert_eq!(nodes, pairs);
    assert_eq!(faces, seam.triangle_pairs.len());

    // Counted as in the mesh file.
    succeeds(&["-q", "--sector", "--to", "inp", "--pairs", &json], &input);
    let table: serde_json::Value = serde_json::from_slice(&fs::read(json).unwrap()).unwrap();
    assert_eq!(table["first_id"], 1);
    let first = &table["couplings"][0]["nodes"][0];
    assert_eq!(first[0], seam.vertex_pairs[0][0] + 1);
    assert_eq!(table["couplings"][0]["rotation"]["angle_deg"], 60.0);
    assert_eq!(table["axis"][0], document.templates[0].axis[0] + 1);

    let mirrored = path("m.json");
    let input = bytes(&wedge().document());
    succeeds(&["--sector", "--to", "inp", "--pairs", &mirrored], &input);
    let table: serde_json::Value = serde_json::from_slice(&fs::read(mirrored).unwrap()).unwrap();
    assert_eq!(table["couplings"], serde_json::json!([]));
    assert_eq!(table["mirrors"][0]["name"], "wall-a");
    fails(&["--pairs", "x.csv"], &input, 2, "--sector");
}

/// Nodes of a set in an INP file.
fn nodes_of(text: &str, set: &str) -> Vec<u32> {
    let from = text.find(&format!("*NSET, NSET={set}\n"));
    let lines = text[from.expect("the set")..].lines().skip(1);
    let lines = lines.take_while(|l| !l.starts_with('*'));
    let words = lines.flat_map(|l| l.split(','));
    words.filter_map(|w| w.trim().parse().ok()).collect()
}

#[test]
fn conditions_at_mirror_planes() {
    let deck = |options: &[&str], input: &[u8]| {
        let options = [&["--sector", "--to", "inp"], options].concat();
        String::from_utf8(succeeds(&options, input)).unwrap()
    };
    // Nodes and directions of all lines of a keyword.
    let fixed = |text: &str| -> Vec<(u32, u32)> {
        let Some((_, lines)) = text.split_once("*BOUNDARY\n") else {
            return Vec::new();
        };
        let lines = lines.lines().take_while(|l| !l.starts_with('*'));
        let numbers = lines.map(|l| {
            let words: Vec<u32> = l.split(", ").map(|w| w.parse().unwrap()).collect();
            assert_eq!(words[1], words[2]);
            (words[0], words[1])
        });
        numbers.collect()
    };
    // Half a sector: nobody is given half the body for the whole.
    let half = |bore| Structured {
        mirror: false,
        flip: true,
        bore,
        ..wedge()
    };
    let input = bytes(&half(0.4).document());
    let sector = ["--sector", "--to", "inp"];
    fails(&sector, &input, 1, "--horizontal-mirror off");
    fails(&sector, &input, 1, "--mirror symmetric");
    let text = deck(&["--mirror", "none"], &input);
    assert!(text.contains("*CYCLIC SYMMETRY MODEL, N=6,"));
    assert!(!text.contains("*BOUNDARY") && !text.contains("*EQUATION"));
    // What the tie gives is not given twice.
    let dependent = nodes_of(&text, "wall-a");
    let level = nodes_of(&text, "floor");
    let free: Vec<u32> = level
        .iter()
        .copied()
        .filter(|v| !dependent.contains(v))
        .collect();
    assert!(!free.is_empty() && free.len() < level.len());
    assert_eq!(nodes_of(&text, "floor-untied"), free);
    let text = deck(&["--mirror", "symmetric"], &input);
    let expected: Vec<(u32, u32)> = free.iter().map(|&v| (v, 3)).collect();
    assert_eq!(fixed(&text), expected);
    let text = deck(&["--mirror", "floor=antisymmetric"], &input);
    let expected: Vec<(u32, u32)> = free.iter().flat_map(|&v| [(v, 1), (v, 2)]).collect();
    let mut found = fixed(&text);
    found.sort_unstable();
    assert_eq!(found, expected);
    assert!(!text.contains("*EQUATION"));

    // On the axis CalculiX has conditions of its own.
    let input = bytes(&half(0.0).document());
    fails(
        &[&sector[..], &["--mirror", "symmetric"]].concat(),
        &input,
        1,
        "on the axis",
    );
    let output = run(&[&sector[..], &["--mirror", "none"]].concat(), &input);
    assert_eq!(output.code, 0);
    let stderr = &output.stderr;
    assert!(stderr.contains("nodal diameter 1"), "{stderr}");

    // Between mirror planes there is no model, and conditions where they are wished for. Those of
    // several planes fix a line or a point.
    let input = bytes(&wedge().document());
    let text = deck(&[], &input);
    assert!(!text.contains("*BOUNDARY") && !text.contains("*EQUATION"));
    assert!(!text.contains("-untied"));
    let text = deck(&["--mirror", "symmetric"], &input);
    let axis = nodes_of(&text, "axis");
    let walls = [nodes_of(&text, "wall-a"), nodes_of(&text, "wall-b")];
    let mut expected = walls[0].iter().map(|&v| (v, 2)).collect::<Vec<_>>();
    expected.extend(axis.iter().map(|&v| (v, 1)));
    let mut found = fixed(&text);
    found.sort_unstable();
    expected.sort_unstable();
    assert_eq!(found, expected);
    let equations = text.matches("*EQUATION\n2\n").count();
    assert_eq!(equations, walls[1].len() - axis.len());
    let one = deck(
        &["--mirror", "symmetric", "--mirror", "wall-b=none"],
        &input,
    );
    assert!(!one.contains("*EQUATION"));
    assert_eq!(fixed(&one).len(), walls[0].len());

    let wrong = |how| [&sector[..], &["--mirror", how]].concat();
    fails(
        &wrong("wall-c=none"),
        &input,
        2,
        "these are: wall-a, wall-b",
    );
    fails(&wrong("even"), &input, 2, "`even` is none of");
    fails(&["--mirror", "none"], &input, 2, "--sector");
    fails(
        &["--sector", "--mirror", "none"],
        &input,
        2,
        "vtk has no conditions",
    );
    let whole = bytes(&chiral().document());
    fails(
        &wrong("symmetric"),
        &whole,
        2,
        "no wall of the sector is a mirror plane",
    );
}

#[test]
fn elements_of_second_order() {
    for body in [wedge(), chiral()] {
        let input = bytes(&body.document());
        let whole = succeeds(&["--to", "tmesh"], &input);
        let whole = &tmesh::read(whole.as_slice()).unwrap().templates[0];
        let mut edges = std::collections::BTreeSet::new();
        for tet in &whole.tets {
            let v = tet.vertices;
            for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
                edges.insert([v[i].min(v[j]), v[i].max(v[j])]);
            }
        }
        let straight = [
            "--to",
            "msh2",
            "--ascii",
            "--second-order",
            "--straight-edges",
        ];
        let text = succeeds(&straight, &input);
        let text = String::from_utf8(text).unwrap();
        let after = |section: &str| text.split_once(section).unwrap().1.lines();
        let count: usize = after("$Nodes\n").next().unwrap().parse().unwrap();
        assert_eq!(count, whole.vertices.len() + edges.len());
        let points: Vec<[f64; 3]> = after("$Nodes\n")
            .skip(1)
            .take(count)
            .map(|line| {
                let n: Vec<f64> = line.split(' ').map(|w| w.parse().unwrap()).collect();
                [n[1], n[2], n[3]]
            })
            .collect();
        let mut seen = 0;
        for line in after("$Elements\n")
            .skip(1)
            .take_while(|l| !l.starts_with('$'))
        {
            let n: Vec<usize> = line.split(' ').map(|w| w.parse().unwrap()).collect();
            if n[1] != 11 {
                continue;
            }
            seen += 1;
            let v = &n[5..];
            // Gmsh's order of the edges.
            for (k, (i, j)) in [(0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (3, 1)]
                .into_iter()
                .enumerate()
            {
                let [a, b, m] = [v[i], v[j], v[4 + k]].map(|p| points[p - 1]);
                for ((a, b), m) in a.iter().zip(b).zip(m) {
                    assert!((m - 0.5 * (a + b)).abs() < 1e-14, "{line}");
                }
            }
        }
        assert_eq!(seen, whole.tets.len());
        for format in ["tmesh", "txt"] {
            fails(
                &["--second-order", "--to", format],
                &input,
                2,
                "first-order",
            );
        }
        for format in ["mesh", "inp"] {
            let arguments = ["--second-order", "--to", format];
            let code = run(&arguments, &input).code;
            assert_eq!(code, if format == "inp" { 0 } else { 2 });
        }
    }
}
