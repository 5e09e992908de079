//! `meshqual --check` on documents of another writer, sound ones and broken ones, against a referee that expands them.
//!
//! The writer and the referee follow `SPEC.md` and share nothing with the tools but the crates for checksums, cosines and
//! vectors.

mod defects;
mod part;
mod referee;
mod writer;

use bodies::Gear;
use defects::Defect;
use part::{Part, Walls};
use support::{EXACT_STL, encode, pipe, run};

#[test]
fn the_check_agrees_with_a_referee_on_documents_of_another_writer() {
    let (mut documents, mut sound) = (0, 0);
    for (order, walls, bore, rounds, sourced) in bodies() {
        for defect in Defect::ALL {
            let mut part = Part::new(order, walls, bore, rounds);
            if !sourced {
                part.source = None;
            }
            if !defect.apply(&mut part) {
                continue;
            }
            let expected = referee::judge(&part);
            let outcome = run("meshqual", &["--check"], &writer::bytes(&part));
            let text = String::from_utf8_lossy(&outcome.stdout);
            let what = format!(
                "{order} {walls:?} bore {bore} rounds {rounds} source {sourced} {defect:?}: referee \
                 {expected:?}, meshqual {:?}\n{}\n{text}",
                outcome.code, outcome.stderr
            );
            assert_eq!(outcome.code == 0, expected.is_ok(), "{what}");
            assert_eq!(
                text.contains("all promises hold\n"),
                expected.is_ok() && sourced,
                "{what}"
            );
            documents += 1;
            sound += usize::from(expected.is_ok());
        }
    }
    println!("{documents} documents, {sound} of them sound");
    assert!(documents >= 200, "{documents} documents");
    assert!(
        sound >= 40 && documents - sound >= 100,
        "{sound} of {documents}"
    );
}

/// The first line of a report that says why a check failed.
fn refused(stdout: &[u8], stderr: &str, part: &str) {
    let text = String::from_utf8_lossy(stdout);
    assert!(text.contains("BROKEN") && text.contains(part), "{text}");
    assert!(!text.contains("all promises hold"), "{text}");
    assert!(stderr.contains(part), "{stderr}");
}

#[test]
fn wedges_without_gluing_were_certified() {
    let mut part = Part::new(16, Walls::Seam, 0.0, 2);
    part.source = None;
    part.glues.clear();
    let outcome = run("meshqual", &["--check"], &writer::bytes(&part));
    assert_eq!(outcome.code, 1);
    refused(
        &outcome.stdout,
        &outcome.stderr,
        "coincide without being glued",
    );
}

#[test]
fn a_document_that_places_nothing_was_certified() {
    let mut part = Part::new(16, Walls::Mirrors, 0.5, 1);
    part.instances.clear();
    let outcome = run("meshqual", &["--check"], &writer::bytes(&part));
    assert_eq!(outcome.code, 1);
    refused(&outcome.stdout, &outcome.stderr, "placed nowhere");
}

#[test]
fn a_wedge_read_from_vtk_was_certified_as_the_body() {
    let stl = encode(&Gear::default().build(), EXACT_STL);
    let cut: [&[&str]; 2] = [&["symdetect"], &["wedgecut", "-q", "--to", "vtk"]];
    let wedge = pipe(&cut, &stl).pop().expect("two stages").success();
    let found = run("symdetect", &["--allow-asymmetric"], &wedge);
    assert!(
        found.stderr.contains("one sector of a mesh of"),
        "{}",
        found.stderr
    );
    let rest: [&[&str]; 4] = [
        &["wedgecut", "-q"],
        &["tetwedge", "-q"],
        &["rotassemble", "-q", "--to", "tmesh"],
        &["meshqual", "--check"],
    ];
    let outcome = pipe(&rest, &found.success()).pop().expect("four stages");
    assert_eq!(outcome.code, 1);
    refused(&outcome.stdout, &outcome.stderr, "one sector of a mesh of");
}

/// Orders, walls, inner radii, layers of material, and whether the document says what it was read from.
fn bodies() -> impl Iterator<Item = (u32, Walls, f64, u32, bool)> {
    let orders = [3, 4, 7, 16];
    orders.into_iter().flat_map(|order| {
        [Walls::Mirrors, Walls::Seam]
            .into_iter()
            .flat_map(move |walls| {
                [(0.0, 2), (0.5, 1)]
                    .into_iter()
                    .flat_map(move |(bore, rounds)| {
                        [true, false].map(move |sourced| (order, walls, bore, rounds, sourced))
                    })
            })
    })
}
