//! The flows of `examples/flows`, run by make.

use std::path::Path;

/// Runs make on a flow; returns whether it succeeded and what it said.
fn make(folder: &Path, flow: &str, arguments: &[&str]) -> (bool, String) {
    let output = support::make(folder, flow)
        .args(arguments)
        .output()
        .expect("make is installed");
    let text = [output.stdout, output.stderr].concat();
    (
        output.status.success(),
        String::from_utf8_lossy(&text).into_owned(),
    )
}

#[test]
fn devices_are_made_side_by_side() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (done, text) = make(folder.path(), "gear.mk", &["-j2", "TEETH=8 10"]);
    assert!(done, "{text}");
    for gear in ["gear-8", "gear-10"] {
        for stage in [
            "stl",
            "sym.tmesh",
            "wedge.tmesh",
            "surf.tmesh",
            "tet.tmesh",
            "vtk",
        ] {
            let file = folder.path().join(format!("{gear}.{stage}"));
            assert!(file.is_file(), "{}: {text}", file.display());
        }
        assert!(
            text.contains(&format!("{gear}.quality.txt:all promises hold")),
            "{text}"
        );
    }
    // Nothing is left to do.
    let (done, text) = make(
        folder.path(),
        "gear.mk",
        &["-q", "gear-8.vtk", "gear-10.vtk"],
    );
    assert!(done, "{text}");
}

#[test]
fn one_stage_is_made_to_look_at() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (done, text) = make(
        folder.path(),
        "impeller.mk",
        &["impeller.wedge.vtk", "impeller.sym.txt"],
    );
    assert!(done, "{text}");
    assert!(!text.contains("tetwedge"), "{text}");
    assert!(folder.path().join("impeller.wedge.vtk").is_file());
    let listing = std::fs::read_to_string(folder.path().join("impeller.sym.txt"));
    let listing = listing.expect("a listing");
    assert!(
        listing.contains("template 0") && listing.contains("order"),
        "{listing}"
    );
}

#[test]
fn a_stage_that_fails_stops_the_flow() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("tsv.stl"), "solid broken\n").expect("a file");
    let (done, text) = make(folder.path(), "tsv.mk", &["tsv.vtk"]);
    assert!(!done);
    assert!(text.contains("symdetect: error: tsv.stl: "), "{text}");
    assert!(!text.contains("wedgecut "), "{text}");
    let names = std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(names, 1, "only the input is there: {text}");
}
