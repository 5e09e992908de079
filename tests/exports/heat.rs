//! The flow that solves for heat in a via with CalculiX.

use std::path::Path;
use std::process::Command;

#[test]
fn a_sector_is_as_warm_as_the_whole() {
    if Command::new("ccx").arg("-v").output().is_err() {
        println!("skipped: CalculiX (ccx) is not installed; run make test as root");
        return;
    }
    for order in ["", "--second-order"] {
        let folder = tempfile::tempdir().expect("a folder");
        let output = support::make(folder.path(), "heat.mk")
            .args(["ORDER=6", "THICKNESS=0.05", "EDGE=0.2"])
            .arg(format!("ROTASSEMBLE_FLAGS={order}"))
            .env("OMP_NUM_THREADS", "1")
            .output()
            .expect("make is installed");
        let text = [output.stdout, output.stderr].concat();
        let text = String::from_utf8_lossy(&text);
        assert!(output.status.success(), "{text}");
        assert!(text.contains("temperatures differ by at most"), "{text}");
        // Temperatures that are not those of the whole are noticed.
        let dat = folder.path().join("tsv.sector.deck.dat");
        let names = [
            "sector.inp",
            "sector.deck.dat",
            "whole.inp",
            "whole.deck.dat",
        ];
        let names = names.map(|n| format!("tsv.{n}"));
        assert!(same_temperatures(folder.path(), &names));
        let results = std::fs::read_to_string(&dat).expect("results");
        std::fs::write(&dat, results.replacen("E+00", "E-01", 9)).expect("a file");
        assert!(!same_temperatures(folder.path(), &names));
    }
}

fn same_temperatures(folder: &Path, files: &[String]) -> bool {
    let script = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/flows/same-temperatures.awk"
    );
    let output = Command::new("awk")
        .current_dir(folder)
        .args(["-f", script])
        .args(files)
        .output();
    output.expect("awk is installed").status.success()
}
