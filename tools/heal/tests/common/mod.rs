//! Small bodies, and files of them.

#![allow(dead_code)]

pub mod samples;

use heal::{Imported, read};
use interchange::Format;
use std::fmt::Write;

pub type Point = [f64; 3];
pub type Facet = [Point; 3];

/// A fixed sequence of numbers below the argument (Knuth's MMIX generator): failures can be repeated.
pub fn sequence(mut state: u64) -> impl FnMut(usize) -> usize {
    move |n| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % n
    }
}

/// A box with outward triangles.
pub fn cuboid(low: Point, high: Point) -> Vec<Facet> {
    let corner = |i: usize| -> Point {
        std::array::from_fn(|k| if i >> k & 1 == 0 { low[k] } else { high[k] })
    };
    let mut facets = Vec::new();
    for [a, b, c, d] in QUADS {
        facets.push([a, b, c].map(corner));
        facets.push([a, c, d].map(corner));
    }
    facets
}

/// Faces of a box whose corner `i` has the high coordinate on axis `k` where bit `k` is set.
pub const QUADS: [[usize; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

/// The cube `[0, 1]^3` moved by `shift`.
pub fn unit_cube(shift: Point) -> Vec<Facet> {
    cuboid(shift, shift.map(|x| x + 1.0))
}

pub fn reversed(facets: &[Facet]) -> Vec<Facet> {
    facets.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

pub fn binary_stl(header: &[u8], facets: &[Facet]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        bytes.extend([0; 12]);
        for x in facet.as_flattened() {
            bytes.extend((*x as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

pub fn ascii_stl(solids: &[(&str, Vec<Facet>)]) -> Vec<u8> {
    let mut text = String::new();
    for (name, facets) in solids {
        writeln!(text, "solid {name}").unwrap();
        for facet in facets {
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for [x, y, z] in facet {
                writeln!(text, "vertex {x} {y} {z}").unwrap();
            }
            text.push_str("endloop\nendfacet\n");
        }
        writeln!(text, "endsolid {name}").unwrap();
    }
    text.into_bytes()
}

/// Reads a file that must be sound, and checks the document's invariants.
pub fn good(bytes: &[u8], format: Format) -> Imported {
    let imported = read(bytes, format).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(tmesh::validate(&imported.document), []);
    imported
}

/// The message of a file that must be refused.
pub fn refused(bytes: &[u8], format: Format) -> String {
    match read(bytes, format) {
        Ok(_) => panic!("was read"),
        Err(e) => e.to_string(),
    }
}

/// Ids, names and volumes of regions; volumes rounded to 1e-9.
pub fn regions(imported: &Imported) -> Vec<(u32, &str, f64)> {
    let regions = &imported.document.regions;
    regions
        .iter()
        .map(|r| (r.id, r.name.as_str(), round(r.volume.unwrap())))
        .collect()
}

/// Ids, names and areas of markers; areas rounded to 1e-9.
pub fn markers(imported: &Imported) -> Vec<(u32, &str, f64)> {
    let markers = &imported.document.markers;
    markers
        .iter()
        .map(|m| (m.id, m.name.as_str(), round(m.area.unwrap())))
        .collect()
}

pub fn round(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
