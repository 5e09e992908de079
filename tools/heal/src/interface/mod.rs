//! Interfaces drawn once: where curved faces of two solids touch, both get the facets of one of them.
//!
//! Solids that are meshed apart from each other have facets of their own on a surface that they have in common. Dividing
//! the facets of both at each other leaves slivers, and layers between chords that nobody drew. So only the curves at which
//! a contact ends are imprinted: sharp edges of either solid, whose vertices become vertices of the other one's faces,
//! and whose edges are recovered there by flips. What both solids have inside a common border is the same surface then,
//! and the facets of one stand for it.

mod drawing;
mod faces;
mod redivide;
mod regions;
mod rims;
mod skin;
mod touch;

pub use drawing::{Drawn, draw_once};
