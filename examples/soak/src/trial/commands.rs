//! The pipe of a trial: which tools, with which options.

use super::subject::{Subject, Symmetry};
use bodies::Dice;

/// A tool and its arguments.
pub type Stage = Vec<String>;

/// The words of a command line.
pub fn words(line: &str) -> Stage {
    line.split(' ').map(str::to_owned).collect()
}

/// The pipe without any options, which ends in a document.
pub fn defaults() -> [Stage; 4] {
    let lines = [
        "symdetect",
        "wedgecut",
        "tetwedge",
        "rotassemble --to tmesh",
    ];
    lines.map(words)
}

/// A pipe with random options for a body.
pub fn stages(subject: &Subject, seed: u64) -> Vec<Stage> {
    // Apart from the choices that made the solid.
    let mut dice = Dice::new(seed ^ 0x6f70_7469_6f6e_7300);
    let order = subject.symmetry.order();
    let stage = |name: &str| vec![name.to_owned()];

    let mut detect = stage("symdetect");
    let open = matches!(subject.symmetry, Symmetry::AtLeast(_));
    if open || order == 1 && dice.chance(0.9) {
        detect.push("--allow-asymmetric".to_owned());
    }
    let mut cut = stage("wedgecut");
    if dice.chance(0.15) {
        // A body of order 2 may have more about another axis, of which 2 is no divisor.
        let least = if order <= 2 { 1 } else { order };
        let divisors: Vec<usize> = (1..=least).filter(|d| least.is_multiple_of(*d)).collect();
        cut.extend(["--order".to_owned(), dice.pick(&divisors).to_string()]);
    }
    if dice.chance(0.15) {
        cut.extend(["--domain", "rotation"].map(str::to_owned));
        if dice.chance(0.3) {
            cut.extend([
                "--start-angle".to_owned(),
                format!("{:.3}", dice.between(-90.0, 90.0)),
            ]);
        }
    }
    if dice.chance(0.1) {
        cut.extend(["--horizontal-mirror", "off"].map(str::to_owned));
    }
    if dice.chance(0.1) {
        cut.extend(["--hub", "none"].map(str::to_owned));
    }

    let volume: f64 = subject.regions.iter().map(|r| r.volume).sum();
    let mut elements = Vec::new();
    if dice.chance(0.25) {
        let largest = volume / dice.log_between(50.0, 3000.0);
        elements.extend(["--max-volume".to_owned(), format!("{largest:.3e}")]);
    }
    if dice.chance(0.5) {
        cut.extend(elements.clone());
    }
    let mut quality = Vec::new();
    match dice.below(10) {
        0 => quality.push("--no-quality".to_owned()),
        1 => {
            let ratio = dice.between(1.2, 2.0);
            let angle = dice.between(0.0, 14.0);
            quality.extend(["--radius-edge".to_owned(), format!("{ratio:.2}")]);
            quality.extend(["--min-dihedral".to_owned(), format!("{angle:.1}")]);
        }
        2 => {
            let angle = dice.pick(&["off", "130", "165"]);
            quality.extend(["--optimize".to_owned(), angle.to_owned()]);
        }
        _ => {}
    }
    elements.extend(quality);
    let surface = dice.chance(0.75);
    let with_elements = |name| [stage(name), elements.clone()].concat();
    let mut stages = vec![detect, cut];
    if surface {
        stages.push(with_elements("periodic-surf"));
    }
    let mut fill = with_elements("tetwedge");
    if !surface && dice.chance(0.5) {
        fill.push("--keep-surface".to_owned());
    }
    stages.push(fill);
    let mut assemble = stage("rotassemble");
    assemble.extend(["--to", "tmesh"].map(str::to_owned));
    if dice.chance(0.3) {
        assemble.push("--instances".to_owned());
    }
    // Drawn last: the other options of a seed stay what they were.
    if dice.chance(0.5) {
        stages[1].extend(["--seam", "auto"].map(str::to_owned));
    }
    stages.push(assemble);
    stages
}
