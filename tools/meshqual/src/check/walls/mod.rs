//! Walls: where copies meet, faces and vertices fall together exactly as listed.
//!
//! That listed vertices lie on a mirror's plane, that pairs are exact images and that neighbours exist is
//! [`tmesh::validate`]'s part. Here: the lists are complete, the faces on them are outer faces, and
//! nothing reaches through a wall.

mod across;
mod all;
mod coverage;
mod face;
mod mirror;

pub use all::{check, gluing_residual};
pub use coverage::hub_coverage;
pub use face::Mesh;
