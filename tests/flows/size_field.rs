//! Lengths of edges that a background mesh says.

use bodies::{Body, Gear, Prism, Ratchet, Tessellation};
use glam::DVec3;
use std::path::PathBuf;
use support::{EXACT_STL, Field, encode, read, run};
use tempfile::TempDir;
use tmesh::Document;

/// A field around bodies of radius 1, as a file.
fn saved(folder: &TempDir, name: &str, bytes: &[u8]) -> String {
    let path: PathBuf = folder.path().join(name);
    std::fs::write(&path, bytes).expect("a file");
    path.to_str().expect("text").to_owned()
}

fn around(n: u32, size: impl Fn(DVec3) -> f64) -> Field {
    Field::in_box(n, DVec3::splat(-1.3), DVec3::splat(1.3), size)
}

/// Mean length over the length wanted, of as many edges in each bin of that, and of all; elements count their six edges.
fn over_wish(document: &Document, wish: impl Fn(DVec3) -> f64, bins: usize) -> Vec<f64> {
    let mut edges: Vec<[f64; 2]> = Vec::new();
    for template in &document.templates {
        for tet in &template.tets {
            for i in 0..4 {
                for j in 0..i {
                    let [p, q] = [i, j].map(|k| {
                        let p = template.vertices[tet.vertices[k] as usize];
                        document.frame.to_world(p)
                    });
                    edges.push([wish(0.5 * (p + q)), p.distance(q)]);
                }
            }
        }
    }
    edges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let each = edges.chunks(edges.len().div_ceil(bins));
    each.map(|bin| {
        let [wished, long] = bin.iter().fold([0.0; 2], |s, e| [s[0] + e[0], s[1] + e[1]]);
        long / wished
    })
    .collect()
}

/// What is on the radius about z.
fn linear(p: DVec3) -> f64 {
    0.035 + 0.05 * p.truncate().length()
}

#[track_caller]
fn is_exact(filled: &[u8]) {
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], filled).success();
    run("meshqual", &["-q", "--check"], &whole).success();
}

fn found(body: &Body) -> Vec<u8> {
    run("symdetect", &["-q"], &encode(body, EXACT_STL)).success()
}

/// Lengths that grow from the axis on, in a wedge between mirror planes, one with a seam, and one with a hub: all of them within a sixth of
/// what is wanted, the mesh exactly symmetric, the bytes the same with one thread and with two. Only wedgecut is told.
#[test]
fn edges_are_as_long_as_the_field_wants() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = saved(&folder, "f.vtk", &around(16, linear).vtk());
    let gear = Gear::default().build();
    let ratchet = Ratchet {
        order: 5,
        ..Ratchet::default()
    };
    let disc = Prism {
        order: 32,
        radius: 1.0,
        height: 0.5,
        bore: 0.0,
        tessellation: Tessellation::Symmetric,
    };
    for (name, body) in [
        ("gear", gear),
        ("ratchet", ratchet.build()),
        ("disc", disc.build()),
    ] {
        let cut = run("wedgecut", &["-q", "--size-field", &file], &found(&body)).success();
        let filled = run("tetwedge", &["-q", "--threads", "1"], &cut).success();
        is_exact(&filled);
        let again = run("tetwedge", &["-q", "--threads", "2"], &cut).success();
        let [first, second] = [&filled, &again].map(|bytes| read(bytes));
        assert_eq!(first.templates, second.templates, "{name}");
        for ratio in over_wish(&first, linear, 5) {
            println!("{name}: {ratio:.3}");
            assert!((ratio - 1.0).abs() < 1.0 / 6.0, "{name}: {ratio}");
        }
    }
}

/// Where a surface is remeshed it follows the field, up and down: a cylinder of two hundred facets.
#[test]
fn remeshed_surfaces_follow_the_field() {
    let folder = tempfile::tempdir().expect("a folder");
    let along = |p: DVec3| 0.05 + 0.1 * p.z.max(0.0);
    let file = saved(&folder, "f.vtk", &around(16, along).vtk());
    let cylinder = Prism {
        order: 200,
        radius: 1.0,
        height: 1.0,
        bore: 0.5,
        tessellation: Tessellation::Symmetric,
    };
    let whole = ["--order", "8", "--horizontal-mirror", "off"];
    let asked = ["-q", "--deviation", "5e-3", "--size-field", &file];
    let cut = run(
        "wedgecut",
        &[&asked[..], &whole].concat(),
        &found(&cylinder.build()),
    );
    let filled = run("tetwedge", &["-q"], &cut.success()).success();
    is_exact(&filled);
    let found = over_wish(&read(&filled), along, 5);
    for ratio in &found {
        assert!((0.75..1.2).contains(ratio), "{found:?}");
    }
}

/// A field that only one copy has makes all of them fine there, and nothing else.
#[test]
fn the_least_of_all_images_counts() {
    let folder = tempfile::tempdir().expect("a folder");
    let angle = 5.5_f64;
    let spot = DVec3::new(0.7 * angle.cos(), 0.7 * angle.sin(), 0.5);
    let fine = |p: DVec3| 0.03 + 0.5 * (p.distance(spot) - 0.05).max(0.0);
    let file = saved(&folder, "f.vtk", &around(40, fine).vtk());
    for body in [
        Prism {
            order: 6,
            radius: 1.0,
            height: 1.0,
            bore: 0.3,
            tessellation: Tessellation::Symmetric,
        }
        .build(),
        Ratchet {
            order: 6,
            height: 1.0,
            ..Ratchet::default()
        }
        .build(),
    ] {
        let cut = run("wedgecut", &["-q", "--size-field", &file], &found(&body)).success();
        let filled = run("tetwedge", &["-q"], &cut).success();
        is_exact(&filled);
        let filled = read(&filled);
        let images = |p: DVec3| {
            let p = filled.frame.to_canonical(p);
            let places = filled.instances.iter().filter(|i| i.template == 0);
            let images = places.map(|i| filled.frame.to_world(i.isometry.apply(p)));
            images.map(fine).fold(f64::INFINITY, f64::min)
        };
        let found = over_wish(&filled, images, 4);
        assert!((found[0] - 1.0).abs() < 0.25, "{found:?}");
        let count: usize = filled.templates.iter().map(|t| t.tets.len()).sum();
        assert!(count > 500, "{count}");
    }
}

/// All formats say the same.
#[test]
fn formats_are_alike() {
    let folder = tempfile::tempdir().expect("a folder");
    let found = found(&Gear::default().build());
    let field = around(8, linear);
    let files = [
        ("f.vtk", field.vtk()),
        ("g.vtk", field.vtk_binary()),
        ("f.vtu", field.vtu()),
        ("f.msh", field.msh2()),
        ("g.msh", field.msh4()),
        // The content tells.
        ("field", field.vtu()),
    ];
    let each = files.map(|(name, bytes)| {
        let file = saved(&folder, name, &bytes);
        let by_name = format!("{file}:length");
        let both = [file, by_name].map(|file| {
            let cut = run("wedgecut", &["-q", "--size-field", &file], &found).success();
            read(&cut).size_field.expect("a field")
        });
        assert_eq!(both[0], both[1]);
        both[0].clone()
    });
    for (other, (name, _)) in each
        .iter()
        .zip(["f", "g", "vtu", "msh2", "msh4", "-"].map(|n| (n, ())))
    {
        assert_eq!(&each[0], other, "{name}");
    }
    assert_eq!((each[0].points.len(), each[0].tets.len()), (729, 3072));
}

/// The field is a wish like others: it is inherited, may be told otherwise, and stays when copies are put together; the least of it and
/// of a general length counts, and a smaller gradation takes more elements.
#[test]
fn a_field_is_a_wish_like_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let step = |p: DVec3| if p.z > 0.75 { 0.05 } else { 1.0 };
    let file = saved(&folder, "f.vtk", &around(16, step).vtk());
    let coarse = saved(&folder, "c.vtk", &around(2, |_| 0.3).vtk());
    let prism = Prism {
        order: 6,
        radius: 1.0,
        height: 1.0,
        bore: 0.3,
        tessellation: Tessellation::Symmetric,
    };
    let whole = ["-q", "--horizontal-mirror", "off", "--size-field", &file];
    let cut = run("wedgecut", &whole, &found(&prism.build())).success();
    let filled = |asked: &[&str]| run("tetwedge", &[&["-q"], asked].concat(), &cut).success();
    let count = |asked: &[&str]| read(&filled(asked)).templates[0].tets.len();
    let inherited = count(&[]);
    let steep = count(&["--gradation", "2"]);
    let gentle = count(&["--gradation", "1.1"]);
    assert!(
        2 * gentle > 3 * inherited && inherited > steep,
        "{gentle} {inherited} {steep}"
    );
    assert!(count(&["--size-field", &coarse]) * 2 < inherited);
    assert!(count(&["--edge-length", "0.06"]) > 2 * inherited);
    // What a general length leaves to do is done.
    assert!(count(&["--edge-length", "0.5"]) >= inherited * 9 / 10);
    let filled = filled(&[]);
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &filled).success();
    assert_eq!(read(&whole).size_field, read(&cut).size_field);
    // Nothing is asked for without quality.
    let plain = count(&["--no-quality"]);
    assert!(plain < 100, "{plain}");
}

/// wedgecut chooses as for a length that is the same everywhere.
#[test]
fn the_choice_of_an_order_sees_the_field() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = saved(&folder, "f.vtk", &around(4, |_| 0.02).vtk());
    let disc = Prism {
        order: 96,
        radius: 1.0,
        height: 0.3,
        bore: 0.0,
        tessellation: Tessellation::Symmetric,
    };
    let found = found(&disc.build());
    let why = |asked: &[&str]| {
        let cut = run("wedgecut", &[&["-v"], asked].concat(), &found);
        let reason = cut
            .stderr
            .lines()
            .find_map(|line| line.split("] order ").nth(1));
        let reason = reason.expect("a reason").split(':').next();
        reason.expect("an order").to_owned()
    };
    let [none, length, field] = [
        why(&[]),
        why(&["--edge-length", "0.02"]),
        why(&["--size-field", &file]),
    ];
    assert_eq!(length, field);
    assert_ne!(none, field);
}
