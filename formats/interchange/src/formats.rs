//! The table of all formats, and what asks it: names, extensions, sniffing, readers and writers.
//!
//! A new format is a folder with its reader and writer, an entry here, and tests.

mod bdf;
mod inp;
mod listing;
mod medit;
mod msh;
mod obj;
mod off;
mod ply;
mod polymesh;
mod stl;
mod su2;
mod tetgen;
mod unv;
mod vtk;
mod vtu;

pub use listing::write_text;
pub use vtu::write_pieces;

use crate::parsed::{Parsed, PointMesh};
use crate::stream::{MeshStream, Plain};
use crate::{ReadError, WriteError, WriteOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use tmesh::Document;

/// What is known of one format.
pub struct Entry {
    /// The name used with `--from` and `--to`, which is also the usual extension.
    pub name: &'static str,
    /// Other names and extensions.
    pub also: &'static [&'static str],
    /// Whether its bytes are not text.
    pub is_binary: bool,
    /// How its content shows.
    sniff: Sniff,
    /// Parses a whole file; none where the format is not for input.
    read: Option<Reader>,
    /// Parses the mesh of a whole file with the numbers at its points; none where the format has none, or they are not read.
    read_points: Option<PointReader>,
    /// How it is written.
    pub writer: Writer,
    /// Whether it has elements of second order.
    pub second_order: bool,
    /// Whether a body that is stored as a whole keeps the symmetry found in it.
    pub keeps_symmetry: bool,
    /// Whether it has conditions at mirror planes, [`WriteOptions::parities`].
    pub conditions: bool,
    /// Whether elements are listed in blocks of one region, so that meshes are best sorted by region.
    pub by_region: bool,
    /// Number of the first point and element.
    pub first_id: u64,
}

/// Parses a whole file.
type Reader = fn(&[u8]) -> Result<Parsed, ReadError>;
/// Parses the mesh of a whole file with the numbers at its points.
type PointReader = fn(&[u8]) -> Result<PointMesh, ReadError>;
/// Writes a mesh to one file.
type MeshWriter = fn(&dyn MeshStream, &WriteOptions, &mut dyn Write) -> Result<(), WriteError>;
/// Writes one of the files of a mesh, by position.
type PartWriter = fn(&dyn MeshStream, usize, &mut dyn Write) -> Result<(), WriteError>;
/// Bytes that are written, for progress bars: to within a few kilobytes where the format is binary and
/// not compressed.
type SizeEstimate = fn(&dyn MeshStream, &WriteOptions) -> u64;

/// How the first bytes of a file show its format.
enum Sniff {
    /// They do not.
    Never,
    /// Words or bytes that files of this format begin with, and no others.
    Signature(fn(&[u8]) -> bool),
    /// Statements or numbers such as files of this format begin with. Signatures go first.
    Likeness(fn(&[u8]) -> bool),
}

/// How a format is written.
pub enum Writer {
    /// Not at all.
    None,
    /// A document as it is, with its templates and instances.
    Document(fn(&Document, &mut dyn Write) -> Result<(), WriteError>),
    /// A mesh in one file.
    Mesh(MeshWriter, SizeEstimate),
    /// A mesh in files with these extensions.
    Parts(&'static [&'static str], PartWriter, SizeEstimate),
    /// A mesh in files with these names, in a folder of their own.
    Folder(&'static [&'static str], PartWriter),
    /// A file for every instance of a mesh, and one that lists them.
    Pieces,
}

/// An entry that says nothing.
const NOTHING: Entry = Entry {
    name: "",
    also: &[],
    is_binary: false,
    sniff: Sniff::Never,
    read: None,
    read_points: None,
    writer: Writer::None,
    second_order: true,
    keeps_symmetry: false,
    conditions: false,
    by_region: false,
    first_id: 0,
};

macro_rules! table {
    ($($(#[$doc:meta])* $format:ident { $($field:ident: $value:expr,)* })*) => {
        /// A format the tools can read or write, in the order they are listed to users.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Format {
            $($(#[$doc])* $format,)*
        }

        const COUNT: usize = [$(Format::$format),*].len();

        static TABLE: [Entry; COUNT] = [$(Entry { $($field: $value,)* ..NOTHING }),*];

        impl Format {
            /// All formats, in the order they are listed to users.
            pub const ALL: [Self; COUNT] = [$(Self::$format),*];
        }
    };
}

table! {
    /// The document itself.
    Tmesh {
        name: "tmesh",
        is_binary: true,
        sniff: Sniff::Signature(|head| head.starts_with(&tmesh::MAGIC)),
        read: Some(|bytes| Ok(Parsed::Document(Box::new(tmesh::read(bytes)?)))),
        writer: Writer::Document(|document, out| Ok(tmesh::write(document, out)?)),
        second_order: false,
    }
    /// Stereolithography, binary or ASCII, one or several solids.
    Stl {
        name: "stl",
        is_binary: true,
        sniff: Sniff::Likeness(stl::looks_like),
        read: Some(stl::read),
        writer: Writer::Mesh(stl::write, stl::size_estimate),
    }
    /// Wavefront OBJ.
    Obj {
        name: "obj",
        sniff: Sniff::Likeness(obj::looks_like),
        read: Some(obj::read),
    }
    /// Stanford PLY.
    Ply {
        name: "ply",
        sniff: Sniff::Signature(ply::looks_like),
        read: Some(ply::read),
    }
    /// Object File Format.
    Off {
        name: "off",
        sniff: Sniff::Likeness(off::looks_like),
        read: Some(off::read),
    }
    /// TetGen piecewise linear complex.
    Poly {
        name: "poly",
        sniff: Sniff::Likeness(tetgen::looks_like),
        read: Some(tetgen::read_poly),
    }
    /// TetGen surface mesh, which begins like a piecewise linear complex.
    Smesh {
        name: "smesh",
        sniff: Sniff::Likeness(tetgen::looks_like),
        read: Some(tetgen::read_smesh),
    }
    /// Legacy VTK.
    Vtk {
        name: "vtk",
        is_binary: true,
        sniff: Sniff::Signature(vtk::looks_like),
        read: Some(vtk::read),
        read_points: Some(vtk::read_points),
        writer: Writer::Mesh(vtk::write, vtk::size_estimate),
        keeps_symmetry: true,
    }
    /// VTK XML unstructured grid.
    Vtu {
        name: "vtu",
        is_binary: true,
        sniff: Sniff::Signature(vtu::looks_like),
        read: Some(vtu::read),
        read_points: Some(vtu::read_points),
        writer: Writer::Mesh(vtu::write, vtu::size_estimate),
        keeps_symmetry: true,
    }
    /// VTK XML unstructured grid in pieces, one per instance.
    Pvtu {
        name: "pvtu",
        writer: Writer::Pieces,
    }
    /// Gmsh, version 4.1.
    Msh {
        name: "msh",
        is_binary: true,
        sniff: Sniff::Signature(msh::looks_like),
        read: Some(msh::read),
        read_points: Some(msh::read_points),
        writer: Writer::Mesh(msh::write, msh::size_estimate),
        by_region: true,
        first_id: 1,
    }
    /// Gmsh, version 2.2, which is read as [`Format::Msh`] is.
    Msh2 {
        name: "msh2",
        is_binary: true,
        read: Some(msh::read),
        read_points: Some(msh::read_points),
        writer: Writer::Mesh(msh::write2, msh::size_estimate2),
        first_id: 1,
    }
    /// Medit.
    Medit {
        name: "mesh",
        writer: Writer::Mesh(medit::write, medit::size_estimate),
        second_order: false,
        first_id: 1,
    }
    /// Abaqus and CalculiX input.
    Inp {
        name: "inp",
        writer: Writer::Mesh(inp::write, inp::size_estimate),
        conditions: true,
        by_region: true,
        first_id: 1,
    }
    /// Nastran bulk data.
    Bdf {
        name: "bdf",
        also: &["nas"],
        sniff: Sniff::Likeness(bdf::looks_like),
        read: Some(bdf::read),
        writer: Writer::Mesh(bdf::write, bdf::size_estimate),
        first_id: 1,
    }
    /// TetGen mesh: files for nodes, elements and faces.
    Node {
        name: "node",
        also: &["ele", "face"],
        writer: Writer::Parts(&tetgen::PARTS, tetgen::write_part, tetgen::size_estimate),
        second_order: false,
        first_id: 1,
    }
    /// SU2.
    Su2 {
        name: "su2",
        writer: Writer::Mesh(su2::write, su2::size_estimate),
        second_order: false,
    }
    /// I-DEAS universal file.
    Unv {
        name: "unv",
        writer: Writer::Mesh(unv::write, unv::size_estimate),
        second_order: false,
        first_id: 1,
    }
    /// OpenFOAM, a folder of files.
    PolyMesh {
        name: "polymesh",
        writer: Writer::Folder(&polymesh::FILES, polymesh::write_file),
        second_order: false,
    }
    /// A readable listing of a document.
    Text {
        name: "txt",
        writer: Writer::Document(|document, out| Ok(listing::write_text(document, &[], out)?)),
        second_order: false,
    }
}

impl Format {
    /// What is known of the format.
    pub fn entry(self) -> &'static Entry {
        &TABLE[self as usize]
    }

    /// The name used with `--from` and `--to`, which is also the usual extension.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// The format with this name or extension, in any case.
    pub fn from_name(name: &str) -> Option<Self> {
        let is_called = |format: &Self| {
            let Entry {
                name: own, also, ..
            } = format.entry();
            let mut all = also.iter().chain([own]);
            all.any(|n| n.eq_ignore_ascii_case(name))
        };
        Self::ALL.into_iter().find(is_called)
    }

    /// The format a path's extension stands for; of a path without one, that of folders of this name.
    pub fn from_path(path: &Path) -> Option<Self> {
        match path.extension() {
            Some(extension) => Self::from_name(extension.to_str()?),
            None => {
                let named = Self::from_name(path.file_name()?.to_str()?);
                named.filter(|format| format.is_folder())
            }
        }
    }

    /// Whether a mesh is a folder of files.
    pub fn is_folder(self) -> bool {
        matches!(self.entry().writer, Writer::Folder(..))
    }

    /// Whether it can be read.
    pub fn is_input(self) -> bool {
        self.entry().read.is_some()
    }

    /// Whether it can be written.
    pub fn is_output(self) -> bool {
        !matches!(self.entry().writer, Writer::None)
    }

    /// Whether its bytes are not text.
    pub fn is_binary(self) -> bool {
        self.entry().is_binary
    }

    /// Whether a file holds a document as it is, with its templates and instances.
    pub fn holds_document(self) -> bool {
        matches!(self.entry().writer, Writer::Document(_))
    }

    /// Whether a file keeps the symmetry found in a body that is stored as a whole.
    pub fn keeps_symmetry(self) -> bool {
        self.entry().keeps_symmetry
    }
}

/// The format that the first bytes of a file show, if they show one, else the one that its path names.
///
/// `head` should be at least 1 KiB unless the file is shorter. Of formats that begin alike the path
/// tells which one it is; without it, it is the first one of the table.
pub fn sniff(head: &[u8], path: Option<&Path>) -> Option<Format> {
    let named = path.and_then(Format::from_path);
    let of = |fits: &dyn Fn(&Sniff) -> bool| {
        let fits = |format: &Format| fits(&format.entry().sniff);
        let named = named.filter(fits);
        named.or_else(|| Format::ALL.into_iter().find(fits))
    };
    of(&|sniff| matches!(sniff, Sniff::Signature(fits) if fits(head)))
        .or_else(|| of(&|sniff| matches!(sniff, Sniff::Likeness(fits) if fits(head))))
        .or(named)
}

/// Parses a whole file of the given format.
///
/// # Errors
/// Malformed bytes, and formats that are not for input.
pub fn parse(bytes: &[u8], format: Format) -> Result<Parsed, ReadError> {
    match format.entry().read {
        Some(read) => read(bytes),
        None => Err(ReadError::NotAnInput(format.name())),
    }
}

/// Parses the mesh of a whole file of the given format with the numbers at its points.
///
/// # Errors
/// Malformed bytes, and formats without such numbers.
pub fn parse_points(bytes: &[u8], format: Format) -> Result<PointMesh, ReadError> {
    match format.entry().read_points {
        Some(read) => read(bytes),
        None => Err(ReadError::NoPointData(format.name())),
    }
}

/// Writes a mesh in a foreign format.
///
/// # Errors
/// Fails when writing fails, when the format is not for output, and when it cannot hold the mesh.
pub fn write(
    mesh: &dyn MeshStream,
    format: Format,
    options: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    match format.entry().writer {
        Writer::Mesh(write, _) => {
            check_order(mesh, format)?;
            write(mesh, options, out)
        }
        Writer::Parts(..) | Writer::Folder(..) | Writer::Pieces => {
            Err(WriteError::SeveralFiles(format.name()))
        }
        Writer::None | Writer::Document(_) => Err(WriteError::NotAnOutput(format.name())),
    }
}

fn check_order(mesh: &dyn MeshStream, format: Format) -> Result<(), WriteError> {
    if mesh.is_second_order() && !format.entry().second_order {
        return Err(WriteError::NoSecondOrder(format.name()));
    }
    Ok(())
}

/// The files that a mesh in this format, written to `path`, consists of: beside the path with other
/// extensions, or in the folder that the path names. None for formats that are one file, or whose files are
/// not known beforehand.
pub fn file_parts(format: Format, path: &Path) -> Vec<PathBuf> {
    match format.entry().writer {
        Writer::Parts(extensions, ..) => {
            extensions.iter().map(|e| path.with_extension(e)).collect()
        }
        Writer::Folder(names, _) => names.iter().map(|name| path.join(name)).collect(),
        _ => Vec::new(),
    }
}

/// Writes one of the files that a mesh consists of, by its position in [`file_parts`].
///
/// # Errors
/// As [`write()`].
pub fn write_part(
    mesh: &dyn MeshStream,
    format: Format,
    part: usize,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    match format.entry().writer {
        Writer::Parts(_, write, _) | Writer::Folder(_, write) => {
            check_order(mesh, format)?;
            write(mesh, part, out)
        }
        _ => Err(WriteError::NotAnOutput(format.name())),
    }
}

/// Bytes that [`write()`] produces, for progress bars: to within a few kilobytes where the format is
/// binary and not compressed.
pub fn size_estimate(mesh: &dyn MeshStream, format: Format, options: &WriteOptions) -> u64 {
    match format.entry().writer {
        Writer::Mesh(_, size) | Writer::Parts(_, _, size) => size(mesh, options),
        _ => 0,
    }
}

/// Writes a document as it is, in any output format: in full as tmesh, as a listing, or each
/// template once (see [`Plain`]) in a foreign format, with its surface and all cell arrays.
///
/// # Errors
/// As [`write()`].
pub fn write_document(
    document: &Document,
    format: Format,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let options = WriteOptions {
        boundary: true,
        ..WriteOptions::default()
    };
    match format.entry().writer {
        Writer::Document(write) => write(document, out),
        _ => write(&Plain::new(document)?, format, &options, out),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::test_document;

    #[test]
    fn every_output_format_takes_every_document() {
        let document = test_document();
        assert_eq!(tmesh::validate(&document), []);
        for format in Format::ALL {
            let mut bytes = Vec::new();
            let result = write_document(&document, format, &mut bytes);
            match format {
                Format::Tmesh
                | Format::Text
                | Format::Vtk
                | Format::Vtu
                | Format::Stl
                | Format::Msh
                | Format::Msh2
                | Format::Medit
                | Format::Bdf
                | Format::Su2
                | Format::Unv
                | Format::Inp => {
                    result.unwrap();
                    assert!(!bytes.is_empty());
                }
                Format::Node | Format::Pvtu | Format::PolyMesh => {
                    let error = result.unwrap_err().to_string();
                    assert!(error.contains("several files"), "{error}");
                    assert!(bytes.is_empty());
                }
                _ => {
                    let name = format.name();
                    let error = result.unwrap_err().to_string();
                    assert_eq!(error, format!("{name} is not an output format"));
                    assert!(bytes.is_empty());
                }
            }
        }
    }

    #[test]
    fn sizes_are_estimated_well() {
        let document = test_document();
        let mesh = Plain::new(&document).unwrap();
        for format in [
            Format::Vtk,
            Format::Vtu,
            Format::Stl,
            Format::Msh,
            Format::Msh2,
        ] {
            for boundary in [false, true] {
                let options = WriteOptions {
                    boundary,
                    ..WriteOptions::default()
                };
                let mut bytes = Vec::new();
                write(&mesh, format, &options, &mut bytes).unwrap();
                let estimate = size_estimate(&mesh, format, &options);
                assert!(bytes.len() as u64 >= estimate && bytes.len() as u64 <= estimate + 4096);
            }
        }
    }

    const HEAD: &str = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n\
                        0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\n";

    #[test]
    fn numbers_at_points_of_all_cells_are_read() {
        // A voxel, a triangle of second order, a line; arrays on cells, and of several components.
        let text = format!(
            "{HEAD}CELLS 3 19\n8 0 1 2 3 4 5 6 7\n6 0 1 2 3 4 5\n2 0 1\nCELL_TYPES 3\n11 22 3\n\
             CELL_DATA 3\nSCALARS h int 1\nLOOKUP_TABLE default\n7 7 7\n\
             POINT_DATA 8\nSCALARS h float\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n\
             FIELD FieldData 2\na%20b 1 8 double\n8 7 6 5 4 3 2 1\nxy 2 8 int\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
        );
        let mesh = parse_points(text.as_bytes(), Format::Vtk).unwrap();
        assert_eq!(
            (mesh.tets.len(), &mesh.triangles[..]),
            (6, &[[0, 1, 2]][..])
        );
        let names: Vec<_> = mesh
            .arrays
            .iter()
            .map(|a| (a.name.as_str(), a.components))
            .collect();
        assert_eq!(names, [("h", 1), ("a b", 1), ("xy", 2)]);
        assert_eq!(mesh.arrays[1].values[0], 8.0);
        // Who does not ask for them reads no hexahedra.
        assert!(parse(text.as_bytes(), Format::Vtk).is_err());
        for (cell, what) in [
            (
                "CELLS 1 5\n4 0 1 2 8\nCELL_TYPES 1\n10",
                "names point 8, and there are 8",
            ),
            (
                "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10",
                "of type 10 has 3 points",
            ),
            ("CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n42", "has the type 42"),
        ] {
            let text = format!("{HEAD}{cell}\n");
            let error = parse_points(text.as_bytes(), Format::Vtk)
                .unwrap_err()
                .to_string();
            assert!(error.contains(what), "{error}");
        }
        let error = parse_points(b"solid", Format::Stl).unwrap_err().to_string();
        assert!(error.starts_with("stl has no numbers at points"), "{error}");
    }

    #[test]
    fn the_last_step_of_a_view_counts() {
        let view = |name: &str, step: i64, values: &str, count: usize| {
            format!(
                "$NodeData\n1\n\"{name}\"\n1\n0.5\n3\n{step}\n1\n{count}\n{values}\n$EndNodeData\n"
            )
        };
        let head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n$EndNodes\n\
                    $Elements\n2\n1 4 2 0 1 10 20 30 40\n2 2 2 0 1 10 20 30\n$EndElements\n";
        let values = "10 1 20 2 40 4 30 3";
        let text = [
            head,
            &view("h", 3, values, 4),
            &view("h", 1, "10 9 20 9 30 9 40 9", 4),
            &view("of one node", 0, "10 1", 1),
        ]
        .concat();
        let mesh = parse_points(text.as_bytes(), Format::Msh).unwrap();
        assert_eq!((mesh.tets.len(), mesh.triangles.len()), (1, 1));
        assert_eq!(mesh.arrays[0].values, [1.0, 2.0, 3.0, 4.0]);
        assert!(mesh.arrays[1].values[1].is_nan());
        for (broken, what) in [
            (view("h", 0, values, 5), "$EndNodeData"),
            (view("h", 0, values, 1 << 40), "bytes are left"),
            (view("h", 0, "10 x", 1), "'x' is not a number"),
            (
                "$NodeData\n1\n".to_owned(),
                "expected, but the file ends here",
            ),
        ] {
            let text = [head, &broken].concat();
            let error = parse_points(text.as_bytes(), Format::Msh)
                .unwrap_err()
                .to_string();
            assert!(error.contains(what), "{what}: {error}");
        }
    }
}
