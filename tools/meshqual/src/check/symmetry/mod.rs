//! The symmetry that a mesh promises, of any kind of group.

mod elements;
mod generators;
mod images;
pub mod instanced;
mod part;
pub mod plain;
