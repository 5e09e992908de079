//! What each format may contain, and what is said when it is wrong.

mod common;

use bodies::facets::*;
use common::*;
use interchange::Format::{Obj, Off, Ply, Poly, Smesh, Stl};
use interchange::sniff;
use std::path::Path;
use tmesh::OUTSIDE;

#[test]
fn stl_dialects() {
    let cube = unit_cube([0.0; 3]);
    let text = String::from_utf8(ascii_stl(&[("Name With Spaces", cube.clone())])).unwrap();
    let dialects = [
        text.clone(),
        text.replace('\n', "\r\n"),
        text.replace("vertex", "   \t VERTEX")
            .replace("facet", "FACET"),
        text.replace("vertex 1 1 1", "vertex 1.0e+00 .1E1 1."),
        text.replace("normal 0 0 0", "normal nan -nan inf"),
        text.replace('\n', " \n\n "),
        format!("\u{feff}{text}"),
        format!("  \n{text}"),
    ];
    for text in dialects {
        assert_eq!(sniff(text.as_bytes(), None), Some(Stl), "{text}");
        let imported = good(text.as_bytes(), Stl);
        assert_eq!(regions(&imported), [(1, "Name With Spaces", 1.0)]);
        assert!(imported.notices.is_empty());
    }
    let unended = text.replace("endsolid Name With Spaces\n", "");
    assert!(good(unended.as_bytes(), Stl).notices[0].contains("endsolid"));
    let two_unended = format!("{unended}{}", text.replace("Name With Spaces", ""))
        .replace("vertex 1 ", "vertex 1.5 ");
    assert!(two_unended.matches("endsolid").count() == 1);
    // A binary file whose header looks like text.
    let binary = binary_stl(b"solid exported by something", &cube);
    assert_eq!(sniff(&binary[..400], None), Some(Stl));
    assert_eq!(regions(&good(&binary, Stl)), [(1, "region1", 1.0)]);
}

#[test]
fn stl_faults() {
    let cube = unit_cube([0.0; 3]);
    let text = String::from_utf8(ascii_stl(&[("a", cube.clone())])).unwrap();
    let fault = |from: &str, to: &str| refused(text.replacen(from, to, 1).as_bytes(), Stl);
    let nan = fault("vertex 1 1 0", "vertex nan 1 0");
    assert_eq!(nan, "stl: line 6: the coordinate 'nan' is not finite");
    assert!(fault("vertex 1 1 0", "vertex 1e999 1 0").contains("not finite"));
    assert!(fault("vertex 1 1 0", "vertex 1,0 1 0").contains("line 6: '1,0' is not a number"));
    assert!(fault("endloop", "vertex 0 0 0\nendloop").contains("line 7: 'endloop' expected"));
    assert!(fault("facet normal", "facette normal").contains("line 2: 'facet' or 'endsolid'"));
    let cut = &text.as_bytes()[..text.rfind("vertex").unwrap()];
    assert!(refused(cut, Stl).contains("the file ends here"));
    let mut binary = binary_stl(b"", &cube);
    let whole = binary.len();
    binary.truncate(whole - 7);
    assert_eq!(
        refused(&binary, Stl),
        "stl: the header announces 12 facets, which is 684 bytes, but the file has 677"
    );
    assert!(refused(&binary[..50], Stl).contains("50 bytes are too few"));
    let mut binary = binary_stl(b"", &cube);
    binary[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(refused(&binary, Stl).contains("4294967295 facets, which is 214748364834 bytes"));
    let mut binary = binary_stl(b"", &cube);
    binary[84 + 50 * 3 + 24..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert_eq!(
        refused(&binary, Stl),
        "stl: facet 4 of 12 has the corner (inf, 1, 1)"
    );
}

/// A cube with quadrilateral faces, corner `i` of [`QUADS`] on line `i`.
const OBJ_CORNERS: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";

fn obj_face(quad: [usize; 4], suffix: &str) -> String {
    let ids: Vec<String> = quad.iter().map(|i| format!("{}{suffix}", i + 1)).collect();
    format!("f {}\n", ids.join(" "))
}

fn obj_cube(suffix: &str) -> String {
    let faces: String = QUADS.iter().map(|&q| obj_face(q, suffix)).collect();
    format!("# a cube\nmtllib nowhere.mtl\n{OBJ_CORNERS}{faces}")
}

#[test]
fn obj_dialects() {
    let plain = obj_cube("");
    let dialects = [
        plain.clone(),
        plain.replace('\n', "\r\n"),
        // Textures and normals that do not exist are of no interest; nor are materials.
        obj_cube("/7/9"),
        obj_cube("//3").replace("f 1", "usemtl red\ns off\nf 1"),
        plain.replace("v 1 1 1", "v 2 2 2 2"),
        plain.replace("v 0 0 0", "v 0 0 0 0.5 0.5 0.5"),
        plain.replace("f 1 3 4 2", "f -8 -6 -5 \\\n -7"),
        format!("{plain}l 1 2\np 3\n"),
    ];
    for text in dialects {
        assert_eq!(sniff(text.as_bytes(), None), Some(Obj), "{text}");
        let imported = good(text.as_bytes(), Obj);
        assert_eq!(regions(&imported), [(1, "region1", 1.0)], "{text}");
    }
}

#[test]
fn obj_groups() {
    // Two closed groups in one file, the second back at the first's name.
    let shifted = OBJ_CORNERS.replace("v 0", "v 3").replace("v 1", "v 4");
    let faces = |base: usize, range: std::ops::Range<usize>| -> String {
        QUADS[range]
            .iter()
            .map(|q| obj_face(q.map(|i| i + base), ""))
            .collect()
    };
    let text = format!(
        "{OBJ_CORNERS}{shifted}g left\n{}g right side\n{}o left\n{}",
        faces(0, 0..3),
        faces(8, 0..6),
        faces(0, 3..6)
    );
    let imported = good(text.as_bytes(), Obj);
    assert_eq!(
        regions(&imported),
        [(1, "left", 1.0), (2, "right side", 1.0)]
    );
    // Groups that are not closed are markers.
    let text = format!(
        "{OBJ_CORNERS}g bottom\n{}g rest\n{}",
        faces(0, 0..1),
        faces(0, 1..6)
    );
    let imported = good(text.as_bytes(), Obj);
    assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
    assert_eq!(markers(&imported), [(1, "bottom", 1.0), (2, "rest", 5.0)]);
}

#[test]
fn obj_faults() {
    let plain = obj_cube("");
    let fault = |from: &str, to: &str| refused(plain.replacen(from, to, 1).as_bytes(), Obj);
    assert_eq!(
        fault("f 1 3 4 2", "f 1 3 9 2"),
        "obj: line 11: vertex 9 does not exist; there are 8, counted from 1"
    );
    assert!(fault("f 1 3 4 2", "f 0 3 4 2").contains("line 11: vertex 0 does not exist"));
    assert!(fault("f 1 3 4 2", "f -9 3 4 2").contains("line 11: vertex -9"));
    assert!(fault("f 1 3 4 2", "f a b c").contains("line 11: a face is not"));
    assert!(fault("v 1 1 1", "v 1 1 x").contains("line 10: a vertex is not three numbers"));
    assert!(fault("v 1 1 1", "v 1 1").contains("line 10"));
    assert!(fault("v 1 1 1", "v 1 1 nan").contains("line 10: the vertex (1, 1, NaN)"));
    assert!(fault("v 1 1 1", "v 1 1 1 0").contains("weight 0"));
    assert!(refused(b"v 0 0 0\n", Obj).contains("no triangles"));
}

fn ply_header(format: &str, vertex: &str, face: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment by hand\nobj_info x\nelement vertex 8\n{vertex}element \
         edge 1\nproperty int a\nelement face 6\n{face}end_header\n"
    )
}

const PLY_VERTEX: &str =
    "property uchar tag\nproperty float x\nproperty float y\nproperty float z\n";
const PLY_FACE: &str =
    "property list uchar float weights\nproperty list uchar int vertex_indices\nproperty short q\n";

fn corner(i: usize) -> [f32; 3] {
    std::array::from_fn(|k| (i >> k & 1) as f32)
}

fn ply_ascii() -> String {
    let mut text = ply_header("ascii", PLY_VERTEX, PLY_FACE);
    for i in 0..8 {
        let [x, y, z] = corner(i);
        text += &format!("7 {x} {y} {z}\n");
    }
    text += "5\n";
    for [a, b, c, d] in QUADS {
        text += &format!("2 0.5 0.25 4 {a} {b} {c} {d} -3\n");
    }
    text
}

fn ply_binary(big: bool) -> Vec<u8> {
    let format = if big {
        "binary_big_endian"
    } else {
        "binary_little_endian"
    };
    let mut bytes = ply_header(format, PLY_VERTEX, PLY_FACE).into_bytes();
    let put = |bytes: &mut Vec<u8>, mut item: Vec<u8>| {
        if big {
            item.reverse();
        }
        bytes.extend(item);
    };
    for i in 0..8 {
        bytes.push(7);
        for x in corner(i) {
            put(&mut bytes, x.to_le_bytes().to_vec());
        }
    }
    put(&mut bytes, 5_i32.to_le_bytes().to_vec());
    for quad in QUADS {
        bytes.push(1);
        put(&mut bytes, 0.5_f32.to_le_bytes().to_vec());
        bytes.push(4);
        for v in quad {
            put(&mut bytes, (v as i32).to_le_bytes().to_vec());
        }
        put(&mut bytes, (-3_i16).to_le_bytes().to_vec());
    }
    bytes
}

#[test]
fn ply_encodings() {
    let ascii = ply_ascii();
    let files = [
        ascii.clone().into_bytes(),
        ascii.replace('\n', "\r\n").into_bytes(),
        ascii.replace("vertex_indices", "vertex_index").into_bytes(),
        ply_binary(false),
        ply_binary(true),
    ];
    for bytes in files {
        assert_eq!(sniff(&bytes, None), Some(Ply));
        let imported = good(&bytes, Ply);
        assert_eq!(regions(&imported), [(1, "region1", 1.0)]);
        assert_eq!(imported.document.templates[0].triangles.len(), 12);
    }
}

#[test]
fn ply_faults() {
    let ascii = ply_ascii();
    let fault = |from: &str, to: &str| refused(ascii.replacen(from, to, 1).as_bytes(), Ply);
    assert!(fault("4 0 2 3 1", "4 0 2 8 1").contains("vertex 8 does not exist; there are 8"));
    assert!(fault("4 0 2 3 1", "4 0 2 -1 1").contains("vertex -1 does not exist"));
    assert!(fault("7 1 1 1", "7 1 nan 1").contains("the position is (1, NaN, 1)"));
    assert!(fault("element face 6", "element face 7").contains("at face 7 of 7"));
    assert!(fault("element vertex 8", "element vertex 4000000000").contains("ends here"));
    assert!(fault("float x", "float32 X").contains("no property 'x'"));
    assert!(fault("ascii", "utf8").contains("line 2: the format 'utf8' is not known"));
    assert!(fault("float x", "half x").contains("the type 'half'"));
    let binary = ply_binary(true);
    let cut = refused(&binary[..binary.len() - 1], Ply);
    assert_eq!(cut, "ply: face 6 of 6: the file ends here");
}

fn off_cube(keyword: &str) -> String {
    let mut text = format!("{keyword}\n# a comment\n\n8 6 12\n");
    for i in 0..8 {
        let [x, y, z] = corner(i);
        text += &format!("{x} {y} {z} # corner {i}\n");
    }
    for [a, b, c, d] in QUADS {
        text += &format!("4  {a} {b} {c} {d} 255 0 0\n");
    }
    text
}

#[test]
fn off_dialects() {
    let plain = off_cube("OFF");
    let dialects = [
        plain.clone(),
        plain.replace('\n', "\r\n"),
        plain.replace("OFF\n# a comment\n\n", "OFF "),
        off_cube("COFF").replace(" # corner", " 0.5 0.5 0.5 1 #"),
        plain.replace("8 6 12", "8 6"),
    ];
    for text in dialects {
        assert_eq!(sniff(text.as_bytes(), None), Some(Off), "{text}");
        assert_eq!(regions(&good(text.as_bytes(), Off)), [(1, "region1", 1.0)]);
    }
}

#[test]
fn off_faults() {
    let plain = off_cube("OFF");
    let fault = |from: &str, to: &str| refused(plain.replacen(from, to, 1).as_bytes(), Off);
    assert_eq!(
        fault("4  0 2 3 1", "4  0 2 8 1"),
        "off: line 13: vertex 8 does not exist; there are 8, counted from 0"
    );
    assert!(fault("1 1 1", "1 1 inf").contains("line 12: the coordinate 'inf' is not finite"));
    assert!(fault("8 6 12", "8 7 12").contains("the file ends here"));
    assert!(fault("8 6 12", "-8 6 12").contains("line 4"));
    assert!(fault("OFF", "4OFF").contains("more than three dimensions"));
    assert!(fault("OFF", "OFF BINARY").contains("binary"));
}

/// A box as facets of one polygon each; the first corner has the id `base`.
fn poly_box(base: usize) -> String {
    QUADS
        .iter()
        .map(|q| {
            let [a, b, c, d] = q.map(|i| i + base);
            format!("1 0 7\n4 {a} {b} {c} {d}\n")
        })
        .collect()
}

fn poly_nodes(first: usize, boxes: &[(Point, Point)]) -> String {
    let mut text = format!("{} 3 1 1 # nodes\n", 8 * boxes.len());
    for (i, (low, high)) in boxes.iter().enumerate() {
        for k in 0..8 {
            let [x, y, z]: Point = std::array::from_fn(|axis| {
                if k >> axis & 1 == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            });
            text += &format!("{} {x} {y} {z} 0.5 3\n", first + 8 * i + k);
        }
    }
    text
}

#[test]
fn poly_nested_boxes() {
    for first in [0, 1] {
        let boxes = [
            ([0.0; 3], [6.0; 3]),
            ([1.0; 3], [5.0; 3]),
            ([2.0; 3], [4.0; 3]),
        ];
        let facets: String = (0..3).map(|i| poly_box(first + 8 * i)).collect();
        let body = format!("{}\n18 1 # facets\n{facets}", poly_nodes(first, &boxes));
        let seeds = "2\n1 0.5 0.5 0.5 3 0.25\n2 3 3 3 0\n";
        let text = format!("{body}1\n1 1.5 1.5 1.5\n{seeds}");
        assert_eq!(sniff(text.as_bytes(), None), Some(Poly));
        let imported = good(text.as_bytes(), Poly);
        assert_eq!(regions(&imported), [(0, "0", 8.0), (3, "3", 152.0)]);
        assert_eq!(markers(&imported), [(7, "7", 216.0 + 96.0 + 24.0)]);
        let limits: Vec<_> = imported.document.regions.iter().map(|r| r.size).collect();
        assert_eq!(limits, [None, Some(tmesh::Size::MaxVolume(0.25))]);
        assert!(imported.notices.is_empty());
        // A hole stays one, whatever region points are in it.
        let both =
            format!("{body}1\n1 1.5 1.5 1.5\n3\n1 0.5 0.5 0.5 3\n2 3 3 3 0\n3 4.5 4.5 4.5 9\n");
        let imported = good(both.as_bytes(), Poly);
        assert_eq!(regions(&imported), [(0, "0", 8.0), (3, "3", 152.0)]);
        let [said] = &imported.notices[..] else {
            panic!("{:?}", imported.notices)
        };
        assert!(
            said.contains("region point 3") && said.contains("stays empty"),
            "{said}"
        );
        // Without the hole, the space between is a region of its own, 1 being free.
        let imported = good(format!("{body}0\n{seeds}").as_bytes(), Poly);
        let all = [(0, "0", 8.0), (1, "region1", 56.0), (3, "3", 152.0)];
        assert_eq!(regions(&imported), all);
        assert_eq!(imported.notices.len(), 1);
        // Without seeds, and without the parts for them, all cells are regions.
        let imported = good(body.as_bytes(), Poly);
        assert_eq!(imported.document.regions.len(), 3);
        // Seeds that contradict each other, a hole, or the geometry.
        let fault = |rest: &str| refused(format!("{body}{rest}").as_bytes(), Poly);
        let two = fault("0\n2\n1 3 3 3 1\n2 3.5 3 3 2\n");
        assert!(two.contains("attributes 1 and 2"), "{two}");
        assert!(fault("0\n1\n1 9 3 3 1\n").contains("lies outside"));
        assert!(fault("0\n1\n1 6 3 2.5 1\n").contains("lies on a facet"));
        assert!(fault("0\n1\n1 3 3 x 1\n").contains("'x' is not a number"));
    }
}

/// Electrodes and sources were lost without a word.
#[test]
fn poly_nodes_and_segments_of_no_facet_are_told() {
    let corners = poly_nodes(1, &[([0.0; 3], [4.0; 3])]);
    let box_nodes = corners.split_once('\n').expect("a head").1;
    let body = |facets: usize, more: &str| {
        let nodes = "9 1 1 1\n10 2 1 1\n11 3 1 1\n12 1 2 3\n13 4 2 2\n";
        format!(
            "13 3 0 0\n{box_nodes}{nodes}{facets} 1\n{}{more}",
            poly_box(1)
        )
    };
    // Nodes 9, 10 and 11 are on two segments, 13 is a point of a segment that ends in the surface.
    let told = good(
        body(8, "2 0 5\n2 9 10\n2 10 11\n1 0 5\n2 11 13\n").as_bytes(),
        Poly,
    )
    .notices;
    assert_eq!(
        told,
        [
            "1 node of no facet with an area, the first at (1, 2, 3): not in the mesh",
            "3 segments of no facet with an area, the first from (1, 1, 1) to (2, 1, 1): not in the mesh"
        ]
    );
    let told = good(body(6, "").as_bytes(), Poly).notices;
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].starts_with("5 nodes of no facet"), "{told:?}");
}

#[test]
fn poly_facets_fit_together() {
    // A small box stands on a large one. The large one's top has the small one's outline as a second
    // polygon; along one side both share a node that the large box does not list.
    let mut text = poly_nodes(
        0,
        &[
            ([0.0; 3], [4.0, 4.0, 1.0]),
            ([0.0, 1.0, 1.0], [2.0, 3.0, 2.0]),
        ],
    );
    text += "11 0\n";
    // The large top is facet [4, 5, 7, 6]; the small box's bottom is [8, 10, 11, 9].
    let large: String = QUADS
        .iter()
        .map(|[a, b, c, d]| {
            if (*a, *b) == (4, 5) {
                "2\n4 4 5 7 6\n4 8 10 11 9\n".to_owned()
            } else {
                format!("1\n4 {a} {b} {c} {d}\n")
            }
        })
        .collect();
    let small: String = QUADS[1..]
        .iter()
        .map(|q| {
            let [a, b, c, d] = q.map(|i| i + 8);
            format!("1\n4 {a} {b} {c} {d}\n")
        })
        .collect();
    text += &large;
    text += &small;
    let imported = good(text.as_bytes(), Poly);
    let volumes: Vec<f64> = regions(&imported).iter().map(|r| r.2).collect();
    assert_eq!(volumes, [16.0, 4.0]);
    let source = imported.document.source.as_ref().unwrap();
    assert_eq!(round(source.boundary_area), 16.0 + 16.0 + 16.0 + 2.0 * 4.0);
    // Without the outline in its top, the boxes touch where they should not.
    let apart = text.replace("2\n4 4 5 7 6\n4 8 10 11 9\n", "1\n4 4 5 7 6\n");
    let apart = apart.replace("11 0\n", "12 0\n") + "1\n4 8 10 11 9\n";
    assert!(refused(apart.as_bytes(), Poly).contains("cross or touch"));
}

#[test]
fn poly_facets_with_holes() {
    // A square tunnel through a box: holes in top and bottom, one of them hit on a diagonal.
    let mut text = poly_nodes(
        1,
        &[([-2.0; 3], [2.0; 3]), ([-1.0, -1.0, -2.0], [1.0, 1.0, 2.0])],
    );
    text += "10 0\n";
    for (q, z) in [(QUADS[0], -2), (QUADS[1], 2)] {
        let [a, b, c, d] = q.map(|i| i + 1);
        let [e, f, g, h] = q.map(|i| i + 9);
        text += &format!("2 1\n4 {a} {b} {c} {d}\n4 {e} {f}\n{g} {h}\n1 0 0 {z}\n");
    }
    for q in &QUADS[2..] {
        for base in [1, 9] {
            let [a, b, c, d] = q.map(|i| i + base);
            text += &format!("1\n4 {a} {b} {c} {d}\n");
        }
    }
    let imported = good(text.as_bytes(), Poly);
    assert_eq!(regions(&imported), [(1, "region1", 48.0)]);
    let triangles = &imported.document.templates[0].triangles;
    assert!(triangles.iter().all(|t| (t.front, t.back) == (OUTSIDE, 1)));
    assert!(imported.notices.is_empty(), "{:?}", imported.notices);
}

#[test]
fn poly_faults() {
    let text = format!(
        "{}6 1\n{}0\n0\n",
        poly_nodes(0, &[([0.0; 3], [1.0; 3])]),
        poly_box(0)
    );
    assert_eq!(good(text.as_bytes(), Poly).document.regions.len(), 1);
    let fault = |from: &str, to: &str| refused(text.replacen(from, to, 1).as_bytes(), Poly);
    assert_eq!(
        fault("4 0 2 3 1", "4 0 2 8 1"),
        "poly: line 12: node 8 does not exist; there are nodes 0 to 7"
    );
    assert!(fault("4 0 2 3 1", "4 0 2 -1 1").contains("node -1 does not exist"));
    assert!(fault("8 3 1 1", "0 3 1 1").contains(".node"));
    assert!(fault("8 3 1 1", "8 2 1 1").contains("dimension 2"));
    assert!(fault("\n3 1 1 0", "\n4 1 1 0").contains("line 5: node 3 expected, found 4"));
    assert!(fault("\n3 1 1 0", "\n3 1 nan 0").contains("line 5: the coordinate 'nan'"));
    assert!(fault("6 1", "1000000000000 1").contains("poly: line"));
    let open = fault("6 1", "5 1");
    // Five facets, and the sixth is taken for the holes.
    assert!(!open.is_empty());
    let text = text.replace("6 1\n1 0 7\n4 0 2 3 1\n", "5 1\n");
    let open = refused(text.as_bytes(), Poly);
    assert!(
        open.starts_with("the facets enclose nothing; 4 edges have one facet only"),
        "{open}"
    );
}

#[test]
fn smesh() {
    let facets: String = QUADS
        .iter()
        .map(|[a, b, c, d]| format!("4 {a} {b} {c} {d} 2\n"))
        .collect();
    let text = format!(
        "{}6 1\n{facets}0\n1\n1 0.5 0.5 0.5 1.5 0.1\n",
        poly_nodes(0, &[([0.0; 3], [1.0; 3])])
    );
    assert_eq!(
        sniff(text.as_bytes(), Some(Path::new("a.smesh"))),
        Some(Smesh)
    );
    let imported = good(text.as_bytes(), Smesh);
    assert_eq!(regions(&imported), [(1, "1.5", 1.0)]);
    assert_eq!(markers(&imported), [(2, "2", 6.0)]);
}

#[test]
fn extensions_only_break_ties() {
    let path = |p| Some(Path::new(p));
    assert_eq!(sniff(b"whatever", None), None);
    assert_eq!(sniff(b"whatever", path("a.OBJ")), Some(Obj));
    assert_eq!(sniff(ply_ascii().as_bytes(), path("a.stl")), Some(Ply));
    assert_eq!(sniff(b"solid", path("a.stl")), Some(Stl));
}
