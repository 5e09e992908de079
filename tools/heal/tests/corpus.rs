//! Every input that fuzzing once failed on, and others it found worth keeping: an error, or a document
//! that is valid and survives a round trip. The files are in `tests/fuzz/corpus`, a folder per target.

use heal::read;
use interchange::{Format, sniff};
use std::path::Path;

#[test]
fn kept_inputs_are_survived() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fuzz/corpus");
    let mut files = 0;
    for folder in std::fs::read_dir(corpus).expect("the corpus") {
        let folder = folder.expect("a folder").path();
        let target = folder.file_name().and_then(|n| n.to_str()).expect("a name");
        for file in std::fs::read_dir(&folder).expect("a folder of the corpus") {
            let bytes = std::fs::read(file.expect("a file").path()).expect("it can be read");
            files += 1;
            match Format::from_name(target) {
                Some(format) => survives(&bytes, format),
                // What the content shows is what an input without an option is read as.
                None => sniff(&bytes, None)
                    .into_iter()
                    .for_each(|format| survives(&bytes, format)),
            }
        }
    }
    assert!(files > 0);
}

fn survives(bytes: &[u8], format: Format) {
    let Ok(imported) = read(bytes, format) else {
        return;
    };
    assert_eq!(tmesh::validate(&imported.document), []);
    let mut again = Vec::new();
    tmesh::write(&imported.document, &mut again).expect("a vector takes all bytes");
    assert_eq!(
        tmesh::read(again.as_slice()).expect("it is valid"),
        imported.document
    );
}
