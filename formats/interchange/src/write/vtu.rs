//! VTK XML unstructured grid, with raw appended data.
//!
//! Format: "VTK File Formats", section "XML File Formats". Little-endian; each appended array is
//! preceded by its size in bytes as `UInt64`. Sizes are known beforehand, so arrays are streamed.
//! Field data, as in the legacy format: `region_names`, `marker_names`, `wall_names`, characters
//! with a line `id name` each; and `title` (see [`crate::promise_title`]).

use super::WriteError;
use super::bytes::{ByteSink, Order};
use super::cells::{CellArray, Cells, Values, name_fields, one_line};
use crate::MeshStream;
use std::fmt::Write as _;
use std::io::{self, Write};

const TRIANGLE: u8 = 5;
const TETRA: u8 = 10;

/// Integers of 32 bits where they suffice for connectivity and offsets, else of 64.
fn wide(mesh: &dyn MeshStream, cells: Cells) -> bool {
    let corners = 4 * cells.tets + 3 * cells.triangles;
    corners.max(mesh.point_count()) > i32::MAX as u64
}

fn arrays(cells: Cells) -> &'static [CellArray] {
    if cells.triangles > 0 {
        &CellArray::ALL
    } else {
        &CellArray::ALL[..2]
    }
}

pub fn write(mesh: &dyn MeshStream, boundary: bool, out: &mut dyn Write) -> Result<(), WriteError> {
    let cells = Cells::of(mesh, boundary);
    let wide = wide(mesh, cells);
    let mut sink = ByteSink::new(out);
    sink.text(&header(mesh, cells, wide))?;

    let width = if wide { 8 } else { 4 };
    sink.bytes(&(24 * mesh.point_count()).to_le_bytes())?;
    mesh.points(&mut |points| sink.points(Order::Little, points))?;

    sink.bytes(&(width * (4 * cells.tets + 3 * cells.triangles)).to_le_bytes())?;
    mesh.tets(&mut |block| sink.integers(wide, block.vertices.as_flattened()))?;
    if cells.triangles > 0 {
        mesh.triangles(&mut |block| sink.integers(wide, block.vertices.as_flattened()))?;
    }

    sink.bytes(&(width * cells.count()).to_le_bytes())?;
    write_offsets(cells, wide, &mut sink)?;

    sink.bytes(&cells.count().to_le_bytes())?;
    sink.repeat([TETRA], cells.tets)?;
    sink.repeat([TRIANGLE], cells.triangles)?;

    for array in arrays(cells) {
        sink.bytes(&(4 * cells.count()).to_le_bytes())?;
        array.stream(mesh, cells, &mut |values| match values {
            Values::Each(values) => sink.u32s(Order::Little, values),
            Values::Same(value, count) => sink.repeat(value.to_le_bytes(), count),
        })?;
    }
    sink.text("\n  </AppendedData>\n</VTKFile>\n")?;
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, boundary: bool) -> u64 {
    let cells = Cells::of(mesh, boundary);
    let width = if wide(mesh, cells) { 8 } else { 4 };
    24 * mesh.point_count()
        + width * (5 * cells.tets + 4 * cells.triangles)
        + (1 + 4 * arrays(cells).len() as u64) * cells.count()
}

/// Ends of the cells in the connectivity array.
fn write_offsets(cells: Cells, wide: bool, sink: &mut ByteSink<'_>) -> io::Result<()> {
    let mut block = [0_u64; 4096];
    let mut end = 0;
    for (corners, count) in [(4, cells.tets), (3, cells.triangles)] {
        let mut left = count;
        while left > 0 {
            let step = left.min(block.len() as u64) as usize;
            for offset in &mut block[..step] {
                end += corners;
                *offset = end;
            }
            sink.integers(wide, &block[..step])?;
            left -= step as u64;
        }
    }
    Ok(())
}

fn header(mesh: &dyn MeshStream, cells: Cells, wide: bool) -> String {
    let mut xml = String::new();
    let mut offset = 0_u64;
    let mut appended = |kind: &str, name: &str, components: u64, bytes: u64| {
        let line = format!(
            "        <DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{offset}\"/>\n"
        );
        offset += 8 + bytes;
        line
    };
    let (integer, width) = if wide { ("Int64", 8) } else { ("Int32", 4) };
    let corners = 4 * cells.tets + 3 * cells.triangles;
    xml += "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" \
            byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n";
    xml += "    <FieldData>\n";
    text_array(&mut xml, "title", &one_line(&mesh.title()));
    for (name, text) in name_fields(mesh, cells) {
        text_array(&mut xml, name, &text);
    }
    xml += "    </FieldData>\n";
    let _ = writeln!(
        xml,
        "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">",
        mesh.point_count(),
        cells.count()
    );
    xml += "      <Points>\n";
    xml += &appended("Float64", "Points", 3, 24 * mesh.point_count());
    xml += "      </Points>\n      <Cells>\n";
    xml += &appended(integer, "connectivity", 1, width * corners);
    xml += &appended(integer, "offsets", 1, width * cells.count());
    xml += &appended("UInt8", "types", 1, cells.count());
    xml += "      </Cells>\n      <CellData Scalars=\"region\">\n";
    for array in arrays(cells) {
        xml += &appended("Int32", array.name(), 1, 4 * cells.count());
    }
    xml += "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n  \
            <AppendedData encoding=\"raw\">\n_";
    xml
}

/// Text as the codes of its bytes: not every reader knows arrays of strings.
fn text_array(xml: &mut String, name: &str, text: &str) {
    let codes: Vec<String> = text.bytes().map(|b| b.to_string()).collect();
    let _ = writeln!(
        xml,
        "      <DataArray type=\"UInt8\" Name=\"{name}\" NumberOfTuples=\"{}\" \
         format=\"ascii\">{}</DataArray>",
        codes.len(),
        codes.join(" ")
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::plain::Plain;
    use crate::write::test_document;

    /// Type, name and raw values of every appended array, found by its offset as a reader would.
    fn arrays_of(bytes: &[u8]) -> Vec<(String, String, Vec<u8>)> {
        let mark = b"<AppendedData encoding=\"raw\">\n_";
        let begin = bytes.windows(mark.len()).position(|w| w == mark).unwrap();
        let xml = std::str::from_utf8(&bytes[..begin]).unwrap();
        let data = &bytes[begin + mark.len()..];
        let attribute = |line: &str, name: &str| {
            let from = line.split_once(&format!("{name}=\"")).unwrap().1;
            from.split_once('"').unwrap().0.to_owned()
        };
        let mut end = 0;
        let found = xml
            .lines()
            .filter(|line| line.contains("appended"))
            .map(|line| {
                let offset: usize = attribute(line, "offset").parse().unwrap();
                assert_eq!(offset, end, "arrays follow each other");
                let size = u64::from_le_bytes(data[offset..offset + 8].try_into().unwrap());
                end = offset + 8 + size as usize;
                let values = data[offset + 8..end].to_vec();
                (attribute(line, "type"), attribute(line, "Name"), values)
            })
            .collect();
        assert_eq!(&data[end..], b"\n  </AppendedData>\n</VTKFile>\n");
        found
    }

    fn integers(bytes: &[u8]) -> Vec<i32> {
        let words = bytes.as_chunks::<4>().0;
        words.iter().map(|&w| i32::from_le_bytes(w)).collect()
    }

    #[test]
    fn arrays_are_where_the_header_says() {
        let document = test_document();
        let mut bytes = Vec::new();
        write(&Plain::new(&document).unwrap(), true, &mut bytes).unwrap();
        let arrays = arrays_of(&bytes);
        let names: Vec<&str> = arrays.iter().map(|a| a.1.as_str()).collect();
        let expected = [
            "Points",
            "connectivity",
            "offsets",
            "types",
            "region",
            "instance",
            "marker",
            "wall",
            "front",
            "back",
        ];
        assert_eq!(names, expected);
        let points: Vec<f64> = arrays[0]
            .2
            .as_chunks()
            .0
            .iter()
            .map(|&b| f64::from_le_bytes(b))
            .collect();
        assert_eq!(points, [1., 0., 0., 2., 0., 0., 1., 1., 0., 1., 0., 1.]);
        let connectivity = [0, 1, 2, 3, 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
        assert_eq!(integers(&arrays[1].2), connectivity);
        assert_eq!(integers(&arrays[2].2), [4, 7, 10, 13, 16]);
        assert_eq!(arrays[3].2, [10, 5, 5, 5, 5]);
        assert_eq!(integers(&arrays[4].2), [7; 5]);
        assert_eq!(integers(&arrays[6].2), [-1, 0, 2, 2, 2]);
        assert_eq!(integers(&arrays[7].2), [-1, 1, 0, 0, 0]);
        let expected = "NumberOfTuples=\"9\" format=\"ascii\">55 32 99 111 112 112 101 114 10<";
        assert!(
            bytes
                .escape_ascii()
                .to_string()
                .contains(&expected.escape_default().to_string())
        );
    }

    #[test]
    fn only_tetrahedra_unless_asked_for() {
        let document = test_document();
        let mut bytes = Vec::new();
        write(&Plain::new(&document).unwrap(), false, &mut bytes).unwrap();
        let arrays = arrays_of(&bytes);
        assert_eq!(arrays.len(), 6);
        assert_eq!(arrays[3].2, [10]);
    }
}
