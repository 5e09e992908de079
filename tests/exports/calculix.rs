//! Frequencies of a chiral body: one sector with cyclic symmetry against the whole, by CalculiX.

use crate::generator::{Encoding, Impeller, Tessellation};
use crate::tools::{coarse_mesh, encode, rotassemble};
use std::path::Path;
use std::process::Command;

const ORDER: u32 = 5;
const MATERIAL: &str = "*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n\
                        *SOLID SECTION, ELSET=all-elements, MATERIAL=steel\n";

/// Solves a deck; returns nodal diameter (0 when it has none) and frequency of each mode.
fn solve(folder: &Path, name: &str, deck: &str, cyclic: bool) -> Vec<(u32, f64)> {
    std::fs::write(folder.join(format!("{name}.inp")), deck).expect("a file");
    let output = Command::new("ccx")
        .args(["-i", name])
        .current_dir(folder)
        .env("OMP_NUM_THREADS", "1")
        .output()
        .expect("it ran before");
    let log = String::from_utf8_lossy(&output.stdout);
    for word in ["*WARNING", "*ERROR"] {
        assert!(!log.contains(word), "{name}: {log}");
    }
    let results = std::fs::read_to_string(folder.join(format!("{name}.dat"))).expect("results");
    let columns = if cyclic { 6 } else { 5 };
    results
        .lines()
        .filter_map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let numbers: Option<Vec<f64>> = words.iter().map(|w| w.parse().ok()).collect();
            let numbers = numbers.filter(|n| n.len() == columns)?;
            let diameter = if cyclic { numbers[0] as u32 } else { 0 };
            Some((diameter, numbers[columns - 2]))
        })
        .collect()
}

#[test]
fn a_sector_has_the_frequencies_of_the_whole() {
    if Command::new("ccx").arg("-v").output().is_err() {
        println!("skipped: CalculiX (ccx) is not installed; run make test as root");
        return;
    }
    let body = Impeller {
        order: ORDER,
        radius: 1.0,
        bore: 0.2,
        height: 1.0,
        twist: 0.5,
        layers: 4,
        tessellation: Tessellation::Symmetric,
    }
    .build();
    let temporary = tempfile::tempdir().expect("a folder");
    let folder = temporary.path();
    let surface = encode(&body, Encoding::Obj);
    let input = coarse_mesh(folder, &surface, &["--order", "5", "--hub", "none"]);
    for order in [&[][..], &["--second-order"]] {
        let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
        let [sector, whole] = ["sector.inp", "whole.inp"].map(path);
        rotassemble(&input, &[&["--sector", "-o", &sector], order].concat());
        rotassemble(&input, &[&["-o", &whole], order].concat());
        let mut deck = format!("*INCLUDE, INPUT=sector.inp\n{MATERIAL}");
        for diameter in 0..=ORDER / 2 {
            deck += &format!(
                "*STEP\n*FREQUENCY\n16\n*SELECT CYCLIC SYMMETRY MODES, NMIN={diameter}, \
                 NMAX={diameter}\n*END STEP\n"
            );
        }
        let of_sector = solve(folder, "cyclic", &deck, true);
        let deck =
            format!("*INCLUDE, INPUT=whole.inp\n{MATERIAL}*STEP\n*FREQUENCY\n40\n*END STEP\n");
        let of_whole = solve(folder, "full", &deck, false);
        let largest = of_whole.iter().map(|m| m.1).fold(0.0, f64::max);
        let rigid = |f: f64| f < 1e-4 * largest;

        // Every mode comes as a pair of waves; without nodal diameters the two are one.
        let mut merged = Vec::new();
        let mut limit = largest;
        for diameter in 0..=ORDER / 2 {
            let all = of_sector.iter().filter(|m| m.0 == diameter && !rigid(m.1));
            let all: Vec<f64> = all.map(|m| m.1).collect();
            assert!(all.len() >= 8, "{of_sector:?}");
            limit = limit.min(*all.last().expect("some"));
            let single = diameter == 0 || 2 * diameter == ORDER;
            merged.extend(all.iter().step_by(if single { 2 } else { 1 }));
        }
        merged.sort_by(f64::total_cmp);
        let elastic: Vec<f64> = of_whole
            .iter()
            .map(|m| m.1)
            .filter(|&f| !rigid(f))
            .collect();
        let below = |list: &[f64]| list.iter().filter(|&&f| f < 0.999 * limit).count();
        let count = below(&elastic);
        assert!(count >= 10, "{elastic:?}");
        assert_eq!(below(&merged), count, "{merged:?} {elastic:?}");
        let mut worst = 0.0_f64;
        for (a, b) in merged.iter().zip(&elastic[..count]) {
            worst = worst.max((a / b - 1.0).abs());
        }
        println!("{count} modes, {order:?}: worst deviation {worst:.1e}");
        assert!(worst < 1e-3, "{merged:?} {elastic:?}");
    }
}
