//! Geometry shared by the tools, on slices of coordinates and indices; it does not know documents.
//!
//! | what | where |
//! |---|---|
//! | measures of triangles and tetrahedra, exact predicates | [`measure`], [`tet`], [`predicate`] |
//! | equal points, near points | [`weld`], [`grid`] |
//! | triangles around edges, sides, cells of space, flat regions, contacts | [`edges`], [`sides`], [`cells`], [`flat`], [`contacts`] |
//! | nearest points of triangles, rays, pairs of boxes | [`tree`] |
//! | constrained Delaunay triangulation with regions | [`cdt`] |
//! | disjoint sets, eigenvectors | [`sets`], [`eigen`] |
//! | what counts as equal, how far rounded results are off | [`tolerance`], [`rounding`] |
//! | what counts as smooth | [`smooth`] |
//! | numbers and points as people read them | [`number`] |

pub mod cdt;
mod complex;
pub mod eigen;
mod element;
pub mod number;
mod points;
pub mod rounding;
pub mod sets;
pub mod smooth;
pub mod tolerance;
pub mod tree;

pub use complex::{cells, contacts, edges, flat, sides};
pub use element::{measure, predicate, tet};
pub use points::{grid, weld};
