//! Imprinting: triangles that cross, overlap or touch with different triangles become one complex whose triangles
//! meet in common vertices and edges only, and whose cells are the regions.
//!
//! In rounds: what lies within the tolerance of one another is *related* (vertex to vertex, edge or triangle, edge to
//! edge or triangle), vertices that are one are joined, and edges and triangles are *divided* at what is related to them.
//! What a round makes is looked at by the next one, until nothing is related. Triangles that lie over each other then
//! have the same parts. Compare "Mesh Arrangements for Solid Geometry", Zhou et al. 2016: there points are exact, here
//! they are numbers that are rounded, and what is nearer than they are certain is one. That no two triangles cross in the
//! end is decided exactly.

mod curves;
mod divide;
mod faces;
mod near;
mod overlay;
mod relate;
mod settle;

pub use curves::{Curves, Patch, bend};
pub use divide::{Division, Parts};
pub use faces::{Complex, Faces, Incidence};
pub use near::{Spot, crossing, crossing_along, is_over};
pub use overlay::overlay;
pub use relate::{Reach, is_related};
pub use settle::{Claim, Settled, settle};
