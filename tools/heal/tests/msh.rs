//! Gmsh's files: those written here, those of other programs, and damaged ones.

mod common;

use bodies::Dice;
use bodies::files::damaged;
use glam::DVec3;
use heal::read;
use interchange::{Format, Plain, WriteOptions, sniff};
use std::collections::BTreeMap;
use tmesh::{Document, OUTSIDE};

/// Two tetrahedra of different regions, with surface and interface, part of it without a marker.
fn two_tets() -> Document {
    common::two_tets(
        DVec3::new(0.1, 0.2, -0.7),
        [
            ([0, 1, 3], 2, OUTSIDE, 3),
            ([1, 2, 3], 2, OUTSIDE, 3),
            ([0, 3, 2], 2, OUTSIDE, 3),
            ([0, 2, 1], 5, 7, 3),
            ([0, 4, 1], 2, OUTSIDE, 7),
            ([1, 4, 2], OUTSIDE, OUTSIDE, 7),
            ([2, 4, 0], 2, OUTSIDE, 7),
        ],
        [([0, 1, 2, 3], 3), ([0, 2, 1, 4], 7)],
        [
            [(3, "silicon"), (7, "copper alloy")],
            [(2, "outer"), (5, "bond")],
        ],
    )
}

fn written(document: &Document, format: Format, ascii: bool) -> Vec<u8> {
    let options = WriteOptions {
        ascii,
        ..WriteOptions::default()
    };
    let mut bytes = Vec::new();
    interchange::write(&Plain::new(document).unwrap(), format, &options, &mut bytes).unwrap();
    bytes
}

fn modes() -> [(Format, bool); 4] {
    [
        (Format::Msh, false),
        (Format::Msh, true),
        (Format::Msh2, false),
        (Format::Msh2, true),
    ]
}

/// Triangles in an order and rotation of their own, with sides and name.
fn surface(document: &Document) -> Vec<([u32; 3], u32, u32, String)> {
    let names: BTreeMap<u32, &str> = document
        .markers
        .iter()
        .map(|m| (m.id, m.name.as_str()))
        .collect();
    let triangles = document.templates[0].triangles.iter();
    let mut list: Vec<_> = triangles
        .map(|t| {
            let mut v = t.vertices;
            let least = (0..3).min_by_key(|&i| v[i]).unwrap();
            v.rotate_left(least);
            let name = names.get(&t.marker).copied().unwrap_or_default();
            // What had no marker may get one that has no name of its own.
            let name = if name.starts_with("marker") { "" } else { name };
            (v, t.front, t.back, name.to_owned())
        })
        .collect();
    list.sort();
    list
}

#[test]
fn meshes_come_back_in_all_forms() {
    let document = two_tets();
    assert_eq!(tmesh::validate(&document), []);
    for (format, ascii) in modes() {
        let bytes = written(&document, format, ascii);
        assert_eq!(
            sniff(&bytes[..60.min(bytes.len())], None),
            Some(Format::Msh)
        );
        let back = read(&bytes, Format::Msh).unwrap();
        assert_eq!(back.notices, [""; 0]);
        let back = back.document;
        assert_eq!(tmesh::validate(&back), []);
        let (a, b) = (&back.templates[0], &document.templates[0]);
        assert_eq!((&a.vertices, &a.tets), (&b.vertices, &b.tets));
        assert_eq!(back.regions, document.regions);
        assert_eq!(surface(&back), surface(&document));
    }
}

#[test]
fn surfaces_come_back_with_their_names() {
    let mut document = two_tets();
    document.templates[0].tets.clear();
    for t in &mut document.templates[0].triangles {
        t.marker = t.marker.min(9);
    }
    for (format, ascii) in modes() {
        let bytes = written(&document, format, ascii);
        let back = read(&bytes, Format::Msh).unwrap().document;
        assert_eq!(tmesh::validate(&back), []);
        assert_eq!(back.regions.len(), 2);
        let total: f64 = back.regions.iter().filter_map(|r| r.volume).sum();
        assert!((total - 1.7 / 6.0).abs() < 1e-15);
        let names: Vec<&str> = back.markers.iter().map(|m| m.name.as_str()).collect();
        assert_eq!(names, ["outer", "bond", "marker9"]);
        let bond = &back.markers[1];
        assert!((bond.area.unwrap() - 0.5).abs() < 1e-15);
    }
}

/// As another program writes it: numbers with gaps, entities, a void, quadrilaterals, second order.
const FOREIGN: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
    $PhysicalNames\n2\n3 40 \"body\"\n2 9 \"skin\"\n$EndPhysicalNames\n\
    $Entities\n0 0 2 1\n\
    4 0 0 0 1 1 1 1 9 0\n6 0 0 0 1 1 1 0 0\n\
    3 0 0 0 1 1 1 1 40 2 4 -6\n$EndEntities\n\
    $Nodes\n2 5 10 90\n2 4 0 4\n10\n20\n30\n90\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n\
    2 6 1 1\n50\n0.5 0 0 7 7\n$EndNodes\n\
    $Interpolation\n$anything\n$EndInterpolation\n\
    $Elements\n2 4 1 4\n2 4 2 3\n1 10 30 20\n2 10 20 90\n3 20 30 90\n2 6 2 1\n4 30 10 90\n\
    $EndElements\n";

#[test]
fn names_of_volumes_are_found_by_the_surfaces_around_them() {
    let back = read(FOREIGN.as_bytes(), Format::Msh).unwrap().document;
    assert_eq!(back.regions.len(), 1);
    assert_eq!(back.regions[0].name, "body");
    let names: Vec<&str> = back.markers.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["skin", "surface10"]);
    assert_eq!(back.templates[0].vertices.len(), 4);
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    for (from, to, sentence) in [
        (
            "4.1 0 8",
            "4 0 8",
            "version '4' is not read; versions 2.2 and 4.1 are",
        ),
        (
            "4.1 0 8",
            "4.1 0 4",
            "numbers of 4 bytes; those of 8 are read",
        ),
        (
            "1 10 30 20",
            "1 10 31 20",
            "an element names node 31, which is not there",
        ),
        ("2 4 2 3", "2 4 5 3", "5 as the number of elements"),
        (
            "0.5 0 0 7",
            "0.5 nan 0 7",
            "the coordinate 'nan' is not finite",
        ),
        (
            "$Elements\n",
            "$Element\n",
            "section 'Element' does not end",
        ),
        ("10\n20", "20\n20", "node 20 comes twice"),
        ("4 30 10 90\n", "", "integer"),
    ] {
        assert!(FOREIGN.contains(from), "{from}");
        let bytes = FOREIGN.replacen(from, to, 1);
        let error = match read(bytes.as_bytes(), Format::Msh) {
            Ok(_) => panic!("{to} was read"),
            Err(error) => error.to_string(),
        };
        let expected =
            error.contains(sentence) || sentence == "integer" && error.contains("expected");
        assert!(expected || error.contains("element type"), "{error}");
    }
}

fn samples() -> Vec<Vec<u8>> {
    let document = two_tets();
    let mut surface = two_tets();
    surface.templates[0].tets.clear();
    let mut all = vec![FOREIGN.as_bytes().to_vec()];
    for (format, ascii) in modes() {
        all.push(written(&document, format, ascii));
        all.push(written(&surface, format, ascii));
    }
    all
}

fn survives(bytes: &[u8]) {
    if let Ok(imported) = read(bytes, Format::Msh) {
        assert_eq!(tmesh::validate(&imported.document), []);
    }
}

#[test]
fn every_prefix_is_survived() {
    for bytes in samples() {
        (0..bytes.len()).for_each(|end| survives(&bytes[..end]));
    }
}

#[test]
fn random_damage_is_survived() {
    let mut dice = Dice::new(7);
    let words: [&[u8]; 9] = [
        b"-1",
        b"0",
        b"1e308",
        b"-1e-320",
        b"nan",
        b"4294967296",
        b"9223372036854775807",
        b"$",
        b"\n",
    ];
    for bytes in samples() {
        for _ in 0..2000 {
            survives(&damaged(&bytes, &words, &mut dice));
        }
    }
}

#[test]
fn compressed_arrays_come_back_and_damage_to_them_is_survived() {
    let document = two_tets();
    let options = WriteOptions {
        boundary: true,
        compress: true,
        ..WriteOptions::default()
    };
    let mut bytes = Vec::new();
    let plain = Plain::new(&document).unwrap();
    interchange::write(&plain, Format::Vtu, &options, &mut bytes).unwrap();
    let back = read(&bytes, Format::Vtu).unwrap().document;
    assert_eq!(back.templates[0].tets, document.templates[0].tets);
    assert_eq!(back.templates[0].vertices, document.templates[0].vertices);
    for end in 0..bytes.len() {
        let _ = read(&bytes[..end], Format::Vtu);
    }
    let mark = b"encoding=\"raw\">\n_";
    let begin = bytes.windows(mark.len()).position(|w| w == mark).unwrap() + mark.len();
    for at in begin..bytes.len() {
        for bit in 0..8 {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            if let Ok(imported) = read(&damaged, Format::Vtu) {
                assert_eq!(tmesh::validate(&imported.document), []);
            }
        }
    }
}
