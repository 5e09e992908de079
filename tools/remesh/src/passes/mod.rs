//! Passes over a surface.

mod collapse;
mod contract;
mod decimate;
mod flip;
mod level;
mod meet;
mod reduced;
mod relocate;
mod remesh;
mod ridges;
mod rows;
mod slender;
mod spare;
mod split;
mod uncap;
mod worth;

pub use remesh::{Remeshed, Told, remesh};

#[cfg(test)]
mod tests;
