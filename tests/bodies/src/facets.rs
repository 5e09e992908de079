//! Triangle soups, and files of them.

use std::fmt::Write;

/// A point of a soup.
pub type Point = [f64; 3];
/// A triangle of a soup.
pub type Facet = [Point; 3];

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

/// The facets seen from the other side.
pub fn reversed(facets: &[Facet]) -> Vec<Facet> {
    facets.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

/// A binary STL file; the header is filled up to its 80 bytes.
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

/// An ASCII STL file of several solids.
pub fn ascii_stl(solids: &[(&str, Vec<Facet>)]) -> Vec<u8> {
    let mut text = String::new();
    for (name, facets) in solids {
        writeln!(text, "solid {name}").expect("a string takes all");
        for facet in facets {
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for [x, y, z] in facet {
                writeln!(text, "vertex {x} {y} {z}").expect("a string takes all");
            }
            text.push_str("endloop\nendfacet\n");
        }
        writeln!(text, "endsolid {name}").expect("a string takes all");
    }
    text.into_bytes()
}
