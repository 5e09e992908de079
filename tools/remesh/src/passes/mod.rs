//! Passes over a surface.

mod collapse;
mod decimate;
mod flip;
mod meet;
mod reduced;
mod relocate;
mod remesh;
mod ridges;
mod rows;
mod spare;
mod split;
mod uncap;
mod worth;

pub use remesh::{Remeshed, Told, remesh};

#[cfg(test)]
mod tests;
