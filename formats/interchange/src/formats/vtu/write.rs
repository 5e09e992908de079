//! VTK XML unstructured grid, with raw appended data.
//!
//! Format: "VTK File Formats", section "XML File Formats". Little-endian; each appended array is
//! preceded by its size in bytes as `UInt64`. Sizes are known beforehand, so arrays are streamed.
//! Field data: as in the legacy format (see [`crate::formats::vtk::fields`]), and `title` (see
//! [`crate::promise_title`]). Compressed arrays wait in a temporary file until their sizes are known.

use super::spool::Spool;
use crate::binary::Order;
use crate::formats::vtk::cells::{CellArray, Cells, Values};
use crate::formats::vtk::fields::{Names, names, texts};
use crate::sink::ByteSink;
use crate::stream::MeshStream;
use crate::text::one_line;
use crate::{WriteError, WriteOptions};
use quick_xml::escape::escape;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Cell types of first and second order.
const TRIANGLE: [u8; 2] = [5, 22];
const TETRA: [u8; 2] = [10, 24];

/// Name of the array of points' ids in the mesh that the file is a piece of.
const POINT_IDS: &str = "GlobalPointIds";

/// What the numbers of a file are.
struct Layout<'a> {
    mesh: &'a dyn MeshStream,
    cells: Cells,
    /// Integers of 32 bits where they suffice for connectivity and offsets, else of 64.
    wide: bool,
}

/// An array of the file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Array {
    Points,
    Connectivity,
    Offsets,
    Types,
    Cell(CellArray),
    PointIds,
}

impl<'a> Layout<'a> {
    fn new(mesh: &'a dyn MeshStream, boundary: bool) -> Self {
        let cells = Cells::of(mesh, boundary);
        let [tet, triangle] = cells.corners(mesh);
        let corners = tet * cells.tets + triangle * cells.triangles;
        Self {
            mesh,
            cells,
            wide: corners.max(mesh.point_count()) > i32::MAX as u64,
        }
    }

    fn arrays(&self) -> Vec<Array> {
        let mut all = vec![
            Array::Points,
            Array::Connectivity,
            Array::Offsets,
            Array::Types,
        ];
        all.extend(cell_arrays(self.cells).iter().map(|&a| Array::Cell(a)));
        if self.mesh.point_ids().is_some() {
            all.push(Array::PointIds);
        }
        all
    }

    /// VTK's name of the number type, name and number of components, and size in bytes.
    fn describe(&self, array: Array) -> (&'static str, &'static str, u64, u64) {
        let (integer, width) = if self.wide {
            ("Int64", 8)
        } else {
            ("Int32", 4)
        };
        let [tet, triangle] = self.cells.corners(self.mesh);
        let corners = tet * self.cells.tets + triangle * self.cells.triangles;
        let (points, count) = (self.mesh.point_count(), self.cells.count());
        match array {
            Array::Points => ("Float64", "Points", 3, 24 * points),
            Array::Connectivity => (integer, "connectivity", 1, width * corners),
            Array::Offsets => (integer, "offsets", 1, width * count),
            Array::Types => ("UInt8", "types", 1, count),
            Array::Cell(array) => ("Int32", array.name(), 1, 4 * count),
            Array::PointIds => ("Int64", POINT_IDS, 1, 8 * points),
        }
    }

    fn write(&self, array: Array, sink: &mut ByteSink<'_>) -> io::Result<()> {
        let (mesh, cells) = (self.mesh, self.cells);
        let second = usize::from(mesh.is_second_order());
        match array {
            Array::Points => mesh.points(&mut |points| sink.points(Order::Little, points)),
            Array::Connectivity => {
                mesh.tets(&mut |block| match second {
                    0 => sink.integers(self.wide, block.vertices.as_flattened()),
                    _ => sink.integers(self.wide, block.all_points().as_flattened()),
                })?;
                if cells.triangles == 0 {
                    return Ok(());
                }
                mesh.triangles(&mut |block| match second {
                    0 => sink.integers(self.wide, block.vertices.as_flattened()),
                    _ => sink.integers(self.wide, block.all_points().as_flattened()),
                })
            }
            Array::Offsets => self.write_offsets(sink),
            Array::Types => {
                sink.repeat([TETRA[second]], cells.tets)?;
                sink.repeat([TRIANGLE[second]], cells.triangles)
            }
            Array::Cell(array) => array.stream(mesh, cells, &mut |values| match values {
                Values::Each(values) => sink.u32s(Order::Little, values),
                Values::Same(value, count) => sink.repeat(value.to_le_bytes(), count),
            }),
            Array::PointIds => sink.integers(true, mesh.point_ids().unwrap_or_default()),
        }
    }

    /// Ends of the cells in the connectivity array.
    fn write_offsets(&self, sink: &mut ByteSink<'_>) -> io::Result<()> {
        let mut block = [0_u64; 4096];
        let mut end = 0;
        let [tet, triangle] = self.cells.corners(self.mesh);
        for (corners, count) in [(tet, self.cells.tets), (triangle, self.cells.triangles)] {
            let mut left = count;
            while left > 0 {
                let step = left.min(block.len() as u64) as usize;
                for offset in &mut block[..step] {
                    end += corners;
                    *offset = end;
                }
                sink.integers(self.wide, &block[..step])?;
                left -= step as u64;
            }
        }
        Ok(())
    }

    /// Everything before the numbers; `offsets` says where each array begins among them.
    fn header(&self, arrays: &[Array], offsets: &[u64], compressed: bool) -> String {
        let mut xml = String::new();
        let mesh = self.mesh;
        let compressor = if compressed {
            " compressor=\"vtkZLibDataCompressor\""
        } else {
            ""
        };
        let _ = writeln!(
            xml,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" \
             byte_order=\"LittleEndian\" header_type=\"UInt64\"{compressor}>\n  <UnstructuredGrid>"
        );
        xml += "    <FieldData>\n";
        text_array(&mut xml, "title", &one_line(&mesh.title()));
        for table in names(mesh, self.cells) {
            names_array(&mut xml, &table);
        }
        for (name, text) in texts(mesh) {
            text_array(&mut xml, name, &text);
        }
        xml += "    </FieldData>\n";
        let _ = writeln!(
            xml,
            "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">",
            mesh.point_count(),
            self.cells.count()
        );
        let mut open = "";
        for (&array, offset) in arrays.iter().zip(offsets) {
            let (section, attributes) = match array {
                Array::Points => ("Points", String::new()),
                Array::Connectivity | Array::Offsets | Array::Types => ("Cells", String::new()),
                Array::Cell(_) => ("CellData", " Scalars=\"region\"".to_owned()),
                Array::PointIds => ("PointData", format!(" GlobalIds=\"{POINT_IDS}\"")),
            };
            if section != open {
                if !open.is_empty() {
                    let _ = writeln!(xml, "      </{open}>");
                }
                let _ = writeln!(xml, "      <{section}{attributes}>");
                open = section;
            }
            let (kind, name, components, _) = self.describe(array);
            let _ = writeln!(
                xml,
                "        <DataArray type=\"{kind}\" Name=\"{name}\" \
                 NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>"
            );
        }
        let _ = writeln!(xml, "      </{open}>");
        xml += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
        xml
    }
}

fn cell_arrays(cells: Cells) -> &'static [CellArray] {
    if cells.triangles > 0 {
        &CellArray::ALL
    } else {
        &CellArray::ALL[..2]
    }
}

const FOOTER: &str = "\n  </AppendedData>\n</VTKFile>\n";

pub fn write(
    mesh: &dyn MeshStream,
    options: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let layout = Layout::new(mesh, options.boundary);
    let arrays = layout.arrays();
    let mut offsets = Vec::with_capacity(arrays.len());
    let mut offset = 0;
    if options.compress {
        let mut spool = Spool::new()?;
        for &array in &arrays {
            offsets.push(offset);
            spool.begin();
            let mut sink = ByteSink::new(&mut spool);
            layout.write(array, &mut sink)?;
            sink.finish()?;
            offset += spool.end()?;
        }
        out.write_all(layout.header(&arrays, &offsets, true).as_bytes())?;
        spool.write(out)?;
        out.write_all(FOOTER.as_bytes())?;
        return Ok(out.flush()?);
    }
    for &array in &arrays {
        offsets.push(offset);
        offset += 8 + layout.describe(array).3;
    }
    let mut sink = ByteSink::new(out);
    sink.text(&layout.header(&arrays, &offsets, false))?;
    for &array in &arrays {
        sink.bytes(&layout.describe(array).3.to_le_bytes())?;
        layout.write(array, &mut sink)?;
    }
    sink.text(FOOTER)?;
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, options: &WriteOptions) -> u64 {
    let layout = Layout::new(mesh, options.boundary);
    let arrays = layout.arrays();
    let size: u64 = arrays.iter().map(|&a| layout.describe(a).3).sum();
    if options.compress { size / 4 } else { size }
}

/// Writes the file that lists the pieces of a mesh. `piece` is any of them, which shows the arrays;
/// `sources` are their paths, seen from the file.
pub fn write_pieces(
    piece: &dyn MeshStream,
    boundary: bool,
    sources: &[String],
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let layout = Layout::new(piece, boundary);
    let mut xml = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" \
         byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  \
         <PUnstructuredGrid GhostLevel=\"0\">\n",
    );
    let mut section = |name: &str, attributes: &str, wanted: &dyn Fn(Array) -> bool| {
        let _ = writeln!(xml, "    <{name}{attributes}>");
        for array in layout.arrays().into_iter().filter(|&a| wanted(a)) {
            let (kind, name, components, _) = layout.describe(array);
            let _ = writeln!(
                xml,
                "      <PDataArray type=\"{kind}\" Name=\"{name}\" \
                 NumberOfComponents=\"{components}\"/>"
            );
        }
        let _ = writeln!(xml, "    </{name}>");
    };
    section("PPoints", "", &|a| a == Array::Points);
    section("PCellData", " Scalars=\"region\"", &|a| {
        matches!(a, Array::Cell(_))
    });
    let ids = format!(" GlobalIds=\"{POINT_IDS}\"");
    section("PPointData", &ids, &|a| a == Array::PointIds);
    for source in sources {
        let source = source
            .replace('&', "&amp;")
            .replace('"', "&quot;")
            .replace('<', "&lt;");
        let _ = writeln!(xml, "    <Piece Source=\"{source}\"/>");
    }
    xml += "  </PUnstructuredGrid>\n</VTKFile>\n";
    out.write_all(xml.as_bytes())?;
    Ok(out.flush()?)
}

/// Ids whose components are called by their names.
fn names_array(xml: &mut String, table: &Names) {
    let Names { array, ids, names } = table;
    let _ = write!(
        xml,
        "      <DataArray type=\"Int32\" Name=\"{array}\" NumberOfComponents=\"{}\"",
        ids.len()
    );
    for (i, name) in names.iter().enumerate() {
        let _ = write!(xml, " ComponentName{i}=\"{}\"", escape(name));
    }
    let ids: Vec<String> = ids.iter().map(|&id| (id as i32).to_string()).collect();
    let _ = writeln!(
        xml,
        " NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>",
        ids.join(" ")
    );
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
    use crate::stream::{Plain, test_document};

    fn with(boundary: bool) -> WriteOptions {
        WriteOptions {
            boundary,
            ..WriteOptions::default()
        }
    }

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
        write(&Plain::new(&document).unwrap(), &with(true), &mut bytes).unwrap();
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
        let expected = "NumberOfComponents=\"1\" ComponentName0=\"copper\" NumberOfTuples=\"1\" \
                        format=\"ascii\">7<";
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
        write(&Plain::new(&document).unwrap(), &with(false), &mut bytes).unwrap();
        let arrays = arrays_of(&bytes);
        assert_eq!(arrays.len(), 6);
        assert_eq!(arrays[3].2, [10]);
    }
}
