//! Makes the tetrahedra of a mesh better: takes vertices out that are not needed, moves vertices, replaces edges and faces, adds vertices.
//!
//! The mesher sees a wedge with a surface that it must keep where copies meet, and cannot do there what it
//! does inside. Here a seam is the inside that it is in the assembled mesh: the star of a vertex on it
//! is what is at the vertex together with what is at its partner, turned back, and both move as one.
//! Vertices on facets, walls and straight edges move along them, so shape and walls stay; those inside of
//! what stands for a curved shape move along that, in its envelope; what is inside of a flat
//! facet, a wall or a seam is triangulated as the elements there want it. What templates share stays as it is.

mod ahead;
mod cavity;
mod coarsen;
mod flats;
mod flip;
mod freedom;
mod freedoms;
mod improve;
mod insert;
mod mesh;
mod near;
mod quality;
mod shape;
mod slide;
mod smooth;
mod stars;
mod support;
mod surface;

#[cfg(test)]
mod tests;

pub use coarsen::{Coarse, Face, Leaves, coarsen};
pub use flats::Flats;
pub use freedoms::Freedoms;
pub use improve::{Improved, Wish, improve};
pub use shape::{Curved, NO_PATCH, Point, Shape};
