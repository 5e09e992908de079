//! A size field as the templates of a document see it.
//!
//! 1. Lengths at its points are limited by the gradation, and its border is found, once for the whole field ([`Limited`]).
//! 2. For a template, each element is brought into its place by those instances whose copies of the template it may meet ([`Folded`]):
//!    the whole field once, and what is on the border of copies or at the axis several times, whatever the number of copies.
//! 3. An octree asks for the least and the largest length in its cubes ([`Cells`]).

mod cells;
mod estimate;
mod fold;
mod limited;

pub use cells::{Cells, Listed, Seen};
pub use estimate::{mean_cubes, mean_volume};
pub use fold::Folded;
pub use limited::Limited;

#[cfg(test)]
mod tests;
