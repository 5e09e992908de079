//! Small bodies, and files of them.

#![allow(dead_code)]

pub mod samples;

use heal::{Imported, read};
use interchange::Format;

/// Reads a file that must be sound, and checks the document's invariants.
pub fn good(bytes: &[u8], format: Format) -> Imported {
    let imported = read(bytes, format).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(tmesh::validate(&imported.document), []);
    imported
}

/// The message of a file that must be refused.
pub fn refused(bytes: &[u8], format: Format) -> String {
    match read(bytes, format) {
        Ok(_) => panic!("was read"),
        Err(e) => e.to_string(),
    }
}

/// Ids, names and volumes of regions; volumes rounded to 1e-9.
pub fn regions(imported: &Imported) -> Vec<(u32, &str, f64)> {
    let regions = &imported.document.regions;
    regions
        .iter()
        .map(|r| (r.id, r.name.as_str(), round(r.volume.unwrap())))
        .collect()
}

/// Ids, names and areas of markers; areas rounded to 1e-9.
pub fn markers(imported: &Imported) -> Vec<(u32, &str, f64)> {
    let markers = &imported.document.markers;
    markers
        .iter()
        .map(|m| (m.id, m.name.as_str(), round(m.area.unwrap())))
        .collect()
}

pub fn round(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
