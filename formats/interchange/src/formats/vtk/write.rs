//! Legacy VTK, version 3.0, binary, unstructured grid.
//!
//! Format: "VTK File Formats", section "Simple Legacy Formats". All numbers are big-endian. Cell
//! arrays are signed 32-bit integers; ids above 2^31 - 1 wrap around, so that -1 stands for
//! [`tmesh::OUTSIDE`]. The title is that of [`crate::promise_title`]. Names and what is
//! known of the symmetry are the dataset's field data, see [`super::fields`]; names are the components' names in
//! the array's metadata, with `%20` for a blank as VTK writes it.

use super::cells::{CellArray, Cells, Values};
use super::fields::{Names, names, texts};
use crate::binary::Order;
use crate::sink::ByteSink;
use crate::stream::MeshStream;
use crate::text::one_line;
use crate::{WriteError, WriteOptions};
use std::io::Write;

/// Cell types of first and second order.
const TRIANGLE: [u32; 2] = [5, 22];
const TETRA: [u32; 2] = [10, 24];
const LIMIT: u64 = i32::MAX as u64;

pub fn write(
    mesh: &dyn MeshStream,
    options: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let cells = Cells::of(mesh, options.boundary);
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
    write_fields(mesh, cells, &mut sink)?;

    sink.text(&format!("POINTS {} double\n", mesh.point_count()))?;
    mesh.points(&mut |points| sink.points(Order::Big, points))?;
    let second = usize::from(mesh.is_second_order());
    let [tet, triangle] = cells.corners(mesh);
    let integers = (tet + 1) * cells.tets + (triangle + 1) * cells.triangles;
    sink.text(&format!("\nCELLS {} {integers}\n", cells.count()))?;
    mesh.tets(&mut |block| match second {
        0 => sink.counted::<4, 20>(block.vertices),
        _ => sink.counted::<10, 44>(&block.all_points()),
    })?;
    if cells.triangles > 0 {
        mesh.triangles(&mut |block| match second {
            0 => sink.counted::<3, 16>(block.vertices),
            _ => sink.counted::<6, 28>(&block.all_points()),
        })?;
    }
    sink.text(&format!("\nCELL_TYPES {}\n", cells.count()))?;
    sink.repeat(TETRA[second].to_be_bytes(), cells.tets)?;
    sink.repeat(TRIANGLE[second].to_be_bytes(), cells.triangles)?;

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

pub fn size_estimate(mesh: &dyn MeshStream, options: &WriteOptions) -> u64 {
    let cells = Cells::of(mesh, options.boundary);
    let arrays = if cells.triangles > 0 { 6 } else { 1 };
    let [tet, triangle] = cells.corners(mesh);
    24 * mesh.point_count()
        + 4 * (tet + 2) * cells.tets
        + 4 * (triangle + 2) * cells.triangles
        + 4 * arrays * cells.count()
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

fn write_fields(
    mesh: &dyn MeshStream,
    cells: Cells,
    sink: &mut ByteSink<'_>,
) -> Result<(), WriteError> {
    let (names, texts) = (names(mesh, cells), texts(mesh));
    if names.is_empty() && texts.is_empty() {
        return Ok(());
    }
    sink.text(&format!("FIELD FieldData {}\n", names.len() + texts.len()))?;
    for Names { array, ids, names } in names {
        sink.text(&format!("{array} {} 1 int\n", ids.len()))?;
        sink.u32s(Order::Big, &ids)?;
        sink.text("\nMETADATA\nCOMPONENT_NAMES\n")?;
        for name in names {
            sink.text(&escaped(&name))?;
            sink.text("\n")?;
        }
        sink.text("\n")?;
    }
    for (array, text) in texts {
        sink.text(&format!("{array} 1 {} unsigned_char\n{text}\n", text.len()))?;
    }
    Ok(())
}

/// A name as VTK writes it: what is no printable character of ASCII, quotes and `%` as `%` and two digits. An
/// empty name is a blank, for an empty line ends the metadata.
fn escaped(name: &str) -> String {
    let name = if name.is_empty() { " " } else { name };
    let mut text = String::with_capacity(name.len());
    for byte in name.bytes() {
        if byte.is_ascii_graphic() && !matches!(byte, b'"' | b'%') {
            text.push(char::from(byte));
        } else {
            text += &format!("%{byte:02X}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::{Plain, test_document};

    fn with(boundary: bool) -> WriteOptions {
        WriteOptions {
            boundary,
            ..WriteOptions::default()
        }
    }

    fn written(boundary: bool) -> Vec<u8> {
        let document = test_document();
        let mut bytes = Vec::new();
        write(&Plain::new(&document).unwrap(), &with(boundary), &mut bytes).unwrap();
        bytes
    }

    /// Text and big-endian words, as the format wants them.
    fn golden(parts: &[(&str, &[u32])]) -> Vec<u8> {
        let mut bytes = Vec::new();
        for (text, words) in parts {
            bytes.extend(text.as_bytes());
            bytes.extend(words.iter().flat_map(|w| w.to_be_bytes()));
        }
        bytes
    }

    /// High words of 0.0, 1.0 and 2.0, whose low words are zero.
    const O: u32 = 0;
    const I: u32 = 0x3FF0_0000;
    const II: u32 = 0x4000_0000;
    const HEAD: &str = "# vtk DataFile Version 3.0\nsymtet mesh\nBINARY\n\
                        DATASET UNSTRUCTURED_GRID\n";
    #[rustfmt::skip]
    const POINTS: [u32; 24] = [
        I, 0, O, 0, O, 0,  II, 0, O, 0, O, 0,  I, 0, I, 0, O, 0,  I, 0, O, 0, I, 0,
    ];

    #[test]
    fn bytes_of_a_tetrahedron() {
        let expected = golden(&[
            (HEAD, &[]),
            ("FIELD FieldData 1\nregion_names 1 1 int\n", &[7]),
            ("\nMETADATA\nCOMPONENT_NAMES\ncopper\n\n", &[]),
            ("POINTS 4 double\n", &POINTS),
            ("\nCELLS 1 5\n", &[4, 0, 1, 2, 3]),
            ("\nCELL_TYPES 1\n", &[10]),
            (
                "\nCELL_DATA 1\nSCALARS region int 1\nLOOKUP_TABLE default\n",
                &[7],
            ),
            ("\n", &[]),
        ]);
        assert_eq!(
            written(false).escape_ascii().to_string(),
            expected.escape_ascii().to_string()
        );
    }

    #[test]
    fn bytes_of_a_tetrahedron_with_its_surface() {
        const NO: u32 = u32::MAX;
        let cells = [
            4, 0, 1, 2, 3, 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2,
        ];
        let expected = golden(&[
            (HEAD, &[]),
            ("FIELD FieldData 3\nregion_names 1 1 int\n", &[7]),
            ("\nMETADATA\nCOMPONENT_NAMES\ncopper\n\n", &[]),
            ("marker_names 1 1 int\n", &[2]),
            ("\nMETADATA\nCOMPONENT_NAMES\ntop\n\n", &[]),
            ("wall_names 1 1 int\n", &[1]),
            ("\nMETADATA\nCOMPONENT_NAMES\nfloor\n\n", &[]),
            ("POINTS 4 double\n", &POINTS),
            ("\nCELLS 5 21\n", &cells),
            ("\nCELL_TYPES 5\n", &[10, 5, 5, 5, 5]),
            (
                "\nCELL_DATA 5\nSCALARS region int 1\nLOOKUP_TABLE default\n",
                &[7; 5],
            ),
            ("\nFIELD FieldData 5\ninstance 1 5 int\n", &[0; 5]),
            ("\nmarker 1 5 int\n", &[NO, 0, 2, 2, 2]),
            ("\nwall 1 5 int\n", &[NO, 1, 0, 0, 0]),
            ("\nfront 1 5 int\n", &[NO; 5]),
            ("\nback 1 5 int\n", &[NO, 7, 7, 7, 7]),
            ("\n", &[]),
        ]);
        assert_eq!(
            written(true).escape_ascii().to_string(),
            expected.escape_ascii().to_string()
        );
    }

    #[test]
    fn without_tetrahedra_the_triangles_are_written() {
        let mut document = test_document();
        document.templates[0].tets.clear();
        let mut bytes = Vec::new();
        write(&Plain::new(&document).unwrap(), &with(false), &mut bytes).unwrap();
        let text = bytes.escape_ascii().to_string();
        assert!(text.contains("CELLS 4 16"), "{text}");
        assert!(text.contains("marker 1 4 int"), "{text}");
    }

    /// Claims more points than the format can number.
    struct Huge<'a>(Plain<'a>);

    impl MeshStream for Huge<'_> {
        fn title(&self) -> String {
            self.0.title()
        }
        fn point_count(&self) -> u64 {
            1 << 31
        }
        fn tet_count(&self) -> u64 {
            self.0.tet_count()
        }
        fn triangle_count(&self) -> u64 {
            self.0.triangle_count()
        }
        fn regions(&self) -> &[tmesh::Region] {
            self.0.regions()
        }
        fn markers(&self) -> &[tmesh::Marker] {
            self.0.markers()
        }
        fn wall_names(&self) -> &[String] {
            self.0.wall_names()
        }
        fn points(&self, _: &mut crate::PointSink<'_>) -> std::io::Result<()> {
            unreachable!("refused before")
        }
        fn tets(&self, _: &mut crate::TetSink<'_>) -> std::io::Result<()> {
            unreachable!("refused before")
        }
        fn tet_regions(&self, _: &mut crate::TetRegionSink<'_>) -> std::io::Result<()> {
            unreachable!("refused before")
        }
        fn triangles(&self, _: &mut crate::TriangleSink<'_>) -> std::io::Result<()> {
            unreachable!("refused before")
        }
        fn facets(&self, _: &mut crate::TriangleSink<'_>) -> std::io::Result<()> {
            unreachable!("refused before")
        }
        fn patches(&self) -> &[crate::Patch] {
            self.0.patches()
        }
        fn patch(&self, _: usize, _: bool, _: &mut crate::PatchSink<'_>) -> std::io::Result<()> {
            unreachable!("refused before")
        }
    }

    #[test]
    fn too_many_points_are_refused_before_a_byte_is_written() {
        let document = test_document();
        let mut bytes = Vec::new();
        let error = write(
            &Huge(Plain::new(&document).unwrap()),
            &with(false),
            &mut bytes,
        )
        .unwrap_err();
        assert_eq!(
            error.to_string(),
            "the mesh has 2147483648 points, and vtk counts no further than 2147483647"
        );
        assert!(bytes.is_empty());
    }
}
