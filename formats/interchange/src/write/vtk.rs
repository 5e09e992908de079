//! Legacy VTK, version 3.0, binary, unstructured grid.
//!
//! Format: "VTK File Formats", section "Simple Legacy Formats". All numbers are big-endian. Cell
//! arrays are signed 32-bit integers; ids above 2^31 - 1 wrap around, so that -1 stands for
//! [`tmesh::OUTSIDE`]. The title is that of [`crate::promise_title`]. Names of regions, markers and
//! walls are the dataset's field data `region_names`, `marker_names` and `wall_names`: characters,
//! one line per name, each `id name`.

use super::WriteError;
use super::bytes::{ByteSink, Order};
use super::cells::{CellArray, Cells, Values, name_fields, one_line};
use crate::MeshStream;
use std::io::Write;

const TRIANGLE: u32 = 5;
const TETRA: u32 = 10;
const LIMIT: u64 = i32::MAX as u64;

pub fn write(mesh: &dyn MeshStream, boundary: bool, out: &mut dyn Write) -> Result<(), WriteError> {
    let cells = Cells::of(mesh, boundary);
    for (what, count) in [("points", mesh.point_count()), ("cells", cells.count())] {
        if count > LIMIT {
            return Err(WriteError::TooLarge {
                format: "vtk",
                what,
                count,
                limit: LIMIT,
            });
        }
    }
    let mut sink = ByteSink::new(out);
    sink.text("# vtk DataFile Version 3.0\n")?;
    sink.text(&one_line(&mesh.title()))?;
    sink.text("\nBINARY\nDATASET UNSTRUCTURED_GRID\n")?;
    write_names(mesh, cells, &mut sink)?;

    sink.text(&format!("POINTS {} double\n", mesh.point_count()))?;
    mesh.points(&mut |points| sink.points(Order::Big, points))?;
    let integers = 5 * cells.tets + 4 * cells.triangles;
    sink.text(&format!("\nCELLS {} {integers}\n", cells.count()))?;
    mesh.tets(&mut |block| sink.counted::<4, 20>(block.vertices))?;
    if cells.triangles > 0 {
        mesh.triangles(&mut |block| sink.counted::<3, 16>(block.vertices))?;
    }
    sink.text(&format!("\nCELL_TYPES {}\n", cells.count()))?;
    sink.repeat(TETRA.to_be_bytes(), cells.tets)?;
    sink.repeat(TRIANGLE.to_be_bytes(), cells.triangles)?;

    sink.text(&format!("\nCELL_DATA {}\n", cells.count()))?;
    sink.text("SCALARS region int 1\nLOOKUP_TABLE default\n")?;
    write_array(mesh, cells, CellArray::Region, &mut sink)?;
    if cells.triangles > 0 {
        let arrays = &CellArray::ALL[1..];
        sink.text(&format!("FIELD FieldData {}\n", arrays.len()))?;
        for &array in arrays {
            sink.text(&format!("{} 1 {} int\n", array.name(), cells.count()))?;
            write_array(mesh, cells, array, &mut sink)?;
        }
    }
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, boundary: bool) -> u64 {
    let cells = Cells::of(mesh, boundary);
    let arrays = if cells.triangles > 0 { 6 } else { 1 };
    24 * mesh.point_count() + 24 * cells.tets + 20 * cells.triangles + 4 * arrays * cells.count()
}

fn write_array(
    mesh: &dyn MeshStream,
    cells: Cells,
    array: CellArray,
    sink: &mut ByteSink<'_>,
) -> Result<(), WriteError> {
    array.stream(mesh, cells, &mut |values| match values {
        Values::Each(values) => sink.u32s(Order::Big, values),
        Values::Same(value, count) => sink.repeat(value.to_be_bytes(), count),
    })?;
    Ok(sink.text("\n")?)
}

fn write_names(
    mesh: &dyn MeshStream,
    cells: Cells,
    sink: &mut ByteSink<'_>,
) -> Result<(), WriteError> {
    let fields = name_fields(mesh, cells);
    if fields.is_empty() {
        return Ok(());
    }
    sink.text(&format!("FIELD FieldData {}\n", fields.len()))?;
    for (name, text) in fields {
        sink.text(&format!("{name} 1 {} unsigned_char\n{text}\n", text.len()))?;
    }
    Ok(())
}
