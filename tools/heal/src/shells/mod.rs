//! From labelled triangles that several volumes may share to regions.

mod build;

pub use build::build;
