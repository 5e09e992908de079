//! Passes over a surface.

mod collapse;
mod contract;
mod crossings;
mod decimate;
mod flip;
mod level;
mod meet;
mod reduced;
mod relocate;
mod remesh;
mod remeshed;
mod ridges;
mod rounds;
mod rows;
mod slender;
mod spare;
mod split;
mod uncap;
mod worth;

pub use remesh::remesh;
pub use remeshed::{Remeshed, Told};

#[cfg(test)]
mod tests;
