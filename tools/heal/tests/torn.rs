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

#[test]
fn torn_exports_are_repaired_or_refused() {
    let mut ends = Vec::new();
    let only: Option<u64> = std::env::var("SEED").ok().and_then(|s| s.parse().ok());
    for seed in 0..500 {
        if only.is_some_and(|s| s != seed) {
            continue;
        }
        let torn = torn(seed);
        let end = end(&torn);
        if std::env::var_os("TORN").is_some() {
            let text = read(&binary_stl(b"", &torn.facets), Stl)
                .err()
                .map(|e| e.to_string());
            println!(
                "{seed} {end:?} {} moved {:.1e} dropped {} doubled {} junctions {} of {}: {}",
                torn.name,
                torn.moved,
                torn.dropped,
                torn.doubled,
                torn.junctions,
                torn.facets.len(),
                text.unwrap_or_default()
            );
        }
        ends.push((seed, end));
    }
    let wrong: Vec<_> = ends.iter().filter(|e| e.1.is_err()).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
