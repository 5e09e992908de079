//! The flow that takes a gear through Gmsh's reader into dolfinx.

use std::process::Command;

/// A Python that has dolfinx, which comes with the system and not by pip.
fn python() -> Option<&'static str> {
    ["python3", "/usr/bin/python3"].into_iter().find(|python| {
        let check = ["-c", "import dolfinx, gmsh"];
        let output = Command::new(python).args(check).output();
        output.is_ok_and(|o| o.status.success())
    })
}

#[test]
fn dolfinx_reads_volumes_and_names_on_several_ranks() {
    let Some(python) = python() else {
        println!("skipped: no Python with dolfinx and gmsh (python3-dolfinx, python3-gmsh)");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let output = support::make(folder.path(), "poisson.mk")
        .args(["TEETH=7", "VOLUME=1e-2"])
        .arg(format!("PYTHON={python}"))
        // Open MPI as root.
        .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
        .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
        .env("OMP_NUM_THREADS", "1")
        .output()
        .expect("make is installed");
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    assert!(output.status.success(), "{text}");
    assert!(text.contains(", 4 ranks, "), "{text}");
    assert_eq!(text.matches("\narea body ").count(), 2, "{text}");
    // Volumes as the report of the quality has them.
    let mesh = folder.path().join("gear.tet.tmesh");
    let report = folder.path().join("quality.json");
    let measured = Command::new(env!("CARGO_BIN_EXE_meshqual"))
        .args(["-q", "--json", report.to_str().expect("text")])
        .arg(&mesh)
        .output()
        .expect("it runs");
    assert!(measured.status.success());
    let report = std::fs::read(report).expect("a file");
    let report: serde_json::Value = serde_json::from_slice(&report).expect("JSON");
    let volume = report["volume"].as_f64().expect("a volume");
    let lines = text.lines().filter_map(|l| l.strip_prefix("volume "));
    let found: Vec<f64> = lines.map(|v| v.parse().expect("a number")).collect();
    assert_eq!(found.len(), 2, "{text}");
    for v in found {
        assert!((v / volume - 1.0).abs() < 1e-9, "{v} {volume}");
    }
}
