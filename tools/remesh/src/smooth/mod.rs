//! The smooth shape that facets stand for.
//!
//! A mesher divides facets further, and what it puts on them is not on the shape: only the corners of facets are. So a mesh is
//! read in two steps. A [`Drawing`] finds the facets, sets of triangles in one plane, and the corners at which their outlines
//! turn, and divides the facets into triangles between corners alone. A [`SmoothShape`] tells the curves that their edges
//! are chords of, from the normals at corners where facets meet smoothly, and from the tangents at corners of feature curves
//! elsewhere, and blends the curves over the triangles. Neither asks what the triangles are labelled with: a
//! surface goes on smoothly across the border of a region, even where an interface inside of the body ends at it.
//!
//! Normals are those of Max, "Weights for computing vertex normals from facet normals" (1999), exact on spheres and, as it
//! turns out, on cylinders, however their facets are divided. Curves are interpolated as in "Curved PN triangles"
//! (Vlachos et al., 2001), but have the height of an arc above their chords: circles, cylinders and spheres are met.

mod bent;
mod bows;
mod curves;
mod drawing;
mod faces;
mod normals;
mod shape;
mod sheets;
#[cfg(test)]
mod tests;

pub use drawing::{Drawing, Redrawn};
pub use shape::SmoothShape;
pub use sheets::{Reading, Sheets};
