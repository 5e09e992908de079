//! Many devices by a workflow engine.

use crate::referee::python;
use std::path::Path;
use std::process::Command;

#[test]
fn devices_of_a_sweep_are_in_its_table() {
    let Some(python) = python() else {
        println!("skipped: REFEREE does not name an environment with Snakemake; run make test");
        return;
    };
    let snakemake = |arguments: &[&str], folder: &Path| {
        let mut command = Command::new(&python);
        command.args(["-m", "snakemake"]).args(arguments);
        // Its caches, too.
        command.current_dir(folder).env("XDG_CACHE_HOME", folder);
        command.output().expect("Python runs")
    };
    let folder = tempfile::tempdir().expect("a folder");
    if !snakemake(&["--version"], folder.path()).status.success() {
        println!("skipped: Snakemake is not installed; run make test");
        return;
    }
    let output = snakemake(
        &[
            "--snakefile",
            concat!(env!("CARGO_MANIFEST_DIR"), "/examples/flows/sweep.smk"),
            "--cores",
            "2",
            "--config",
            &format!("bin={}/", support::binaries().display()),
            &format!("body={}", support::generator().display()),
            "size=--edge-length 0.3",
            "devices={\"gear-9\": \"gear --order 9\", \"solid\": \"tsv --order 16 --thickness 0.05\"}",
        ],
        folder.path(),
    );
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    let table = std::fs::read_to_string(folder.path().join("sweep.csv")).expect("a table");
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    assert_eq!(rows[0][..3], ["device", "order", "tetrahedra"]);
    let rows = &rows[1..];
    let [gear, solid] = rows else {
        panic!("{table}");
    };
    // With edges of that length, all nine would be narrower than elements.
    assert_eq!(gear[..2], ["gear-9", "3"]);
    assert_eq!(solid[0], "solid");
    for row in rows {
        assert_eq!(row.last(), Some(&"True"), "{table}");
        assert!(folder.path().join(format!("{}.vtk", row[0])).is_file());
    }
}
