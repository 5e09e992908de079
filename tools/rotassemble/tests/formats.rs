//! The bytes of assembled meshes, read back.

mod common;

use bodies::structured::Structured;
use common::{Mesh, gather};
use glam::DVec3;
use interchange::{Format, MeshStream, Surface, WriteOptions, parse_promise};
use rotassemble::{Assembled, sector, write_expanded};
use tmesh::{Document, Frame, HistoryEntry, OUTSIDE};

fn document() -> Document {
    let wedge = Structured {
        order: 5,
        mirror: true,
        flip: false,
        bore: 0.0,
        radius: 2.0,
        cells: [4, 2, 2],
    };
    let mut document = wedge.document();
    document.frame = Frame::from_axis(
        DVec3::new(0.1, 0.2, 0.3),
        DVec3::new(1.0, -2.0, 0.5),
        DVec3::Z,
    )
    .unwrap();
    document.history.push(HistoryEntry {
        tool: "wedgecut".to_owned(),
        version: "1".to_owned(),
        arguments: Vec::new(),
        notes: Vec::new(),
    });
    document
}

fn written(mesh: &dyn MeshStream, format: Format, options: &WriteOptions) -> Vec<u8> {
    let mut bytes = Vec::new();
    interchange::write(mesh, format, options, &mut bytes).unwrap();
    bytes
}

/// What follows the first line that begins with `word`, and that line.
fn section<'a>(bytes: &'a [u8], word: &str) -> (String, &'a [u8]) {
    let begin = format!("\n{word}");
    let at = bytes
        .windows(begin.len())
        .position(|w| w == begin.as_bytes())
        .unwrap_or_else(|| panic!("no {word}"));
    let line = &bytes[at + 1..];
    let end = line.iter().position(|&b| b == b'\n').unwrap();
    (
        String::from_utf8(line[..end].to_vec()).unwrap(),
        &line[end + 1..],
    )
}

fn big_endian(bytes: &[u8], count: usize) -> Vec<u32> {
    let words = bytes[..4 * count].as_chunks::<4>().0;
    words.iter().map(|&w| u32::from_be_bytes(w)).collect()
}

#[test]
fn legacy_vtk_holds_the_mesh() {
    let document = document();
    let assembled = Assembled::new(&document).unwrap();
    let mesh = gather(&assembled);
    let bytes = written(&assembled, Format::Vtk, &WriteOptions::default());
    let (points, tets) = (mesh.points.len(), mesh.tets.len());
    let title = String::from_utf8_lossy(&bytes)
        .lines()
        .nth(1)
        .unwrap()
        .to_owned();
    let promise = parse_promise(&title).unwrap();
    assert_eq!(promise.group.symbol(), "C5v");
    assert_eq!(promise.origin, [0.1, 0.2, 0.3]);

    let (line, data) = section(&bytes, "POINTS");
    assert_eq!(line, format!("POINTS {points} double"));
    let numbers = data[..24 * points]
        .as_chunks::<8>()
        .0
        .iter()
        .map(|&b| f64::from_be_bytes(b));
    assert!(numbers.eq(mesh.points.iter().flat_map(|p| p.to_array())));
    let (line, data) = section(&bytes, "CELLS");
    assert_eq!(line, format!("CELLS {tets} {}", 5 * tets));
    let cells: Vec<u32> = mesh
        .tets
        .iter()
        .flat_map(|t| std::iter::once(4).chain(t.vertices))
        .collect();
    assert_eq!(big_endian(data, 5 * tets), cells);
    let (_, data) = section(&bytes, "CELL_TYPES");
    assert_eq!(big_endian(data, tets), vec![10; tets]);
    let (_, data) = section(&bytes, "LOOKUP_TABLE default");
    let regions: Vec<u32> = mesh.tets.iter().map(|t| t.region).collect();
    assert_eq!(big_endian(data, tets), regions);
    assert_eq!(&data[4 * tets..], b"\n");
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let document = document();
    for format in [Format::Vtk, Format::Vtu, Format::Stl] {
        let options = WriteOptions {
            boundary: true,
            surface: Surface::All,
            ..WriteOptions::default()
        };
        let [a, b] = [0; 2].map(|_| written(&Assembled::new(&document).unwrap(), format, &options));
        assert!(a == b);
    }
}

#[test]
fn expanded_documents_are_valid_and_hold_the_mesh() {
    let document = document();
    let assembled = Assembled::new(&document).unwrap();
    let mesh = gather(&assembled);
    let mut bytes = Vec::new();
    write_expanded(&assembled, &document, &mut bytes).unwrap();
    let expanded = tmesh::read(bytes.as_slice()).unwrap();
    assert!(expanded.is_plain() && expanded.frame.is_identity());
    let template = &expanded.templates[0];
    let read = Mesh {
        points: template.vertices.clone(),
        tets: template.tets.clone(),
        triangles: template.triangles.clone(),
    };
    assert!(read == mesh);
    assert_eq!(expanded.regions, document.regions);
    assert_eq!(expanded.markers, document.markers);
    assert_eq!(expanded.history, document.history);
    assert_eq!(expanded.symmetry, document.symmetry);
    assert_eq!(expanded.promise.as_ref(), Some(assembled.promise()));
    // Written as any document is.
    let mut again = Vec::new();
    let expanded = tmesh::read(bytes.as_slice()).unwrap();
    tmesh::write(&expanded, &mut again).unwrap();
    assert!(bytes == again);
}

#[test]
fn stl_of_the_boundary_bounds_the_volume() {
    let document = document();
    let assembled = Assembled::new(&document).unwrap();
    let mesh = gather(&assembled);
    let bytes = written(&assembled, Format::Stl, &WriteOptions::default());
    let (records, _) = bytes[84..].as_chunks::<50>();
    let sides = |t: &&tmesh::Triangle| (t.front == OUTSIDE) != (t.back == OUTSIDE);
    assert_eq!(records.len(), mesh.triangles.iter().filter(sides).count());
    let mut volume = 0.0;
    for record in records {
        let words = record[12..48].as_chunks::<4>().0;
        let x: Vec<f64> = words
            .iter()
            .map(|&w| f64::from(f32::from_le_bytes(w)))
            .collect();
        let [a, b, c] = [0, 3, 6].map(|i| DVec3::new(x[i], x[i + 1], x[i + 2]));
        volume += a.dot(b.cross(c)) / 6.0;
    }
    let expected: f64 = document.regions.iter().map(|r| mesh.volume(r.id)).sum();
    assert!((volume - expected).abs() < 1e-6 * expected);
}

#[test]
fn a_sector_keeps_its_walls() {
    let whole = document();
    let one = sector(whole.clone());
    assert_eq!(tmesh::validate(&one), []);
    assert_eq!(one.templates, whole.templates);
    assert_eq!(one.frame, whole.frame);
    assert!(one.is_plain());
}
