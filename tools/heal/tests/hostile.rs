//! Damaged files: an error or a document, but no panic, no hang, and no memory beyond the file's.

mod common;

use bodies::Dice;
use bodies::files::damaged;
use common::samples::samples;
use heal::read;
use interchange::Format;

fn survives(bytes: &[u8], format: Format) {
    if let Ok(imported) = read(bytes, format) {
        assert_eq!(tmesh::validate(&imported.document), []);
    }
    for end in [bytes.len().min(50), bytes.len()] {
        interchange::sniff(&bytes[..end], None);
    }
}

#[test]
fn every_prefix_is_survived() {
    for (format, bytes) in samples() {
        for end in 0..bytes.len() {
            survives(&bytes[..end], format);
        }
    }
}

#[test]
fn random_damage_is_survived() {
    let mut dice = Dice::new(1);
    let words: [&[u8]; 14] = [
        b"-1",
        b"0",
        b"1e308",
        b"-1e-320",
        b"nan",
        b"4294967296",
        b"9223372036854775807",
        b"3",
        b" ",
        b"\n",
        b"f",
        b"\xff",
        b"0.5",
        b"#",
    ];
    for (format, bytes) in samples() {
        for _ in 0..2000 {
            survives(&damaged(&bytes, &words, &mut dice), format);
        }
    }
}

#[test]
fn bytes_of_another_format_are_refused() {
    for (_, bytes) in samples() {
        for format in Format::ALL {
            let _ = read(&bytes, format);
            let _ = read(b"", format);
        }
    }
}
