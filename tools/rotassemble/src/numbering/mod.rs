//! Global vertex ids of an assembled mesh, by index arithmetic.
//!
//! Vertices of a template that are fixed by the same isometries (see [`orbit`]) form a
//! *class*: the interior, each wall, the axis, each line where walls meet. Within a class the
//! copies of a vertex are the cosets of its stabilizer, the same for every vertex of the class, so
//! one small table per class, from instance to the first id of the coset, numbers them all:
//! `id = start[class][instance] + index_in_class`. The weld is exact whatever the rounding, the
//! number of points is known before any is written, and nothing is stored per copy.
//!
//! Ids are contiguous per instance: first the vertices that the first instance owns, then those of
//! the second that are not shared with the first, and so on.

mod classes;
mod error;
mod ids;
mod nodes;
mod orbit;
mod places;
mod roots;
#[cfg(test)]
mod tests;

pub use error::NumberingError;
pub use ids::Numbering;
pub use roots::{Roots, Shared};
