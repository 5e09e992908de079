//! What has to hold of every reader.

use crate::limited;
use heal::read;
use interchange::{Format, sniff, write_document};
use std::collections::BTreeMap;
use tmesh::Document;

/// Reads bytes as a format: an error, or a valid document that survives a round trip.
pub fn check_reader(bytes: &[u8], format: Format) {
    limited(bytes.len(), || {
        if let Ok(imported) = read(bytes, format) {
            assert_eq!(tmesh::validate(&imported.document), []);
            check_round_trip(&imported.document);
            check_second_reading(&imported.document, format);
        }
    });
    limited(bytes.len(), || {
        let _ = interchange::parse_points(bytes, format);
    });
    limited(bytes.len(), || sniff(bytes, None));
}

/// Writes and reads a document: it has to be the same.
pub fn check_round_trip(document: &Document) {
    let mut bytes = Vec::new();
    tmesh::write(document, &mut bytes).expect("a vector takes all bytes");
    let again = tmesh::read(bytes.as_slice()).expect("it was valid");
    assert_eq!(&again, document);
}

/// A mesh written in the format it came in is read as it was: the same tetrahedra in the same regions.
/// Their order, ids of regions and points that nothing names may differ.
fn check_second_reading(document: &Document, format: Format) {
    let is_mesh = matches!(format, Format::Vtk | Format::Vtu | Format::Msh);
    if !is_mesh || document.templates[0].tets.is_empty() {
        return;
    }
    let mut bytes = Vec::new();
    write_document(document, format, &mut bytes).expect("a vector takes all bytes");
    let again = read(&bytes, format).expect("it was written here").document;
    let [before, after] = [document, &again].map(tets);
    assert_eq!(before.len(), after.len());
    let mut regions = BTreeMap::new();
    for (a, b) in before.iter().zip(&after) {
        assert_eq!(a.0, b.0);
        assert_eq!(*regions.entry(a.1).or_insert(b.1), b.1);
    }
}

/// Corners as they are in memory, and region, of every tetrahedron, sorted by them.
fn tets(document: &Document) -> Vec<([[u64; 3]; 4], u32)> {
    let template = &document.templates[0];
    // A zero may lose its sign.
    let bits = |x: f64| (x + 0.0).to_bits();
    let corner = |v: u32| template.vertices[v as usize].to_array().map(bits);
    let tets = template.tets.iter();
    let mut tets: Vec<_> = tets.map(|t| (t.vertices.map(corner), t.region)).collect();
    tets.sort_unstable();
    tets
}
