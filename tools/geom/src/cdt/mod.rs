//! Constrained Delaunay triangulation of points and segments in the plane (crate `spade`, exact
//! predicates), and which of its triangles belong to what the segments bound.
//!
//! - [`Cdt`]: the triangulation as arrays.
//! - [`Borders`]: segments that know what lies on either side; [`Cdt::label`] spreads that, [`triangulate`] gives the triangles.
//! - [`Patch`]: a facet with an outline that stays, refined until its triangles are good.
//! - [`Frame`]: coordinates in the plane of a facet.
//! - [`triangulate_enclosed`]: what the segments enclose, without holes.

mod enclosed;
mod frame;
mod label;
mod order;
mod patch;
mod triangulation;

pub use enclosed::triangulate_enclosed;
pub use frame::Frame;
pub use label::{Borders, Labels, Segment, triangulate};
pub use patch::{Broken, Patch, narrow};
pub use triangulation::{Cdt, CdtError, NONE};
