//! The size of elements that is wanted at each place of a template: one function, asked for edges of the surface and for
//! volumes of elements.
//!
//! It is the least of what holds for a region as a whole ([`Sizes::of_region`], [`Sizes::lengths`]) and of a size that changes from
//! place to place and grows at a bounded rate ([`Graded`]), which walls ask for that are to have some elements across
//! ([`across_walls`]).

mod across;
mod sizes;
mod tree;

pub use across::{Across, Thinnest, across_walls};
pub use sizes::{Sizes, TooMany};
pub use tree::{Graded, Node, Source};
