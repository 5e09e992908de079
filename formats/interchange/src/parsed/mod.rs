//! What a reader delivers: the file's own data, parsed and in bounds, not judged.
//!
//! Vertices and elements are those that the file lists, in its order. Nothing is welded, completed,
//! turned over or measured here; the crate `heal` does that.

mod grid;
mod mesh;
mod plc;
mod point_mesh;
mod shells;
mod soup;

pub(crate) use grid::{Grid, SOURCE, SYMMETRY, TETRA, TRIANGLE, by_corners};
pub use mesh::{Finding, Mesh, MeshTriangles};
pub use plc::{Facet, Plc, Seed};
pub use point_mesh::{PointArray, PointMesh};
pub use shells::{Shells, Volume};
pub use soup::{Faces, Group, Soup};

use tmesh::Document;

/// The data of one file.
#[derive(Clone, Debug)]
pub enum Parsed {
    /// A document, which needs no judging.
    Document(Box<Document>),
    /// Polygons in groups.
    Soup(Soup),
    /// Facets, holes and regions of a piecewise linear complex.
    Plc(Plc),
    /// Labelled triangles that may bound several volumes.
    Shells(Shells),
    /// Tetrahedra, or triangles that name the regions on both sides.
    Mesh(Mesh),
}
