//! Writers of foreign formats.

mod bytes;
mod cells;
mod error;
mod plain;
mod stl;
mod text;
mod title;
mod vtk;
mod vtu;

pub use error::WriteError;
pub use plain::Plain;
pub use stl::Surface;
pub use text::write_text;
pub use title::{parse_promise, promise_title};

use crate::{Format, MeshStream};
use std::io::Write;
use tmesh::Document;

/// What goes into a file, where the format leaves a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// Add the surface triangles to the cells of a file that has tetrahedra, with all cell arrays.
    /// A mesh without tetrahedra is always written as triangles.
    pub boundary: bool,
    /// Which triangles an STL file gets.
    pub surface: Surface,
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
        Format::Vtu => vtu::write(mesh, options.boundary, out),
        Format::Stl => stl::write(mesh, options.surface, out),
        other => Err(WriteError::NotAnOutput(other.name())),
    }
}

/// Bytes that [`write()`] produces, to within a few kilobytes: for progress bars.
pub fn size_estimate(mesh: &dyn MeshStream, format: Format, options: &WriteOptions) -> u64 {
    match format {
        Format::Vtk => vtk::size_estimate(mesh, options.boundary),
        Format::Vtu => vtu::size_estimate(mesh, options.boundary),
        Format::Stl => stl::size_estimate(mesh),
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
        surface: Surface::Boundary,
    };
    match format {
        Format::Tmesh => Ok(tmesh::write(document, out)?),
        Format::Text => Ok(write_text(document, &[], out)?),
        other => write(&Plain::new(document)?, other, &options, out),
    }
}
