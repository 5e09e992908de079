//! Exports torn open at random: repaired rightly, or refused.

mod common;

use bodies::facets::binary_stl;
use bodies::torn::{Torn, torn};
use heal::read;
use interchange::Format::Stl;

/// How reading a torn export ended.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Repaired,
    Refused,
}

/// Reads a torn export; what must not happen is an error.
fn end(torn: &Torn) -> Result<End, String> {
    let imported = match read(&binary_stl(b"", &torn.facets), Stl) {
        Ok(imported) => imported,
        Err(error) => {
            let text = error.to_string();
            return match text.contains("not closed") {
                true => Ok(End::Refused),
                false => Err(text),
            };
        }
    };
    let faults = tmesh::validate(&imported.document);
    if !faults.is_empty() {
        return Err(format!("{faults:?}"));
    }
    let volume: f64 = imported
        .document
        .regions
        .iter()
        .filter_map(|r| r.volume)
        .sum();
    let slack = 2.0 * torn.moved * torn.area + 1e-5 * torn.volume;
    match (volume - torn.volume).abs() <= slack {
        true => Ok(End::Repaired),
        false => Err(format!(
            "volume {volume:e}, not {:e}, slack {slack:.1e}",
            torn.volume
        )),
    }
}

/// Reads many of them: how many were repaired and refused.
fn count(seeds: std::ops::Range<u64>) -> (usize, usize) {
    let (mut repaired, mut refused) = (0, 0);
    for seed in seeds {
        let torn = torn(seed);
        match end(&torn) {
            Ok(End::Repaired) => repaired += 1,
            Ok(End::Refused) => refused += 1,
            Err(text) => panic!("seed {seed}, {}: {text}", torn.name),
        }
    }
    (repaired, refused)
}

#[test]
fn torn_exports_are_repaired_or_refused() {
    let (repaired, refused) = count(0..100);
    assert!(repaired > refused, "{repaired} repaired, {refused} refused");
}

#[test]
#[ignore = "takes a minute: run with --ignored --nocapture for the figures"]
fn five_hundred_torn_exports_are_repaired_or_refused() {
    let (repaired, refused) = count(0..500);
    println!("{repaired} repaired, {refused} refused, none wrongly");
}
