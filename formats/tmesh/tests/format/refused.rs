//! Damaged and hostile documents: each is an error, none a panic or an allocation beyond its size.

use crate::samples::{bytes, column, pyramid, sized};
use std::io::{self, Read};
use tmesh::{
    ChunkWriter, DecodeError, Document, Gluing, Group, Isometry, Kind, RegionMap, Size, Violation,
    read,
};

fn error(bytes: &[u8]) -> DecodeError {
    match read(bytes) {
        Err(error) => error,
        Ok(_) => panic!("it was accepted"),
    }
}

/// The first violation of a document that is written as it is, and how many there are.
fn violation(document: &Document) -> Violation {
    match error(&bytes(document)) {
        DecodeError::Invalid { first, .. } => first,
        other => panic!("{other}"),
    }
}

/// A document of hand-made chunks.
fn chunks(fill: impl FnOnce(&mut ChunkWriter<&mut Vec<u8>>) -> io::Result<()>) -> Vec<u8> {
    let mut raw = Vec::new();
    let mut writer = ChunkWriter::begin(&mut raw).expect("memory");
    fill(&mut writer).expect("memory");
    writer.finish().expect("memory");
    raw
}

#[test]
fn nothing() {
    let text = error(b"").to_string();
    assert_eq!(text, "the input is empty; did the previous stage fail?");
}

#[test]
fn every_truncation() {
    for document in [pyramid(), column(), sized()] {
        let whole = bytes(&document);
        for length in 1..whole.len() {
            match error(&whole[..length]) {
                DecodeError::Truncated { offset, .. } => assert_eq!(offset, length as u64),
                other => panic!("cut at {length}: {other}"),
            }
        }
    }
}

#[test]
fn every_byte_altered() {
    for document in [pyramid(), column(), sized()] {
        let whole = bytes(&document);
        for place in 0..whole.len() {
            for change in [0x01, 0x80, 0xff] {
                let mut damaged = whole.clone();
                damaged[place] ^= change;
                match error(&damaged) {
                    DecodeError::BadMagic { .. } => assert!(place < 8),
                    DecodeError::Checksum { .. } => assert!(place >= 8),
                    // No checksum covers the zeros between and after the checksums.
                    DecodeError::BadChunk { reason, .. } => {
                        assert!(reason.ends_with("not zero"), "byte {place}: {reason}");
                        assert_eq!(whole[place], 0);
                    }
                    other => panic!("byte {place} xor {change:#x}: {other}"),
                }
            }
        }
    }
}

/// Bytes that must be zero and are not were reported as checksums that differ, and did not.
#[test]
fn padding_that_is_not_zero_is_called_so() {
    let whole = bytes(&pyramid());
    let (_, list) = tmesh::read_with_chunks(whole.as_slice()).expect("valid");
    let regions = list.iter().find(|c| &c.id == b"REGN").expect("regions");
    let begin = regions.offset as usize;
    let end = begin + 24 + regions.length as usize;
    for (place, expected) in [
        (begin + 20, "the last four bytes of its header are not zero"),
        (end, "the padding after its payload is not zero"),
        (
            end + 2 + 4,
            "the four bytes after its checksum are not zero",
        ),
    ] {
        let mut damaged = whole.clone();
        damaged[place] = 1;
        let text = error(&damaged).to_string();
        assert!(text.contains("REGN") && text.ends_with(expected), "{text}");
    }
}

/// Words that must be zero are covered by the checksum: a writer that fills them is told which.
#[test]
fn reserved_words_that_are_not_zero() {
    let whole = bytes(&pyramid());
    let (_, list) = tmesh::read_with_chunks(whole.as_slice()).expect("valid");
    for (id, word) in [(*b"GLUE", 7), (*b"INST", 5)] {
        let raw = chunks(|writer| {
            for chunk in &list {
                let start = chunk.offset as usize + 24;
                let mut data = whole[start..start + chunk.length as usize].to_vec();
                if chunk.id == id {
                    data[4 * word] = 1;
                }
                writer.array(chunk.id, chunk.scope, &data)?;
            }
            Ok(())
        });
        let text = error(&raw).to_string();
        assert!(text.ends_with("a reserved field is not zero"), "{text}");
    }
}

#[test]
fn an_end_marker_of_a_template() {
    let whole = bytes(&pyramid());
    let mut scoped = whole.clone();
    let end = whole.len() - 48;
    scoped[end + 4] = 1;
    let crc = crc32fast::hash(&scoped[end..end + 16]);
    scoped[end + 16..end + 20].copy_from_slice(&crc.to_le_bytes());
    let text = error(&scoped).to_string();
    assert!(text.ends_with("its scope is 1, and must be 0"), "{text}");
}

#[test]
fn axis_vertices_out_of_order() {
    let mut document = pyramid();
    document.templates[0].axis = vec![3, 0];
    let text = violation(&document).to_string();
    assert!(text.contains("not increasing"), "{text}");
}

#[test]
fn json_numbers_keys_and_nulls() {
    let regions = |json: &str| {
        let bytes = chunks(|w| {
            w.array(*b"REGN", 0, json.as_bytes())?;
            w.array::<f64>(*b"VERT", 0, &[])
        });
        read(bytes.as_slice()).map(|document| document.regions)
    };
    for right in [
        r#"[{"id":1,"name":"Cu"}]"#,
        r#" [ {"name" : "Cu", "id" : 1, "colour" : [1.0, null], "colour" : 2} ] "#,
        r#"[{"id":1,"name":"C\u0075","max_volume":null,"volume":null}]"#,
        r#"[{"id":1,"name":"Cu","volume":2}]"#,
    ] {
        let found = regions(right).expect(right);
        assert_eq!((found[0].id, found[0].name.as_str()), (1, "Cu"), "{right}");
    }
    for wrong in [
        r#"[{"id":1.0,"name":"Cu"}]"#,
        r#"[{"id":"1","name":"Cu"}]"#,
        r#"[{"id":-1,"name":"Cu"}]"#,
        r#"[{"id":4294967296,"name":"Cu"}]"#,
        r#"[{"id":null,"name":"Cu"}]"#,
        r#"[{"id":1,"id":1,"name":"Cu"}]"#,
        r#"[{"name":"Cu"}]"#,
        r#"[{"id":1,"name":"Cu","volume":1e999}]"#,
        r#"[{"id":1,"name":"Cu"},]"#,
        r#"[{"id":1,"name":"Cu"}] x"#,
        "\u{feff}[]",
        "{}",
        "",
    ] {
        let text = regions(wrong).expect_err(wrong).to_string();
        assert!(text.contains("its JSON is not as expected"), "{text}");
    }
}

#[test]
fn bytes_after_the_end() {
    let mut more = bytes(&pyramid());
    let end = more.len() as u64;
    more.push(0);
    assert!(matches!(error(&more), DecodeError::TrailingBytes { offset } if offset == end));
    // Two documents in one stream are not one document.
    let two = [bytes(&pyramid()), bytes(&pyramid())].concat();
    assert!(matches!(error(&two), DecodeError::TrailingBytes { offset } if offset == end));
}

#[test]
fn another_format() {
    let text = error(b"solid cube\nfacet normal 0 0 1\n").to_string();
    assert!(text.starts_with("not a tmesh document"), "{text}");
    // What a transfer in text mode makes of the line end.
    let mut unixed = bytes(&pyramid());
    unixed.remove(6);
    assert!(matches!(error(&unixed), DecodeError::BadMagic { .. }));
}

#[test]
fn another_version() {
    let mut newer = bytes(&pyramid());
    newer[8] = 2;
    let crc = crc32fast::hash(&newer[..12]);
    newer[12..16].copy_from_slice(&crc.to_le_bytes());
    let text = error(&newer).to_string();
    assert!(
        text.contains("format version 2") && text.contains("reads version 1"),
        "{text}"
    );
    // A newer minor version only adds chunks that may be skipped.
    let mut newer = bytes(&pyramid());
    newer[10] = 200;
    let crc = crc32fast::hash(&newer[..12]);
    newer[12..16].copy_from_slice(&crc.to_le_bytes());
    assert_eq!(read(newer.as_slice()).expect("readable"), pyramid());
}

/// The chunks of a written document, with one more before the end marker.
fn with_chunk(document: &Document, id: [u8; 4], payload: &[u8]) -> Vec<u8> {
    let whole = bytes(document);
    let (_, list) = tmesh::read_with_chunks(whole.as_slice()).expect("valid");
    chunks(|writer| {
        for chunk in &list {
            let start = chunk.offset as usize + 24;
            let data = &whole[start..start + chunk.length as usize];
            writer.array(chunk.id, chunk.scope, data)?;
        }
        writer.array(id, 0, payload)
    })
}

#[test]
fn unknown_chunks() {
    let optional = with_chunk(&column(), *b"note", b"anything, 17 bytes");
    let (document, list) = tmesh::read_with_chunks(optional.as_slice()).expect("skipped");
    assert_eq!(document, column());
    let last = list.last().expect("chunks");
    assert_eq!(
        (last.name().as_str(), last.known, last.length),
        ("note", false, 18)
    );
    assert!(list.iter().rev().skip(1).all(|c| c.known));

    match error(&with_chunk(&column(), *b"CURV", &[0; 40])) {
        DecodeError::UnknownCritical { id, .. } => assert_eq!(id, "CURV"),
        other => panic!("{other}"),
    }
    // Damage in a chunk that is skipped is damage all the same.
    let mut damaged = optional;
    let place = damaged.len() - 24 - 16 - 8 - 16;
    damaged[place] ^= 1;
    assert!(matches!(error(&damaged), DecodeError::Checksum { .. }));
}

#[test]
fn chunks_twice_or_out_of_place() {
    let text = error(&with_chunk(&pyramid(), *b"REGN", b"[]")).to_string();
    assert!(text.ends_with("it is there twice"), "{text}");
    let text = error(&with_chunk(&pyramid(), *b"TRIS", &[])).to_string();
    assert!(text.ends_with("it is there twice"), "{text}");
    let scoped = chunks(|w| w.array(*b"REGN", 3, b"[]"));
    let text = error(&scoped).to_string();
    assert!(text.ends_with("its scope is 3, and must be 0"), "{text}");
    let early = chunks(|w| w.array::<u32>(*b"TRIS", 0, &[]));
    let text = error(&early).to_string();
    assert!(
        text.ends_with("it belongs to template 0, and 0 have begun"),
        "{text}"
    );
    let gap = chunks(|w| w.array::<f64>(*b"VERT", 1, &[]));
    let text = error(&gap).to_string();
    assert!(
        text.ends_with("template 1 where template 0 should begin"),
        "{text}"
    );
    let nothing = chunks(|_| Ok(()));
    assert!(matches!(
        error(&nothing),
        DecodeError::Invalid {
            first: Violation::NoTemplate,
            ..
        }
    ));
}

#[test]
fn an_end_marker_that_counts_otherwise() {
    let mut raw = bytes(&pyramid());
    let payload = raw.len() - 24;
    raw[payload] += 1;
    let crc = crc32fast::hash(&raw[payload..payload + 16]);
    let trailer = raw.len() - 8;
    raw[trailer..trailer + 4].copy_from_slice(&crc.to_le_bytes());
    let text = error(&raw).to_string();
    assert!(
        text.contains("chunk 'END '") && text.contains("were read"),
        "{text}"
    );
}

/// Notes the largest buffer it was asked to fill.
struct Watched<'a> {
    bytes: &'a [u8],
    largest: usize,
}

impl Read for Watched<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.largest = self.largest.max(buffer.len());
        self.bytes.read(buffer)
    }
}

#[test]
fn hostile_lengths_allocate_little() {
    for length in [1 << 20, 1 << 31, 1 << 40, 1 << 62, u64::MAX - 7] {
        for id in [
            *b"VERT", *b"TRIS", *b"TETS", *b"AXIS", *b"INST", *b"REGN", *b"FRAM", *b"note",
        ] {
            // The header of a chunk after an empty template, and not a byte of what it promises.
            let mut raw = chunks(|w| {
                if id != *b"VERT" {
                    w.array::<f64>(*b"VERT", 0, &[])?;
                }
                Ok(())
            });
            raw.truncate(raw.len() - 48);
            let mut header = Vec::new();
            header.extend(id);
            header.extend(0_u32.to_le_bytes());
            header.extend((length / 120 * 120).to_le_bytes());
            header.extend(crc32fast::hash(&header).to_le_bytes());
            header.extend([0; 4]);
            raw.extend(header);
            let mut input = Watched {
                bytes: &raw,
                largest: 0,
            };
            match read(&mut input) {
                Err(DecodeError::Truncated { offset, .. }) => assert_eq!(offset, raw.len() as u64),
                other => panic!("{:?} of {length}: {other:?}", id.escape_ascii().to_string()),
            }
            assert!(
                input.largest <= 1 << 20,
                "a buffer of {} bytes",
                input.largest
            );
        }
    }
}

#[test]
fn hostile_counts_inside_a_gluing() {
    for (name, vertices, triangles) in [
        (u32::MAX, 0, 0),
        (0, u32::MAX, u32::MAX),
        (0, 1, 0),
        (5, 0, 0),
    ] {
        let raw = chunks(|w| {
            w.array::<f64>(*b"VERT", 0, &[])?;
            w.array(*b"GLUE", 0, &[0, 0, 1, 0, name, vertices, triangles, 0])
        });
        let text = error(&raw).to_string();
        assert!(text.contains("which is not its size"), "{text}");
    }
}

#[test]
fn gluings_that_make_no_sense() {
    let gluing = |words: &[u32]| {
        let raw = chunks(|w| {
            w.array::<f64>(*b"VERT", 0, &[])?;
            w.array(*b"GLUE", 0, words)
        });
        error(&raw).to_string()
    };
    let fixed = |name, pairs, reserved| vec![0_u32, 0, 1, 0, name, pairs, 0, reserved];
    assert!(gluing(&[0, 0, 1, 0]).ends_with("shorter than its fixed part"));
    assert!(gluing(&fixed(0, 0, 1)).ends_with("a reserved field is not zero"));
    let odd = [fixed(0, 1, 0), vec![0; 3]].concat();
    assert!(gluing(&odd).ends_with("which is not its size"));
    let latin = [fixed(2, 0, 0), vec![0x0000_fcfc]].concat();
    assert!(gluing(&latin).ends_with("its name is not UTF-8"));
    let unpadded = [fixed(2, 0, 0), vec![0x0100_6161]].concat();
    assert!(gluing(&unpadded).ends_with("the padding of its name is not zero"));
    let ragged = chunks(|w| {
        w.array::<f64>(*b"VERT", 0, &[])?;
        w.array(*b"GLUE", 0, &[0_u8; 66])
    });
    let text = error(&ragged).to_string();
    assert!(
        text.ends_with("66 bytes are not a whole number of 4"),
        "{text}"
    );
}

#[test]
fn json_that_is_not_as_expected() {
    let deep = [vec![b'['; 100_000], vec![b']'; 100_000]].concat();
    let cases: [(&[u8; 4], &[u8]); 11] = [
        (b"REGN", &deep),
        (b"SYMM", &deep),
        (b"hist", b"{}"),
        (b"PROM", b"{\"group\": \"C4\"}"),
        (b"WISH", b"{\"radius_edge\": \"small\"}"),
        (b"srch", b"7"),
        (b"REGN", b"[{\"id\": -1, \"name\": \"x\"}]"),
        (b"REGN", b"[{\"id\": 4294967296, \"name\": \"x\"}]"),
        (
            b"srce",
            b"{\"format\": \"stl\", \"triangles\": 1, \"volume\": 1e999}",
        ),
        (b"MARK", b"[\xff]"),
        (b"RMAP", b"[{\"pairs\": [[1]]}]"),
    ];
    for (id, json) in cases {
        let text = error(&chunks(|w| w.array(*id, 0, json))).to_string();
        assert!(text.contains("its JSON is not as expected"), "{text}");
    }
    let short = chunks(|w| w.array(*b"FRAM", 0, &[0.0_f64; 11]));
    assert!(error(&short).to_string().ends_with("11 numbers, not 12"));
}

#[test]
fn numbers_that_are_none() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut document = pyramid();
        document.templates[0].vertices[2].y = bad;
        let text = violation(&document).to_string();
        assert!(
            text.starts_with("vertex 2 of template 0 has the coordinates (0, "),
            "{text}"
        );
        let mut document = pyramid();
        document.frame.origin.z = bad;
        assert_eq!(violation(&document), Violation::BadFrame);
        let mut document = pyramid();
        document.frame.rotation.x_axis.x = bad;
        assert_eq!(violation(&document), Violation::BadFrame);
    }
    let mut document = pyramid();
    document.frame.rotation = -document.frame.rotation;
    assert_eq!(violation(&document), Violation::BadFrame);
}

/// A mirror wall of the pyramid.
fn mirror(document: &mut Document) -> &mut Gluing {
    &mut document.templates[0].gluings[0]
}

/// The seam of a template of the column.
fn seam(document: &mut Document, template: usize) -> &mut Gluing {
    &mut document.templates[template].gluings[0]
}

/// The hub wall of the column.
fn hub(document: &mut Document) -> &mut Gluing {
    &mut document.templates[0].gluings[1]
}

#[test]
fn indices_out_of_range() {
    let mut document = pyramid();
    document.templates[0].triangles[3].vertices[1] = 4;
    let text = violation(&document).to_string();
    assert_eq!(
        text,
        "triangle 3 of template 0 names vertex 4, and there are 4"
    );
    let mut document = pyramid();
    document.templates[0].tets[0].vertices[3] = u32::MAX;
    assert!(matches!(
        violation(&document),
        Violation::VertexOutOfRange {
            vertex: u32::MAX,
            ..
        }
    ));
    let mut document = pyramid();
    document.templates[0].axis[1] = 9;
    assert!(matches!(
        violation(&document),
        Violation::VertexOutOfRange { vertex: 9, .. }
    ));
    let mut document = pyramid();
    mirror(&mut document).vertex_pairs[2] = [4, 4];
    assert!(matches!(
        violation(&document),
        Violation::VertexOutOfRange { vertex: 4, .. }
    ));
    let mut document = pyramid();
    mirror(&mut document).triangle_pairs[0] = [4, 4];
    assert!(matches!(
        violation(&document),
        Violation::TriangleOutOfRange { triangle: 4, .. }
    ));
    let mut document = column();
    seam(&mut document, 1).vertex_pairs[3][1] = 6;
    assert!(matches!(
        violation(&document),
        Violation::VertexOutOfRange { vertex: 6, .. }
    ));
    let mut document = column();
    hub(&mut document).vertex_pairs[3][1] = 6;
    assert!(matches!(
        violation(&document),
        Violation::VertexOutOfRange { template: 1, .. }
    ));
    let mut document = column();
    hub(&mut document).triangle_pairs[1][1] = 8;
    assert!(matches!(
        violation(&document),
        Violation::TriangleOutOfRange { template: 1, .. }
    ));
    let mut document = column();
    hub(&mut document).other = 2;
    assert!(matches!(
        violation(&document),
        Violation::IndexOutOfRange { index: 2, .. }
    ));
    let mut document = column();
    document.instances[2].template = 5;
    let text = violation(&document).to_string();
    assert_eq!(text, "instance 2 names template 5, and there are 2");
    let mut document = column();
    document.instances[2].region_map = 2;
    let text = violation(&document).to_string();
    assert_eq!(text, "instance 2 names region map 2, and there are 1");
}

#[test]
fn elements_and_tables_that_contradict_each_other() {
    let mut document = pyramid();
    document.templates[0].triangles[0].vertices = [0, 2, 2];
    assert!(matches!(
        violation(&document),
        Violation::RepeatedVertex { vertex: 2, .. }
    ));
    let mut document = pyramid();
    document.templates[0].tets[0].region = 7;
    assert!(matches!(
        violation(&document),
        Violation::UnknownRegion { region: 7, .. }
    ));
    let mut document = pyramid();
    document.templates[0].triangles[0].front = 7;
    assert!(matches!(
        violation(&document),
        Violation::UnknownRegion { region: 7, .. }
    ));
    let mut document = column();
    document.regions.swap(0, 1);
    assert!(matches!(
        violation(&document),
        Violation::BadTable {
            table: "region",
            ..
        }
    ));
    let mut document = column();
    document.markers[1].id = 7;
    assert!(matches!(
        violation(&document),
        Violation::BadTable {
            table: "marker",
            id: 7
        }
    ));
    let mut document = column();
    document.region_maps[0].pairs[0][1] = 3;
    assert!(matches!(
        violation(&document),
        Violation::BadTable {
            table: "region map",
            id: 3
        }
    ));
    let mut document = column();
    let symmetry = document.symmetry.as_mut().expect("there");
    symmetry.regions.push(RegionMap::default());
    let text = violation(&document).to_string();
    assert_eq!(
        text,
        "the symmetry says of 3 operations how they permute regions, and C4h has 2 generators"
    );
    let mut document = column();
    let outside = document.promise.as_mut().and_then(|p| p.outside.as_mut());
    outside.expect("there").group = Group::new(Kind::C, 6);
    let text = violation(&document).to_string();
    assert_eq!(
        text,
        "the symmetry has the order 6 outside, which is no multiple of the order 4 of the whole"
    );
    let mut document = column();
    document.symmetry.as_mut().expect("there").reference = [0.8, 0.6, 0.0];
    assert!(
        violation(&document)
            .to_string()
            .contains("not orthogonal to the axis")
    );
    let mut document = column();
    document.symmetry.as_mut().expect("there").axis.direction = [0.0; 3];
    assert!(violation(&document).to_string().contains("of length 0"));
}

#[test]
fn names_with_control_characters() {
    type Change = fn(&mut Document);
    let cases: [(Change, &str); 3] = [
        (|d| d.regions[0].name.push('\n'), "region"),
        (|d| d.markers[0].name.push('\u{1b}'), "marker"),
        (|d| seam(d, 0).name.push('\0'), "wall"),
    ];
    for (change, what) in cases {
        let mut document = column();
        change(&mut document);
        let text = violation(&document).to_string();
        assert!(
            text.contains(what) && text.ends_with("has a control character"),
            "{text}"
        );
    }
}

#[test]
fn numbers_of_the_tables_that_are_none() {
    type Change = fn(&mut Document);
    let cases: [(Change, &str); 9] = [
        (
            |d| d.regions[0].size = Some(Size::MaxVolume(f64::NAN)),
            "the volume limit of region 'copper' is NaN, and must be a finite positive number",
        ),
        (
            |d| d.regions[0].size = Some(Size::MaxVolume(0.0)),
            "the volume limit of region 'copper' is 0, and must be a finite positive number",
        ),
        (
            |d| d.regions[0].size = Some(Size::EdgeLength(-1.0)),
            "the length of edges in region 'copper' is -1, and must be a finite positive number",
        ),
        (
            |d| d.wishes.layers_across = Some(0),
            "the number of elements across walls wished for is 0, and must be a finite positive number",
        ),
        (
            |d| d.regions[1].volume = Some(f64::INFINITY),
            "the volume of region 'Silizium \u{3b1}' is inf, and must be a finite number",
        ),
        (
            |d| d.markers[0].area = Some(f64::NAN),
            "the area of 'side' is NaN, and must be a finite number",
        ),
        (
            |d| d.source.as_mut().expect("there").precision = f64::NAN,
            "the source's precision is NaN, and must be a finite number",
        ),
        (
            |d| d.search.as_mut().expect("there").rejected[0].residual = f64::NAN,
            "a number of the symmetry is NaN, and must be a finite number",
        ),
        (
            |d| d.wishes.radius_edge = Some(0.0),
            "the radius-edge ratio wished for is 0, and must be a finite positive number",
        ),
    ];
    for (change, text) in cases {
        let mut document = column();
        change(&mut document);
        let found: Vec<String> = tmesh::validate(&document)
            .iter()
            .map(ToString::to_string)
            .collect();
        assert_eq!(found, [text]);
    }
}

#[test]
fn size_fields_that_are_none() {
    type Change = fn(&mut tmesh::SizeField);
    let cases: [(Change, &str); 9] = [
        (
            |f| f.points[2].size = 0.0,
            "point 2 has the length 0, which must be a finite positive number",
        ),
        (
            |f| f.points[1].size = -1.0,
            "point 1 has the length -1, which must be a finite positive number",
        ),
        (
            |f| f.points[1].size = f64::NAN,
            "point 1 has the length NaN, which must be a finite positive number",
        ),
        (
            |f| f.points[3].size = f64::INFINITY,
            "point 3 has the length inf, which must be a finite positive number",
        ),
        (
            |f| f.points[0].position.y = f64::NAN,
            "point 0 has the coordinates [-1, NaN, 0]",
        ),
        (
            |f| f.tets[0][3] = 5,
            "tetrahedron 0 names point 5, and there are 5",
        ),
        (
            |f| f.triangles[0][0] = u32::MAX,
            "triangle 0 names point 4294967295, and there are 5",
        ),
        (|f| f.tets[0][1] = 3, "tetrahedron 0 names a point twice"),
        (
            |f| (f.tets.clear(), f.triangles.clear()).0,
            "it has no elements",
        ),
    ];
    for (change, text) in cases {
        let mut document = sized();
        change(document.size_field.as_mut().expect("there"));
        let found = violation(&document).to_string();
        assert_eq!(found, format!("the size field: {text}"));
    }
}

/// Elements without points are read to the end, and refused.
#[test]
fn size_fields_without_points() {
    let raw = chunks(|writer| {
        writer.array(*b"FTET", 0, &[0_u32, 1, 2, 3])?;
        writer.array(*b"VERT", 0, &[0.0_f64; 3])
    });
    let text = error(&raw).to_string();
    assert!(text.contains("names point 0, and there are 0"), "{text}");
    let raw = chunks(|writer| {
        writer.array(*b"FPTS", 0, &[1.0_f64; 3])?;
        writer.array(*b"VERT", 0, &[0.0_f64; 3])
    });
    let text = error(&raw).to_string();
    assert!(text.contains("not a whole number of 32"), "{text}");
    let raw = chunks(|writer| {
        writer.array(*b"FPTS", 1, &[1.0_f64; 4])?;
        writer.array(*b"VERT", 0, &[0.0_f64; 3])
    });
    let text = error(&raw).to_string();
    assert!(text.contains("its scope is 1"), "{text}");
}

#[test]
fn walls_that_do_not_match() {
    let mut document = pyramid();
    document.templates[0].vertices[1].y = 1e-9;
    assert!(matches!(
        violation(&document),
        Violation::OffPlane { vertex: 1, .. }
    ));
    let mut document = pyramid();
    mirror(&mut document).step = Isometry::reflection(1, 4);
    assert!(matches!(
        violation(&document),
        Violation::OffPlane { vertex: 1, .. }
    ));
    let mut document = pyramid();
    mirror(&mut document).vertex_pairs[1][1] = 3;
    assert!(matches!(
        violation(&document),
        Violation::NotItself {
            what: "vertices",
            first: 1,
            second: 3,
            ..
        }
    ));
    let mut document = pyramid();
    mirror(&mut document).triangle_pairs[0] = [0, 0];
    assert!(matches!(
        violation(&document),
        Violation::TrianglesDiffer {
            first: 0,
            second: 0,
            ..
        }
    ));
    let mut document = pyramid();
    mirror(&mut document).vertex_pairs.swap(0, 1);
    assert!(matches!(
        violation(&document),
        Violation::Unordered {
            what: "vertex pairs",
            ..
        }
    ));
    let mut document = pyramid();
    document.templates[0].axis[1] = 1;
    assert!(matches!(
        violation(&document),
        Violation::OffAxis { vertex: 1, .. }
    ));

    let mut document = column();
    document.templates[0].vertices[6].y += f64::EPSILON;
    assert!(matches!(
        violation(&document),
        Violation::NotAnImage {
            first: 6,
            second: 0,
            ..
        }
    ));
    let mut document = column();
    seam(&mut document, 0).triangle_pairs[0][1] = 1;
    assert!(matches!(
        violation(&document),
        Violation::TrianglesDiffer {
            first: 4,
            second: 1,
            ..
        }
    ));
    let mut document = column();
    seam(&mut document, 0).triangle_pairs.swap(0, 1);
    assert!(matches!(
        violation(&document),
        Violation::Unordered {
            what: "triangle pairs",
            ..
        }
    ));
    let mut document = column();
    seam(&mut document, 0).vertex_pairs.swap(0, 1);
    assert!(matches!(
        violation(&document),
        Violation::Unordered {
            what: "vertex pairs",
            ..
        }
    ));
    let mut document = column();
    hub(&mut document).vertex_pairs[0][1] = 3;
    assert!(matches!(violation(&document), Violation::NotAnImage { .. }));
    let mut document = column();
    hub(&mut document).step = Isometry::rotation(1, 4);
    assert!(matches!(violation(&document), Violation::NotAnImage { .. }));
}

#[test]
fn instances_that_do_not_fit_together() {
    let mut document = pyramid();
    document.instances[3] = document.instances[0];
    assert!(matches!(
        violation(&document),
        Violation::RepeatedInstance { .. }
    ));
    let mut document = pyramid();
    document.instances.pop();
    let text = violation(&document).to_string();
    assert!(
        text.contains("has no neighbour 1/2 mirrored across wall"),
        "{text}"
    );
    // A hub that is missing somewhere.
    let mut document = column();
    document.instances.remove(1);
    assert!(matches!(
        violation(&document),
        Violation::MissingNeighbour { .. }
    ));
    // A wedge alone is a sector, and valid.
    let mut document = pyramid();
    document.instances.truncate(1);
    assert_eq!(read(bytes(&document).as_slice()).expect("valid"), document);
}

#[test]
fn a_reader_that_fails() {
    struct Broken;
    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("the disk is on fire"))
        }
    }
    let whole = bytes(&pyramid());
    for length in [0, 5, 16, 30, 200, whole.len()] {
        match read((&whole[..length]).chain(Broken)) {
            Err(DecodeError::Io(e)) => assert_eq!(e.to_string(), "the disk is on fire"),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn one_byte_at_a_time() {
    struct Trickle<'a>(&'a [u8]);
    impl Read for Trickle<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let length = buffer.len().min(1);
            self.0.read(&mut buffer[..length])
        }
    }
    let whole = bytes(&column());
    assert_eq!(read(Trickle(&whole)).expect("valid"), column());
}

/// Every 32-bit word of every payload set to values that mean trouble, checksums made right: a
/// document is refused, or it is valid and survives a round trip.
#[test]
fn every_word_replaced() {
    let mut accepted = 0;
    for document in [pyramid(), column(), sized()] {
        let whole = bytes(&document);
        let (_, list) = tmesh::read_with_chunks(whole.as_slice()).expect("valid");
        for chunk in &list {
            let start = chunk.offset as usize + 24;
            let end = start + chunk.length as usize;
            let trailer = end.next_multiple_of(8);
            for place in (start..end - 3).step_by(4) {
                for word in [0, 1, 3, 65_537, 0x7ff0_0000, 0x8000_0000, u32::MAX] {
                    let mut altered = whole.clone();
                    altered[place..place + 4].copy_from_slice(&u32::to_le_bytes(word));
                    let crc = crc32fast::hash(&altered[start..end]);
                    altered[trailer..trailer + 4].copy_from_slice(&crc.to_le_bytes());
                    if let Ok(document) = read(altered.as_slice()) {
                        accepted += 1;
                        let again = bytes(&document);
                        assert_eq!(read(again.as_slice()).expect("valid"), document);
                    }
                }
            }
        }
    }
    assert!(accepted > 100);
}
