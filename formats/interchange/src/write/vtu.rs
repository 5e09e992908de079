//! VTK XML unstructured grid, with raw appended data.
//!
//! Format: "VTK File Formats", section "XML File Formats". Little-endian; each appended array is
//! preceded by its size in bytes as `UInt64`. Sizes are known beforehand, so arrays are streamed.
//! Field data: `title` (see [`crate::promise_title`]), and `region_ids`, `region_names` and the like
//! for markers and walls.

use super::WriteError;
use super::bytes::{ByteSink, Order};
use super::cells::{CellArray, Cells, Values};
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
    string_array(
        &mut xml,
        "title",
        &mut std::iter::once(mesh.title().as_str()),
    );
    let regions = &mut mesh.regions().iter().map(|r| (r.id, r.name.as_str()));
    names(&mut xml, "region", regions);
    if cells.triangles > 0 {
        let markers = &mut mesh.markers().iter().map(|m| (m.id, m.name.as_str()));
        names(&mut xml, "marker", markers);
        let walls = &mut (1..).zip(mesh.wall_names().iter().map(String::as_str));
        names(&mut xml, "wall", walls);
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

/// Arrays `<what>_ids` and `<what>_names`.
fn names(xml: &mut String, what: &str, entries: &mut dyn Iterator<Item = (u32, &str)>) {
    let (ids, names): (Vec<u32>, Vec<&str>) = entries.unzip();
    if ids.is_empty() {
        return;
    }
    let ids: Vec<String> = ids.iter().map(u32::to_string).collect();
    let _ = writeln!(
        xml,
        "      <DataArray type=\"UInt32\" Name=\"{what}_ids\" NumberOfTuples=\"{}\" \
         format=\"ascii\">{}</DataArray>",
        ids.len(),
        ids.join(" ")
    );
    string_array(xml, &format!("{what}_names"), &mut names.into_iter());
}

/// Strings as VTK wants them in ASCII data: the codes of their bytes, each string ended by 0.
fn string_array(xml: &mut String, name: &str, strings: &mut dyn Iterator<Item = &str>) {
    let (mut count, mut codes) = (0, String::new());
    for string in strings {
        count += 1;
        for byte in string.bytes().filter(|&b| b != 0).chain([0]) {
            let _ = write!(codes, "{byte} ");
        }
    }
    let _ = writeln!(
        xml,
        "      <DataArray type=\"String\" Name=\"{name}\" NumberOfTuples=\"{count}\" \
         format=\"ascii\">{}</DataArray>",
        codes.trim_end()
    );
}
