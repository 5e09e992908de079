//! Checks what every assembled mesh promises.
//!
//! A plain mesh is checked as it stands. An instanced one is checked template by template, at the walls,
//! and along the boundaries of the copies, which must meet nowhere but there: that proves the same of the
//! assembled mesh, because copies are congruent.
//!
//! The checks are a referee: they share no code with the tools whose meshes they judge. What is one
//! vertex, and what an image is, follows here from coordinates (in a plain mesh) or from links between
//! placed vertices (in an instanced one, see [`crate::instances`]), not from the classes and cosets by
//! which `rotassemble` numbers a mesh. An error of that numbering therefore shows here, instead of being
//! made twice.

mod checks;
mod copies;
mod faces;
mod findings;
mod symmetry;
#[cfg(test)]
mod tests;
mod volume;
mod walls;

pub use checks::{Checks, check};
pub use findings::Broken;
