//! Damaged files: an error or a document, but no panic, no hang, and no memory beyond the file's.

mod common;

use common::*;
use interchange::{Format, read};

fn samples() -> Vec<(Format, Vec<u8>)> {
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
    let mut binary_ply = ply[..ply.find("0 0 0").unwrap()]
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
    let document = read(obj.as_bytes(), Format::Obj).unwrap().document;
    let [vtk, vtu] = [Format::Vtk, Format::Vtu].map(|format| {
        let mut bytes = Vec::new();
        interchange::write_document(&document, format, &mut bytes).unwrap();
        bytes
    });
    let tets = "# vtk DataFile Version 4.2\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n\
                0 0 0 1 0 0 0 1 0\n0 0 1 0 0 -1\nCELLS 2 10\n4 0 1 2 3\n4 0 2 1 4\nCELL_TYPES 2\n\
                10 10\nCELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n3 4\n";
    vec![
        (Format::Vtk, vtk),
        (Format::Vtu, vtu),
        (Format::Vtk, tets.into()),
        (Format::Stl, binary_stl(b"", &both)),
        (Format::Stl, ascii_stl(&two)),
        (Format::Obj, obj.into()),
        (Format::Off, off.into()),
        (Format::Ply, ply.into()),
        (Format::Ply, binary_ply),
        (Format::Poly, poly.into()),
        (Format::Smesh, smesh.into()),
    ]
}

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
    let mut random = common::sequence(1);
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
            let mut damaged = bytes.clone();
            for _ in 0..1 + random(4) {
                let at = random(damaged.len());
                match random(4) {
                    0 => damaged[at] = random(256) as u8,
                    1 => damaged[at] ^= 1 << random(8),
                    2 => {
                        let word = words[random(words.len())];
                        let end = (at + random(4)).min(damaged.len());
                        damaged.splice(at..end, word.iter().copied());
                    }
                    _ => {
                        let end = (at + random(40)).min(damaged.len());
                        let part = damaged[at..end].to_vec();
                        let to = random(damaged.len());
                        damaged.splice(to..to, part);
                    }
                }
            }
            survives(&damaged, format);
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
