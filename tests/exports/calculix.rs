//! Frequencies of one sector, by CalculiX, against those of the whole: with cyclic symmetry, and with
//! conditions at mirror planes.

use crate::tools::{coarse_mesh, rotassemble};
use crate::{BETWEEN_BLADES, off_plane, twisted_impeller};
use bodies::{Body, Encoding, Gear, Impeller, Placement, Ratchet};
use std::path::Path;
use std::process::Command;
use support::encode;

const MATERIAL: &str = "*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n\
                        *SOLID SECTION, ELSET=all-elements, MATERIAL=steel\n";

fn is_there() -> bool {
    let there = Command::new("ccx").arg("-v").output().is_ok();
    if !there {
        println!("skipped: CalculiX (ccx) is not installed; run make test as root");
    }
    there
}

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

/// The frequencies of the whole mesh, rigid motions left out, and the largest one.
fn of_whole(folder: &Path, modes: usize) -> (Vec<f64>, f64) {
    let deck =
        format!("*INCLUDE, INPUT=whole.inp\n{MATERIAL}*STEP\n*FREQUENCY\n{modes}\n*END STEP\n");
    let all = solve(folder, "full", &deck, false);
    let largest = all.iter().map(|m| m.1).fold(0.0, f64::max);
    let elastic = all.iter().map(|m| m.1).filter(|&f| !rigid(f, largest));
    (elastic.collect(), largest)
}

fn rigid(frequency: f64, largest: f64) -> bool {
    frequency < 1e-4 * largest
}

/// Frequencies of a sector of `order` with cyclic symmetry, each as often as it is one of the whole,
/// and how far up they are complete.
fn of_sector(folder: &Path, deck: &str, order: u32, modes: usize, largest: f64) -> (Vec<f64>, f64) {
    let mut deck = format!("*INCLUDE, INPUT={deck}\n{MATERIAL}");
    for diameter in 0..=order / 2 {
        deck += &format!(
            "*STEP\n*FREQUENCY\n{modes}\n*SELECT CYCLIC SYMMETRY MODES, NMIN={diameter}, \
             NMAX={diameter}\n*END STEP\n"
        );
    }
    let found = solve(folder, "cyclic", &deck, true);
    // Every mode comes as a pair of waves; without nodal diameters the two are one.
    let (mut merged, mut limit) = (Vec::new(), largest);
    for diameter in 0..=order / 2 {
        let all = found
            .iter()
            .filter(|m| m.0 == diameter && !rigid(m.1, largest));
        let all: Vec<f64> = all.map(|m| m.1).collect();
        assert!(all.len() >= 8, "{found:?}");
        limit = limit.min(*all.last().expect("some"));
        let single = diameter == 0 || 2 * diameter == order;
        merged.extend(all.iter().step_by(if single { 2 } else { 1 }));
    }
    (merged, limit)
}

/// Both lists are the same below a limit, to a thousandth; gives the worst deviation.
#[track_caller]
fn same(what: &str, mut found: Vec<f64>, mut whole: Vec<f64>, limit: f64) -> f64 {
    for list in [&mut found, &mut whole] {
        list.retain(|&f| f < 0.999 * limit);
        list.sort_by(f64::total_cmp);
    }
    assert_eq!(found.len(), whole.len(), "{what}: {found:?} {whole:?}");
    assert!(whole.len() >= 10, "{what}: {whole:?}");
    let pairs = found.iter().zip(&whole);
    let worst = pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
    println!("{what}: {} modes, worst deviation {worst:.1e}", found.len());
    assert!(worst < 1e-3, "{what}: {found:?} {whole:?}");
    worst
}

fn impeller(order: u32, bore: f64) -> Body {
    let body = Impeller {
        order,
        bore,
        height: 1.0,
        twist: 0.5,
        layers: 4,
        ..Impeller::default()
    };
    body.build()
}

/// Somewhere, so that no direction is one of the coordinates'.
fn placed(mut body: Body) -> Body {
    let placement = Placement {
        rotate: Some(7),
        ..Placement::default()
    };
    placement.apply(&mut body);
    body
}

#[test]
fn a_sector_has_the_frequencies_of_the_whole() {
    if !is_there() {
        return;
    }
    // With two sectors the conditions that CalculiX sets on the axis are those of the whole body.
    for (blades, bore, order, modes) in [(5, 0.2, 5, 16), (4, 0.0, 2, 28)] {
        let temporary = tempfile::tempdir().expect("a folder");
        let folder = temporary.path();
        let surface = encode(&impeller(blades, bore), Encoding::Obj);
        let cut = ["--order", &order.to_string(), "--hub", "none"];
        let input = coarse_mesh(folder, &surface, &cut);
        for elements in [&[][..], &["--second-order"]] {
            let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
            let [sector, whole] = ["sector.inp", "whole.inp"].map(path);
            rotassemble(&input, &[&["--sector", "-o", &sector], elements].concat());
            rotassemble(&input, &[&["-o", &whole], elements].concat());
            let (whole, largest) = of_whole(folder, 40);
            let (found, limit) = of_sector(folder, "sector.inp", order, modes, largest);
            same(&format!("order {order}, {elements:?}"), found, whole, limit);
        }
    }
}

#[test]
fn a_sector_between_blades_has_the_frequencies_of_the_whole() {
    if !is_there() {
        return;
    }
    let temporary = tempfile::tempdir().expect("a folder");
    let folder = temporary.path();
    let surface = encode(&twisted_impeller(7), Encoding::Obj);
    let input = coarse_mesh(folder, &surface, &BETWEEN_BLADES);
    let document = tmesh::read(std::fs::read(&input).expect("a file").as_slice()).expect("valid");
    let off = off_plane(&document);
    assert!(off > 0.05, "{off}");
    let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    let [sector, whole] = ["sector.inp", "whole.inp"].map(path);
    rotassemble(&input, &["--sector", "-o", &sector]);
    rotassemble(&input, &["-o", &whole]);
    let (whole, largest) = of_whole(folder, 40);
    let (found, limit) = of_sector(folder, "sector.inp", 7, 16, largest);
    let worst = same("between blades", found, whole, limit);
    // Seven digits are printed, the whole consists of images of the sector: the last one may differ by one.
    assert!(worst < 1e-6, "{worst:.1e}");
}

#[test]
fn half_a_sector_has_the_frequencies_of_the_whole() {
    if !is_there() {
        return;
    }
    let body = Ratchet {
        order: 5,
        bore: 0.3,
        height: 0.8,
        ..Ratchet::default()
    };
    let temporary = tempfile::tempdir().expect("a folder");
    let folder = temporary.path();
    let surface = encode(&placed(body.build()), Encoding::Obj);
    let input = coarse_mesh(folder, &surface, &["--order", "5"]);
    let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    // Of first order there were fewer unknowns than modes wanted.
    rotassemble(&input, &["--second-order", "-o", &path("whole.inp")]);
    let (whole, largest) = of_whole(folder, 40);
    let (mut found, mut limit) = (Vec::new(), largest);
    for parity in ["symmetric", "wall-level=antisymmetric"] {
        let options = ["--sector", "--second-order", "--mirror", parity, "-o"];
        rotassemble(&input, &[&options[..], &[&path("half.inp")]].concat());
        let (some, complete) = of_sector(folder, "half.inp", 5, 16, largest);
        found.extend(some);
        limit = limit.min(complete);
    }
    same("halves", found, whole, limit);
}

#[test]
fn a_wedge_between_mirror_planes_has_the_frequencies_of_the_whole() {
    if !is_there() {
        return;
    }
    let body = Gear {
        order: 6,
        ..Gear::default()
    };
    let temporary = tempfile::tempdir().expect("a folder");
    let folder = temporary.path();
    let surface = encode(&placed(body.build()), Encoding::Obj);
    let cut = ["--order", "2", "--hub", "none"];
    let cut = [&cut[..], &["--horizontal-mirror", "off"]].concat();
    let input = coarse_mesh(folder, &surface, &cut);
    let path = |name: &str| folder.join(name).to_str().expect("text").to_owned();
    rotassemble(&input, &["-o", &path("whole.inp")]);
    let (whole, largest) = of_whole(folder, 40);
    // A quarter: each mode of the whole is even or odd at each of the two planes.
    let (mut found, mut limit) = (Vec::new(), largest);
    for [a, b] in [["", ""], ["anti", ""], ["", "anti"], ["anti", "anti"]] {
        let [a, b] = [
            format!("wall-a={a}symmetric"),
            format!("wall-b={b}symmetric"),
        ];
        let options = ["--sector", "--mirror", &a, "--mirror", &b, "-o"];
        rotassemble(&input, &[&options[..], &[&path("quarter.inp")]].concat());
        let deck =
            format!("*INCLUDE, INPUT=quarter.inp\n{MATERIAL}*STEP\n*FREQUENCY\n12\n*END STEP\n");
        let all = solve(folder, "quarter-of", &deck, false);
        let elastic = all.iter().map(|m| m.1).filter(|&f| !rigid(f, largest));
        let elastic: Vec<f64> = elastic.collect();
        limit = limit.min(*elastic.last().expect("some"));
        found.extend(elastic);
    }
    same("quarters", found, whole, limit);
}
