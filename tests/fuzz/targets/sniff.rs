#![no_main]

use heal::read;
use interchange::sniff;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // What the content shows is what an input without an option is read as.
    fuzz::limited(bytes.len(), || {
        if let Some(format) = sniff(bytes, None)
            && let Ok(imported) = read(bytes, format)
        {
            assert_eq!(tmesh::validate(&imported.document), []);
        }
    });
});
