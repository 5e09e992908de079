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
