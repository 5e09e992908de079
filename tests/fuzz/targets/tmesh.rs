#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    fuzz::limited(bytes.len(), || {
        check(bytes);
        let repaired = fuzz::repaired(bytes);
        if repaired != bytes {
            check(&repaired);
        }
    });
});

/// An error, or a valid document that survives a round trip.
fn check(bytes: &[u8]) {
    if let Ok(document) = tmesh::read(bytes) {
        assert_eq!(tmesh::validate(&document), []);
        fuzz::check_round_trip(&document);
    }
}
