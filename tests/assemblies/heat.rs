//! A motor in air, solved for heat by CalculiX: a wedge between mirror planes, where nothing flows through its walls, against
//! the whole.

use bodies::{Body, PolarGrid};
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use support::{binary, finish, read};
use tmesh::{Group, Kind};

/// The solids, their conductivities in W/(mm K) and the power in them in W/mm^3.
const SOLIDS: [(&str, f64, f64); 5] = [
    ("shaft", 0.045, 0.0),
    ("rotor", 0.028, 0.0),
    ("magnets", 0.009, 1e-6),
    ("stator", 0.028, 0.0),
    ("coils", 0.385, 1e-5),
];
const AIR: f64 = 2.6e-5;

/// A rotor with four magnets on a shaft, in a stator whose slots are filled by coils; an air gap between them.
fn motor() -> Body {
    let grid = PolarGrid {
        sectors: 32,
        radii: vec![0.0, 4.0, 9.0, 11.0, 12.0, 16.0, 20.0],
        heights: vec![-2.0, 0.0, 15.0, 17.0],
    };
    let names = SOLIDS.map(|s| s.0);
    grid.build(&names, Group::new(Kind::Cv, 4), |[i, j, k]| match (j, k) {
        (0, _) => Some(0),
        (1, 1) => Some(1),
        (2, 1) if (1..7).contains(&(i % 8)) => Some(2),
        (4, 1) if [1, 2].contains(&(i % 4)) => Some(4),
        (4 | 5, 1) => Some(3),
        _ => None,
    })
}

/// The deck of a mesh: material sets by name, power in the coils and magnets, the outer boundary cooled.
fn deck(folder: &Path, name: &str) -> String {
    let mesh = std::fs::read_to_string(folder.join(format!("{name}.inp"))).expect("a mesh");
    let mut deck = format!("*INCLUDE, INPUT={name}.inp\n");
    let air = ("air", AIR, 0.0);
    for (region, conductivity, _) in SOLIDS.iter().chain([&air]) {
        let material = format!("of-{region}");
        writeln!(
            deck,
            "*MATERIAL, NAME={material}\n*CONDUCTIVITY\n{conductivity}"
        )
        .expect("text");
        writeln!(deck, "*SOLID SECTION, ELSET={region}, MATERIAL={material}").expect("text");
    }
    deck += "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nall-nodes, 0.\n";
    deck += "*STEP\n*HEAT TRANSFER, STEADY STATE\n1., 1.\n*FILM\n";
    let cooled = mesh
        .split("*SURFACE, NAME=enclosure,")
        .nth(1)
        .expect("the outer boundary");
    for line in cooled
        .lines()
        .skip(1)
        .take_while(|line| !line.starts_with('*'))
    {
        writeln!(deck, "{}, 0., 1e-5", line.replace('S', "F")).expect("text");
    }
    deck += "*DFLUX\n";
    for (region, _, power) in SOLIDS.iter().filter(|s| s.2 > 0.0) {
        writeln!(deck, "{region}, BF, {power:e}").expect("text");
    }
    deck + "*NODE PRINT, NSET=all-nodes\nNT\n*END STEP\n"
}

#[test]
fn a_wedge_of_a_motor_is_as_warm_as_the_whole() {
    if Command::new("ccx").arg("-v").output().is_err() {
        println!("skipped: CalculiX (ccx) is not installed; run make test as root");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    crate::motor::write_solids(&motor(), folder);
    let files = SOLIDS.map(|s| format!("{}.stl", s.0));
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let stages: [&[&str]; 5] = [
        &[
            &["symdetect", "--enclosure", "cylinder:1.3", "-o", "s.tmesh"],
            &files[..],
        ]
        .concat(),
        &["wedgecut", "s.tmesh", "-o", "w.tmesh"],
        &["tetwedge", "w.tmesh", "-o", "t.tmesh"],
        &["rotassemble", "t.tmesh", "-o", "whole.inp"],
        &["rotassemble", "--sector", "t.tmesh", "-o", "sector.inp"],
    ];
    for stage in stages {
        let mut command = Command::new(binary(stage[0]));
        command.args(&stage[1..]).current_dir(folder);
        finish(stage[0], command, b"").success();
    }
    let symmetry = read(&std::fs::read(folder.join("s.tmesh")).expect("a document")).symmetry;
    assert_eq!(symmetry.expect("a symmetry").group.symbol(), "D4h");
    let mut files = Vec::new();
    for name in ["sector", "whole"] {
        std::fs::write(folder.join(format!("{name}.deck.inp")), deck(folder, name))
            .expect("a file");
        let output = Command::new("ccx")
            .args(["-i", &format!("{name}.deck")])
            .current_dir(folder)
            .env("OMP_NUM_THREADS", "1")
            .output()
            .expect("it ran before");
        let log = String::from_utf8_lossy(&output.stdout);
        assert!(
            !log.contains("*WARNING") && !log.contains("*ERROR"),
            "{name}: {log}"
        );
        files.extend([format!("{name}.inp"), format!("{name}.deck.dat")]);
    }
    let script = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/flows/same-temperatures.awk"
    );
    let compared = Command::new("awk")
        .args(["-f", script])
        .args(&files)
        .current_dir(folder)
        .output();
    let compared = compared.expect("awk is installed");
    let text = String::from_utf8_lossy(&compared.stdout);
    assert!(compared.status.success(), "{text}");
    println!("{text}");
    assert!(!text.contains("highest temperature 0\n"), "{text}");
}
