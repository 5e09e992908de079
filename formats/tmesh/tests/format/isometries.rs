//! Isometries as hostile documents may have them: never a panic, whatever is multiplied.

use crate::samples::{bytes, column, pyramid};
use tmesh::{DecodeError, Document, Isometry, MAX_TURN_DENOMINATOR, Violation, read};

fn first_violation(document: &Document) -> Violation {
    match read(bytes(document).as_slice()) {
        Err(DecodeError::Invalid { first, .. }) => first,
        other => panic!("{other:?}"),
    }
}

#[test]
fn turns_without_a_common_denominator_are_refused() {
    // Coprime denominators, each allowed, whose products are not.
    let mut document = pyramid();
    let big = MAX_TURN_DENOMINATOR;
    document.instances[1].isometry = Isometry::rotation(1, big);
    document.instances[2].isometry = Isometry::rotation(1, big - 1);
    let expected = u64::from(big) * u64::from(big - 1);
    let found = first_violation(&document);
    assert_eq!(
        found,
        Violation::TurnsTooFine {
            denominator: expected
        }
    );

    // One instance alone, the denominators in its walls.
    let mut document = column();
    document.instances.truncate(1);
    for (template, n) in [(0, 65_521), (1, 65_519)] {
        let seam = &mut document.templates[template].gluings[0];
        seam.step = Isometry::rotation(1, n);
    }
    assert!(matches!(
        first_violation(&document),
        Violation::TurnsTooFine { .. }
    ));
}

#[test]
fn the_largest_denominator_works() {
    let mut document = pyramid();
    document.templates[0].gluings.clear();
    let step = Isometry::reflection(1, MAX_TURN_DENOMINATOR);
    let other = Isometry::rotation(3, 1024);
    document.instances[1].isometry = step;
    document.instances[2].isometry = other;
    let document = read(bytes(&document).as_slice()).expect("valid");
    let mut product = Isometry::IDENTITY;
    for i in 0..1000 {
        let factor = document.instances[1 + i % 2].isometry;
        product = product
            .compose(factor)
            .compose(factor.inverse())
            .compose(factor);
        assert!(product.n() <= MAX_TURN_DENOMINATOR);
    }
}

#[test]
fn turns_out_of_range_are_refused_where_they_stand() {
    let written = bytes(&pyramid());
    let first = read(written.as_slice()).expect("valid").instances[0];
    assert_eq!(first.isometry, Isometry::IDENTITY);
    // k = n, n = 0, n too large, unknown flag.
    for (k, n, flags) in [
        (1, 1, 0),
        (0, 0, 0),
        (1, MAX_TURN_DENOMINATOR + 1, 0),
        (0, 1, 4),
    ] {
        let mut raw = Vec::new();
        let mut chunks = tmesh::ChunkWriter::begin(&mut raw).expect("memory");
        chunks
            .array(*b"INST", 0, &[0_u32, k, n, flags, 0, 0])
            .expect("memory");
        chunks.finish().expect("memory");
        let text = read(raw.as_slice()).expect_err("no isometry").to_string();
        let expected =
            format!("chunk 'INST' at byte 16: {k}/{n} with flags {flags} is no isometry");
        assert_eq!(text, expected);
    }
}
