//! Writers of foreign formats.

mod bytes;
mod cells;
mod conditions;
mod couplings;
mod error;
mod inp;
mod medit;
mod msh;
mod msh2;
mod plain;
mod spool;
mod stl;
mod tags;
mod tetgen;
mod text;
mod title;
mod vtk;
mod vtu;

pub use conditions::Parity;
pub use error::WriteError;
pub use plain::{Plain, placed_side};
pub use stl::Surface;
pub use text::write_text;
pub use title::{parse_promise, promise_title};
pub use vtu::write_pieces;

use crate::{Format, MeshStream};
use std::io::Write;
use tmesh::Document;

/// What goes into a file, where the format leaves a choice.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// Add the surface triangles to the cells of a file that has tetrahedra, with all cell arrays.
    /// A mesh without tetrahedra is always written as triangles.
    pub boundary: bool,
    /// Which triangles an STL file gets.
    pub surface: Surface,
    /// Write numbers as text, where a format has both forms.
    pub ascii: bool,
    /// Compress the arrays of a VTU file.
    pub compress: bool,
    /// The condition to write for each wall of a sector that is a mirror plane, by position in
    /// [`MeshStream::wall_names`]; none beyond the end. Only INP has conditions.
    pub parities: Vec<Option<Parity>>,
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
    match format {
        Format::Vtk => vtk::write(mesh, options.boundary, out),
        Format::Vtu => vtu::write(mesh, options.boundary, options.compress, out),
        Format::Stl => stl::write(mesh, options.surface, out),
        Format::Msh => msh::write(mesh, options.ascii, out),
        Format::Msh2 => msh2::write(mesh, options.ascii, out),
        Format::Medit => medit::write(mesh, out),
        Format::Inp => inp::write(mesh, &options.parities, out),
        Format::Node | Format::Pvtu => Err(WriteError::SeveralFiles(format.name())),
        other => Err(WriteError::NotAnOutput(other.name())),
    }
}

/// Extensions of the files that a mesh in this format consists of; none for formats that are one
/// file, or whose files are not known beforehand.
pub fn file_parts(format: Format) -> &'static [&'static str] {
    match format {
        Format::Node => &tetgen::PARTS,
        _ => &[],
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
    match format {
        Format::Node => tetgen::write_part(mesh, part, out),
        other => Err(WriteError::NotAnOutput(other.name())),
    }
}

/// Bytes that [`write()`] produces, for progress bars: to within a few kilobytes where the format is
/// binary and not compressed.
pub fn size_estimate(mesh: &dyn MeshStream, format: Format, options: &WriteOptions) -> u64 {
    match format {
        Format::Vtk => vtk::size_estimate(mesh, options.boundary),
        Format::Vtu => vtu::size_estimate(mesh, options.boundary, options.compress),
        Format::Stl => stl::size_estimate(mesh),
        Format::Msh => msh::size_estimate(mesh, options.ascii),
        Format::Msh2 => msh2::size_estimate(mesh, options.ascii),
        Format::Medit => medit::size_estimate(mesh),
        Format::Inp => inp::size_estimate(mesh),
        Format::Node => tetgen::size_estimate(mesh),
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
    match format {
        Format::Tmesh => Ok(tmesh::write(document, out)?),
        Format::Text => Ok(write_text(document, &[], out)?),
        other => write(&Plain::new(document)?, other, &options, out),
    }
}

/// A tetrahedron with its surface, in a frame that is not the identity.
#[cfg(test)]
fn test_document() -> Document {
    use glam::DVec3;
    use tmesh::{Gluing, Isometry, Marker, OUTSIDE, Region, Template, Tet, Triangle};
    let triangle = |vertices, marker| Triangle {
        vertices,
        marker,
        front: OUTSIDE,
        back: 7,
    };
    let mut document = Document::single(Template {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: vec![
            triangle([0, 2, 1], 0),
            triangle([0, 1, 3], 2),
            triangle([1, 2, 3], 2),
            triangle([0, 3, 2], 2),
        ],
        tets: vec![Tet {
            vertices: [0, 1, 2, 3],
            region: 7,
        }],
        gluings: vec![Gluing::mirror("floor", 0, Isometry::FLIP, [0, 1, 2], [0])],
        axis: vec![0, 3],
    });
    document.frame.origin = DVec3::X;
    document.regions.push(Region {
        id: 7,
        name: "copper".to_owned(),
        max_volume: None,
        volume: None,
    });
    document.markers.push(Marker {
        id: 2,
        name: "top".to_owned(),
        area: None,
    });
    document
}

#[cfg(test)]
mod tests {
    use super::*;

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
                | Format::Inp => {
                    result.unwrap();
                    assert!(!bytes.is_empty());
                }
                Format::Node | Format::Pvtu => {
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
}
