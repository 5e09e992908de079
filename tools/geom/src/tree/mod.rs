//! A hierarchy of boxes about triangles, and what it answers: the nearest point of a surface ([`Tree`]),
//! what a ray meets ([`Rays`]), and which boxes meet each other ([`pairs`],
//! [`with_neighbours`]).
//!
//! All three use one hierarchy: four children per node and one box per leaf, split by the surface-area heuristic
//! over bins of centres (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007).
//! Its boxes are in single precision and contain what they stand for, so that they only sort out; what is
//! left is decided in double precision, or exactly.

pub(crate) mod alignment;
mod boxes;
mod nearest;
mod pairs;
mod placement;
mod rays;

pub use alignment::alignment;
pub use nearest::{Nearest, Tree, closest_point};
pub use pairs::{Search, pairs, with_neighbours};
pub use rays::{Direction, Hit, Met, Rays};
