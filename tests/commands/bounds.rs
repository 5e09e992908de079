//! Bounds on elements travel in the document, and every tool says where they are not met; `--strict` makes it a failure.

use bodies::{Antiprism, Prism};
use support::{EXACT_STL, bytes, encode, run};

/// More than the angles that a wedge of 45 degrees leaves to elements.
const TOO_MUCH: [&str; 2] = ["--min-dihedral", "60"];

/// A prism of four sides, cut and filled, with bounds that cannot be met.
fn short() -> Vec<u8> {
    let wedge = bytes(&bodies::wedges::prism(4));
    let filled = run("tetwedge", &TOO_MUCH, &wedge);
    assert!(
        filled.stderr.contains("of 60 asked for"),
        "{}",
        filled.stderr
    );
    filled.success()
}

/// What is said with `-q`, without, and with `--strict`.
#[track_caller]
fn said(tool: &str, arguments: &[&str], input: &[u8], parts: &[&str]) {
    let outcome = run(tool, arguments, input);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(!outcome.stdout.is_empty());
    for part in parts {
        assert!(
            outcome.stderr.contains(part),
            "{tool}: {part}: {}",
            outcome.stderr
        );
    }
    let quiet = run(tool, &[arguments, &["-q"]].concat(), input);
    assert_eq!((quiet.code, quiet.stderr.as_str()), (0, ""));
    let strict = run(tool, &[arguments, &["--strict"]].concat(), input);
    if tool == "meshqual" {
        // The report is written all the same.
        assert_eq!(strict.code, 1);
        assert!(String::from_utf8_lossy(&strict.stdout).contains("NOT MET dihedral"));
    } else {
        strict.fails(1, parts);
    }
}

#[test]
fn tools_that_read_a_mesh_say_what_it_does_not_meet() {
    let mesh = short();
    let parts = [
        "dihedral ",
        " of 60 asked for: ",
        " below, most ",
        " near (",
    ];
    said("rotassemble", &["--to", "vtk"], &mesh, &parts);
    said("rotassemble", &["--sector", "--to", "msh"], &mesh, &parts);
    said("meshqual", &[], &mesh, &parts);
    // Bounds are in the assembled mesh as well, and elements are counted alike.
    let whole = run("rotassemble", &["-q", "--to", "tmesh"], &mesh).success();
    said("meshqual", &[], &whole, &parts);
    let count = |input: &[u8]| {
        let text = run("meshqual", &[], input).stderr;
        let after = text.split("asked for: ").nth(1).map(str::to_owned);
        after.and_then(|t| Some(t.split(' ').next()?.to_owned()))
    };
    assert!(count(&mesh).is_some());
    assert_eq!(count(&mesh), count(&whole));
    let counted = ["--count-below", "min_dihedral_deg=60", "-q"];
    let table = run("meshqual", &counted, &mesh).success();
    let expected = format!(
        "min_dihedral_deg below 60: {} ",
        count(&mesh).expect("counted above")
    );
    let table = String::from_utf8_lossy(&table).replace('\u{a0}', "");
    assert!(table.contains(&expected), "{expected}: {table}");
}

#[test]
fn what_is_met_is_not_mentioned() {
    let wedge = bytes(&bodies::wedges::prism(4));
    let easy = ["--min-dihedral", "5", "--strict"];
    let mesh = run("tetwedge", &easy, &wedge);
    assert_eq!(mesh.stderr, "");
    let mesh = mesh.success();
    for tool in ["rotassemble", "meshqual"] {
        let outcome = run(tool, &["--strict"], &mesh);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    }
    // No quality was asked for.
    let plain = run("tetwedge", &["--no-quality", "--strict"], &wedge).success();
    assert_eq!(run("meshqual", &["--strict"], &plain).stderr, "");
}

#[test]
fn bounds_by_default_are_bounds() {
    let wedge = bytes(&bodies::wedges::prism(4));
    let mesh = run("tetwedge", &[], &wedge).success();
    let document = tmesh::read(mesh.as_slice()).expect("a document");
    assert_eq!(document.wishes.min_dihedral, Some(10.0));
    assert_eq!(document.wishes.radius_edge, Some(1.4));
}

#[test]
fn a_file_without_bounds_is_said_to_have_none() {
    let vtk = run("rotassemble", &["-q"], &short()).success();
    let outcome = run("meshqual", &["--strict"], &vtk);
    assert_eq!(outcome.code, 0);
    assert!(
        outcome.stderr.contains("does not say what was asked"),
        "{}",
        outcome.stderr
    );
    assert_eq!(run("meshqual", &[], &vtk).stderr, "");
}

/// At faces that are kept as they are, the mesher leaves elements that are larger than asked for.
#[test]
fn sizes_that_are_not_kept_are_said() {
    let body = Antiprism {
        order: 5,
        radius: 1.0,
        bore: 0.0,
        height: 0.8,
    };
    let found = run("symdetect", &["-q"], &encode(&body.build(), EXACT_STL)).success();
    let cut = [
        "-q",
        "--edge-length",
        "0.1",
        "--order",
        "5",
        "--hub",
        "0.41",
    ];
    let wedge = run("wedgecut", &cut, &found).success();
    said(
        "tetwedge",
        &[
            "--keep-surface",
            "--edge-length",
            "0.07",
            "--optimize",
            "off",
        ],
        &wedge,
        &["volume ", " asked for by edges of 0.07: ", " above, most "],
    );
    let own = [
        "--keep-surface",
        "--region",
        "body:max-volume=8.575e-5",
        "--optimize",
        "off",
    ];
    said(
        "tetwedge",
        &own,
        &wedge,
        &["of 8.575e-5 asked for in 'body'"],
    );
    // Improvement divides them.
    for keep in [&own[..3], &["--keep-surface", "--edge-length", "0.07"]] {
        let improved = run("tetwedge", keep, &wedge);
        assert_eq!(improved.code, 0, "{}", improved.stderr);
        assert!(!improved.stderr.contains("volume"), "{}", improved.stderr);
    }
}

/// A wedge of 180/64 degrees on the axis: no element there has a larger angle, which is known before there is one.
#[test]
fn a_wedge_too_narrow_for_the_angle_is_said_to_be() {
    let body = Prism {
        order: 64,
        height: 0.5,
        ..Prism::default()
    };
    let found = run("symdetect", &["-q"], &encode(&body.build(), EXACT_STL)).success();
    let narrow = ["--order", "64", "--hub", "none"];
    let parts = ["dihedral 2.8125 of 10 asked for", "the axis", "--hub"];
    said("wedgecut", &narrow, &found, &parts);
    let wide = run("wedgecut", &["--strict"], &found);
    assert_eq!((wide.code, wide.stderr.as_str()), (0, ""));
    // Whoever works on the wedge says the same.
    let wedge = run("wedgecut", &[&narrow[..], &["-q"]].concat(), &found).success();
    for tool in ["periodic-surf", "rotassemble"] {
        said(tool, &[], &wedge, &parts[..2]);
    }
    let asked_less = run(
        "periodic-surf",
        &["--min-dihedral", "2.5", "--strict"],
        &wedge,
    );
    assert_eq!((asked_less.code, asked_less.stderr.as_str()), (0, ""));
}
