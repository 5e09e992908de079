//! Prepares the surface of a wedge for the mesher.
//!
//! Wedges between mirror walls pass as they are: both neighbours of a mirror wall are images of the
//! same face, so the mesher may refine it freely. The triangulations of the two sides of a seam
//! match already when they leave `wedgecut`, and pass as they are too.

mod cli;

pub use cli::Cli;

use thiserror::Error;
use tmesh::{Document, Wall};

/// Why a wedge's surface could not be prepared.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// The wedge is filled already.
    #[error(
        "the document holds {0} tetrahedra; periodic-surf works on the surface, before tetwedge"
    )]
    AlreadyFilled(usize),
}

/// Sentences about what was done, for the history and the user.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Vertex pairs on seams.
    pub seam_vertices: usize,
    /// Triangle pairs on seams.
    pub seam_triangles: usize,
}

/// Prepares the surfaces of all templates.
///
/// # Errors
/// A document that holds tetrahedra.
pub fn prepare(document: Document) -> Result<(Document, Report), SurfaceError> {
    let tets = document.templates.iter().map(|t| t.tets.len()).sum();
    if tets > 0 {
        return Err(SurfaceError::AlreadyFilled(tets));
    }
    let mut report = Report::default();
    for wall in document.templates.iter().flat_map(|t| &t.walls) {
        if let Wall::Seam(seam) = wall {
            report.seam_vertices += seam.vertex_pairs.len();
            report.seam_triangles += seam.triangle_pairs.len();
        }
    }
    Ok((document, report))
}
