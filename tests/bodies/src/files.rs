//! A small file or two of the foreign formats that can be read, with most of what each format has, and damage
//! to them.

use crate::Dice;
use crate::facets::{ascii_stl, binary_stl, cuboid, unit_cube};

/// The files, each with the name of its format. One of them is not sound.
pub fn samples() -> Vec<(&'static str, Vec<u8>)> {
    let cube = unit_cube([0.0; 3]);
    let inner = cuboid([0.25; 3], [0.75; 3]);
    let both = [cube.clone(), inner].concat();
    let two = [("a", cube.clone()), ("b", unit_cube([0.0, 0.0, 1.0]))];
    let obj =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng a\nf 1 3 2\nf 1/1/1 2 4\ng b\nf 2 3 4\nf 1 4 3\n";
    let off = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n\
               property double z\nelement face 4\nproperty list uchar int vertex_indices\n\
               end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    let mut binary_ply = ply[..ply.find("0 0 0").expect("it has points")]
        .replace("ascii", "binary_little_endian")
        .into_bytes();
    for p in [
        [0.0_f64, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ] {
        binary_ply.extend(p.iter().flat_map(|x| x.to_le_bytes()));
    }
    for t in [[0_i32, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] {
        binary_ply.push(3);
        binary_ply.extend(t.iter().flat_map(|v| v.to_le_bytes()));
    }
    let poly = "8 3 0 1\n1 0 0 0 1\n2 2 0 0\n3 0 2 0\n4 0 0 2\n5 0.2 0.2 0\n6 0.6 0.2 0\n7 0.2 0.6 0\n\
                8 1 0 0\n4 1\n2 1 5\n3 1 3 2\n3 5 6 7\n1 0.3 0.3 0\n1 0\n4 1 8 2 4\n1\n3 2 3 4\n1\n\
                3 1 4 3\n1\n1 9 9 9\n1\n1 0.1 0.1 0.1 2 0.5\n";
    let smesh =
        "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4\n3 0 2 1 5\n3 0 1 3\n3 1 2 3\n3 0 3 2\n0\n0\n";
    // A box in a box: a hole, two regions with names and sizes, facets of one and of several polygons.
    let nested = "16 3 1 1\n1 0 0 0 4 5\n2 3 0 0 4 5\n3 3 3 0 4 5\n4 0 3 0 4 5\n5 0 0 3 4 5\n6 3 0 3 4 5\n\
                  7 3 3 3 4 5\n8 0 3 3 4 5\n9 1 1 1 0 0\n10 2 1 1 0 0\n11 2 2 1 0 0\n12 1 2 1 0 0\n\
                  13 1 1 2 0 0\n14 2 1 2 0 0\n15 2 2 2 0 0\n16 1 2 2 0 0\n12 1\n1 0 7\n4 1 2 3 4\n\
                  1 0 7\n4 5 6 7 8\n1\n4 1 2 6 5\n1\n4 2 3 7 6\n1\n4 3 4 8 7\n1\n4 4 1 5 8\n\
                  1\n4 9 10 11 12\n1\n4 13 14 15 16\n1\n4 9 10 14 13\n1\n4 10 11 15 14\n\
                  1\n4 11 12 16 15\n1\n4 12 9 13 16\n1\n1 1.5 1.5 1.5\n1\n1 0.5 0.5 0.5 3 0.1\n";
    let tets = "# vtk DataFile Version 4.2\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n\
                0 0 0 1 0 0 0 1 0\n0 0 1 0 0 -1\nCELLS 2 10\n4 0 1 2 3\n4 0 2 1 4\nCELL_TYPES 2\n\
                10 10\nCELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n3 4\n";
    vec![
        ("vtk", tets.into()),
        ("stl", binary_stl(b"", &both)),
        ("stl", ascii_stl(&two)),
        ("obj", obj.into()),
        ("off", off.into()),
        ("ply", ply.into()),
        ("ply", binary_ply),
        ("poly", poly.into()),
        ("poly", nested.into()),
        ("smesh", smesh.into()),
    ]
}

/// The bytes with one to four damages: a byte or a bit changed, a word put in, a part repeated elsewhere.
pub fn damaged(bytes: &[u8], words: &[&[u8]], dice: &mut Dice) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    for _ in 0..dice.integer(1, 4) {
        let at = dice.below(damaged.len());
        match dice.below(4) {
            0 => damaged[at] = dice.below(256) as u8,
            1 => damaged[at] ^= 1 << dice.below(8),
            2 => {
                let word = dice.pick(words);
                let end = (at + dice.below(4)).min(damaged.len());
                damaged.splice(at..end, word.iter().copied());
            }
            _ => {
                let end = (at + dice.below(40)).min(damaged.len());
                let part = damaged[at..end].to_vec();
                let to = dice.below(damaged.len());
                damaged.splice(to..to, part);
            }
        }
    }
    damaged
}
