//! Background meshes that are none, and those that fit no body.

use bodies::{Gear, Prism};
use glam::DVec3;
use support::{EXACT_STL, Field, encode, run};
use tempfile::TempDir;

fn gear() -> Vec<u8> {
    let body = encode(&Gear::default().build(), EXACT_STL);
    run("symdetect", &["-q"], &body).success()
}

fn field() -> Field {
    Field::in_box(3, DVec3::splat(-1.5), DVec3::splat(1.5), |_| 0.3)
}

fn saved(folder: &TempDir, name: &str, bytes: &[u8]) -> String {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("a file");
    path.to_str().expect("text").to_owned()
}

/// Everything that may be wrong with the file: the exit code, a sentence that says what and where, nothing on standard output.
#[test]
fn files_that_say_no_lengths() {
    let folder = tempfile::tempdir().expect("a folder");
    let found = gear();
    let whole = field();
    let count = whole.points.len();
    let with = |at: usize, size: f64| {
        let mut field = field();
        field.sizes[at] = size;
        field
    };
    let scalars = |name: &str| {
        let mut text = format!("SCALARS {name} double 1\nLOOKUP_TABLE default\n");
        text.extend((0..count).map(|_| "0.3\n"));
        text
    };
    let data = |arrays: &str| whole.vtk_with(&format!("POINT_DATA {count}\n{arrays}"));
    let mut vectors = "VECTORS v double\n".to_owned();
    vectors.extend((0..count).map(|_| "1 0 0\n"));
    let empty = Field {
        tets: Vec::new(),
        ..field()
    };
    let mut beyond = field();
    beyond.tets[5][2] = 64;
    let cases: [(&str, Vec<u8>, i32, &[&str]); 17] = [
        (
            "none.vtk",
            whole.vtk_with(""),
            3,
            &["no array with one number at each point"],
        ),
        (
            "vectors.vtk",
            data(&vectors),
            3,
            &["no array with one number at each point"],
        ),
        (
            "two.vtk",
            data(&[scalars("h"), scalars("T")].concat()),
            2,
            &["name one of 'h', 'T' as", "two.vtk:NAME"],
        ),
        (
            "zero.vtk",
            with(21, 0.0).vtk(),
            3,
            &["'length' has 0 at point 21 at (-0.5, -0.5, -0.5)"],
        ),
        (
            "less.vtk",
            with(0, -0.25).vtk_binary(),
            3,
            &["'length' has -0.25 at point 0 at (-1.5, -1.5, -1.5)"],
        ),
        (
            "nan.vtk",
            with(63, f64::NAN).vtk_binary(),
            3,
            &["no number at point 63 at (1.5, 1.5, 1.5)"],
        ),
        (
            "nan.vtu",
            with(63, f64::NAN).vtu(),
            3,
            &["no number at point 63"],
        ),
        (
            "zero.msh",
            with(21, 0.0).msh2(),
            3,
            &["has 0 at point 22 at"],
        ),
        (
            "inf.msh",
            with(0, f64::INFINITY).msh4(),
            3,
            &["has inf at point 1 at"],
        ),
        ("empty.vtk", empty.vtk(), 3, &["no elements"]),
        ("empty.msh", empty.msh2(), 3, &["no elements"]),
        (
            "beyond.vtk",
            beyond.vtk(),
            3,
            &["cell 5 names point 64, and there are 64"],
        ),
        ("nothing.vtk", Vec::new(), 3, &["is empty"]),
        ("words.vtk", b"lengths\n".to_vec(), 3, &["words.vtk"]),
        (
            "gear.stl",
            encode(&Gear::default().build(), EXACT_STL),
            3,
            &["stl has no numbers at points"],
        ),
        (
            "tiny.vtk",
            Field::in_box(2, DVec3::splat(-1500.0), DVec3::splat(-900.0), |_| 300.0).vtk(),
            1,
            &["they do not meet", "same unit"],
        ),
        (
            "short.vtk",
            data("SCALARS h double 1\nLOOKUP_TABLE default\n0.3 0.3"),
            3,
            &["short.vtk"],
        ),
    ];
    for (name, bytes, code, parts) in &cases {
        let file = saved(&folder, name, bytes);
        run("wedgecut", &["-q", "--size-field", &file], &found).fails(*code, parts);
    }
    let file = saved(&folder, "two.vtk", &cases[2].1);
    run(
        "wedgecut",
        &["-q", "--size-field", &format!("{file}:h")],
        &found,
    )
    .success();
    run(
        "wedgecut",
        &["-q", "--size-field", &format!("{file}:x")],
        &found,
    )
    .fails(2, &["no array 'x'", "it has 'h', 'T'"]);
    let missing = folder.path().join("missing.vtk");
    let missing = missing.to_str().expect("text");
    run("tetwedge", &["-q", "--size-field", missing], &found)
        .fails(3, &["cannot read", "missing.vtk"]);
    run(
        "tetwedge",
        &["-q", "--size-field", folder.path().to_str().expect("text")],
        &found,
    )
    .fails(3, &["it is a directory"]);
    run("tetwedge", &["-q", "--size-field", "-"], &found).fails(2, &["standard input is the body"]);
    run("symdetect", &["-q", "--size-field", &file], &[]).fails(2, &["--size-field"]);
}

/// Files that are cut off anywhere are refused or say nothing else than the whole ones.
#[test]
fn truncated_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let found = gear();
    let whole = Field::in_box(1, DVec3::splat(-1.5), DVec3::splat(1.5), |_| 0.3);
    for (name, bytes) in [
        ("t.vtk", whole.vtk()),
        ("b.vtk", whole.vtk_binary()),
        ("t.vtu", whole.vtu()),
        ("t.msh", whole.msh2()),
        ("b.msh", whole.msh4()),
    ] {
        // The last numbers of a text may lose digits.
        for part in 1..12 {
            let file = saved(&folder, name, &bytes[..bytes.len() * part / 13]);
            run("wedgecut", &["-q", "--size-field", &file], &found).fails(3, &[name]);
        }
    }
}

/// A body that stands out of its field is said to, and still meshed; lengths in another unit are noticed.
#[test]
fn bodies_that_stand_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let found = gear();
    let high = DVec3::new(1.5, 1.5, 0.1);
    let low = Field::in_box(4, DVec3::splat(-1.5), high, |_| 0.3);
    let file = saved(&folder, "f.vtk", &low.vtk());
    let told = run("wedgecut", &["--size-field", &file], &found);
    assert!(
        told.stderr
            .contains("the body stands out of its size field"),
        "{}",
        told.stderr
    );
    let cut = told.success();
    let filled = run("tetwedge", &["-q"], &cut).success();
    run("meshqual", &["-q", "--check"], &filled).success();
    let body = encode(&Prism::default().build(), EXACT_STL);
    let found = run("symdetect", &["-q"], &body).success();
    let tiny = Field::in_box(2, DVec3::splat(-1.5), DVec3::splat(1.5), |_| 1e-7);
    let file = saved(&folder, "f.vtk", &tiny.vtk());
    let cut = run("wedgecut", &["-q", "--size-field", &file], &found).success();
    run("tetwedge", &["-q"], &cut).fails(1, &["more elements than can be made"]);
}
