//! Nastran bulk data: files written here, those of other programs, and damaged ones.

mod common;

use bodies::Dice;
use bodies::files::damaged;
use common::*;
use glam::DVec3;
use interchange::Format::Bdf;
use interchange::{Plain, WriteOptions, second_order, sniff};
use std::path::Path;
use tmesh::{Document, OUTSIDE};

/// Two tetrahedra of different regions; a marker has the number of a region.
fn two_tets() -> Document {
    common::two_tets(
        DVec3::new(0.1, 1.0 / 3.0, -7e-5 / 3.0),
        [
            ([0, 1, 3], 2, OUTSIDE, 3),
            ([1, 2, 3], 2, OUTSIDE, 3),
            ([0, 3, 2], 2, OUTSIDE, 3),
            ([0, 2, 1], 3, 7, 3),
            ([0, 4, 1], 2, OUTSIDE, 7),
            ([1, 4, 2], 2, OUTSIDE, 7),
            ([2, 4, 0], 2, OUTSIDE, 7),
        ],
        [([0, 1, 2, 3], 3), ([0, 2, 1, 4], 7)],
        [
            [(3, "silicon"), (7, "copper alloy")],
            [(2, "outer"), (3, "bond")],
        ],
    )
}

fn written(document: &Document) -> Vec<u8> {
    let mut bytes = Vec::new();
    interchange::write_document(document, Bdf, &mut bytes).unwrap();
    bytes
}

fn names(document: &Document) -> [Vec<(u32, &str)>; 2] {
    let regions = document.regions.iter();
    let markers = document.markers.iter();
    [
        regions.map(|r| (r.id, r.name.as_str())).collect(),
        markers.map(|m| (m.id, m.name.as_str())).collect(),
    ]
}

#[test]
fn meshes_come_back_with_regions_and_names() {
    let document = two_tets();
    let bytes = written(&document);
    assert_eq!(sniff(&bytes[..bytes.len().min(300)], None), Some(Bdf));
    let back = good(&bytes, Bdf);
    assert_eq!(back.notices, [""; 0]);
    let (a, b) = (&back.document.templates[0], &document.templates[0]);
    assert_eq!(a.tets, b.tets);
    for (p, q) in a.vertices.iter().zip(&b.vertices) {
        assert!((*p - *q).abs().max_element() < 1e-13, "{p} {q}");
    }
    let [regions, markers] = names(&back.document);
    assert_eq!(regions, [(3, "silicon"), (7, "copper alloy")]);
    // A property is either of a solid or of a shell.
    assert_eq!(markers, [(2, "outer"), (8, "bond")]);
    assert_eq!(a.triangles.len(), b.triangles.len());
    let bond = a.triangles.iter().find(|t| t.marker == 8).unwrap();
    assert_eq!((bond.front, bond.back), (7, 3));
}

#[test]
fn surfaces_of_touching_regions_come_back() {
    let mut document = two_tets();
    document.templates[0].tets.clear();
    let back = good(&written(&document), Bdf).document;
    assert_eq!(back.regions.len(), 2);
    let [_, markers] = names(&back);
    assert_eq!(markers, [(2, "outer"), (3, "bond")]);
}

#[test]
fn second_order_elements_are_written_whole_and_read_by_their_corners() {
    let (document, middles) = second_order(two_tets()).unwrap();
    let plain = Plain::of_order(&document, Some(&middles)).unwrap();
    let mut bytes = Vec::new();
    interchange::write(&plain, Bdf, &WriteOptions::default(), &mut bytes).unwrap();
    let text = std::str::from_utf8(&bytes).unwrap();
    assert!(text.contains("CTRIA6"));
    let continued = text.lines().filter(|l| l.starts_with("+ ")).count();
    // Two tetrahedra, seven triangles: the one with ten points and the one with six go beyond a line.
    assert_eq!(continued, 2);
    assert!(text.lines().all(|l| l.len() <= 72));
    let back = good(&bytes, Bdf);
    assert_eq!(
        back.notices,
        ["9 elements of second order are read by their corners"]
    );
    let template = &back.document.templates[0];
    assert_eq!((template.vertices.len(), template.tets.len()), (5, 2));
}

/// The same tetrahedron in small, large and free fields, with executive control, tabs, exponents without
/// a letter, ids with gaps, elements before points, cards of no use here.
const FOREIGN: &str = "SOL 101\n\
    TITLE = GRID is a word\n\
    CEND\n\
    $ PSOLID 5 steel\n\
    BEGIN BULK\n\
    PARAM,POST,-1\n\
    CTETRA  90      5       10      20      30      40\n\
    MAT1    1       2.1+11          .3\n\
    GRID    10              0.      0.      0.\n\
    GRID*                 20                             1.0             0.0\n\
    *                    0.0\n\
    grid,30,,0.,1.+0,0.,,,,+A\n\
    +A,\n\
    GRID\t40\t\t0.\t.0\t1.-0\n\
    FORCE   1       10      0       1.0\n\
    ENDDATA\n\
    GRID    10              5.      0.      0.\n";

#[test]
fn all_forms_of_fields_are_read() {
    for text in [
        FOREIGN.to_owned(),
        FOREIGN.replace('\n', "\r\n"),
        FOREIGN[FOREIGN.find("PARAM").unwrap()..].to_owned(),
        FOREIGN.replace("40\n", "40      $ a remark\n"),
        // Ten nodes, of which the last ones are on a continuation line.
        FOREIGN.replace(
            "30      40\n",
            "30      40      10      20\n+       30      10      20      40\n",
        ),
        FOREIGN.replace(
            "CTETRA  90      5       10      20      30      40\n",
            "CTETRA,90,5,10,20,30,40\n",
        ),
    ] {
        assert_eq!(sniff(text.as_bytes(), None), Some(Bdf), "{text}");
        let back = good(text.as_bytes(), Bdf).document;
        let template = &back.templates[0];
        let expected = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        assert_eq!(template.vertices, expected, "{text}");
        assert_eq!(template.tets[0].vertices, [0, 1, 2, 3]);
        assert_eq!(back.regions[0].id, 5);
    }
    assert_eq!(
        good(FOREIGN.as_bytes(), Bdf).document.regions[0].name,
        "steel"
    );
    assert_eq!(sniff(b"", Some(Path::new("a.NAS"))), Some(Bdf));
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    let fault = |from: &str, to: &str| {
        assert!(FOREIGN.contains(from), "{from}");
        refused(FOREIGN.replacen(from, to, 1).as_bytes(), Bdf)
    };
    for (from, to, sentence) in [
        (
            "30      40\n",
            "30      41\n",
            "bdf: line 7: an element names GRID 41, which is not there",
        ),
        (
            "30      40\n",
            "30\n",
            "bdf: line 7: CTETRA: a grid point expected, found ''",
        ),
        (
            "CTETRA  90",
            "CHEXA   90",
            "bdf: line 7: CHEXA: of solid elements only tetrahedra are read",
        ),
        (
            "10              0.",
            "10      3       0.",
            "bdf: line 9: GRID 10 is in the coordinate system 3; points of the basic one are read",
        ),
        (
            "1.0             0.0\n",
            "x.0             0.0\n",
            "bdf: line 10: GRID 20: the coordinate 'x.0' is no finite number",
        ),
        ("grid,30", "grid,10", "bdf: line 12: GRID 10 comes twice"),
        (
            "grid,30",
            "grid,-3",
            "bdf: line 12: GRID: the number of a grid point expected, found '-3'",
        ),
        (
            "CTETRA  90      5       10      20",
            "CTETRA  90      5       10      10",
            "bdf: cell 0 of type 10 names a point twice",
        ),
    ] {
        assert_eq!(fault(from, to), sentence);
    }
    assert_eq!(
        refused(b"BEGIN BULK\nENDDATA\n", Bdf),
        "it has no triangles"
    );
}

#[test]
fn damage_is_survived() {
    let mut surface = two_tets();
    surface.templates[0].tets.clear();
    let mut dice = Dice::new(11);
    let words: [&[u8]; 6] = [b"GRID", b"CTETRA", b"nan", b",", b"\n+", b"99999999999"];
    for bytes in [
        FOREIGN.as_bytes().to_vec(),
        written(&two_tets()),
        written(&surface),
    ] {
        for end in 0..bytes.len() {
            let _ = heal::read(&bytes[..end], Bdf);
        }
        for _ in 0..2000 {
            if let Ok(imported) = heal::read(&damaged(&bytes, &words, &mut dice), Bdf) {
                assert_eq!(tmesh::validate(&imported.document), []);
            }
        }
    }
}
