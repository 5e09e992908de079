//! Frozen bytes. A change that makes these tests fail changes the format: it needs a new version
//! number and a reader for the old one, not new golden files.

use crate::samples::{bytes, column, pyramid, sized};
use tmesh::{Document, read, validate};

const PYRAMID: &[u8] = include_bytes!("../golden/pyramid.tmesh");
const COLUMN: &[u8] = include_bytes!("../golden/column.tmesh");
const SIZED: &[u8] = include_bytes!("../golden/sized.tmesh");
const SPEC: &str = include_str!("../../SPEC.md");

fn check(document: &Document, golden: &[u8]) {
    assert_eq!(validate(document), []);
    let written = bytes(document);
    let differs = written.iter().zip(golden).position(|(a, b)| a != b);
    assert_eq!(differs, None, "first byte that differs");
    assert_eq!(written.len(), golden.len());
    assert_eq!(&read(golden).expect("golden bytes are valid"), document);
}

#[test]
fn mirror_walls_and_tetrahedra_are_written_and_read_as_ever() {
    check(&pyramid(), PYRAMID);
}

#[test]
fn seams_hubs_and_all_metadata_are_written_and_read_as_ever() {
    check(&column(), COLUMN);
}

#[test]
fn lengths_by_place_are_written_and_read_as_ever() {
    check(&sized(), SIZED);
}

/// The annotated dump of section 11: `offset  hex bytes  ; meaning`.
#[test]
fn the_hex_dump_of_the_specification_is_the_golden_file() {
    let mut dumped = Vec::new();
    let section = SPEC
        .split("\n## 11")
        .nth(1)
        .expect("SPEC.md has a section 11");
    let block = section.split("```").nth(1).expect("section 11 has a dump");
    for line in block.lines().filter(|l| l.contains("  ")) {
        let (offset, rest) = line.split_once("  ").expect("an offset");
        let offset = usize::from_str_radix(offset, 16).expect("a hexadecimal offset");
        assert_eq!(offset, dumped.len(), "{line}");
        let hex = rest.split(';').next().unwrap_or_default();
        dumped.extend(
            hex.split_whitespace()
                .map(|h| u8::from_str_radix(h, 16).unwrap_or_else(|_| panic!("{h} in {line}"))),
        );
    }
    assert!(
        dumped == PYRAMID,
        "{} bytes are dumped, {} stored",
        dumped.len(),
        PYRAMID.len()
    );
}

/// Section 4 names every chunk, and no other.
#[test]
fn the_chunk_table_of_the_specification_is_complete() {
    let (_, chunks) = tmesh::read_with_chunks(COLUMN).expect("valid");
    let (_, more) = tmesh::read_with_chunks(SIZED).expect("valid");
    let table = SPEC
        .split("\n## 4")
        .nth(1)
        .and_then(|s| s.split("\n## 5").next());
    let table = table.expect("SPEC.md has sections 4 and 5");
    let mut used: Vec<_> = chunks.iter().chain(&more).map(|c| c.name()).collect();
    used.sort();
    used.dedup();
    let mut listed: Vec<_> = table
        .lines()
        .filter_map(|l| l.strip_prefix("| `")?.split_once('`'))
        .map(|(id, _)| id.to_owned())
        .filter(|id| id != "END ")
        .collect();
    listed.sort();
    assert_eq!(used, listed);
}
