//! The size of elements that is wanted at each place of a template: one function, asked for edges of the surface and for
//! volumes of elements.
//!
//! It is the least of what holds for a region as a whole ([`Sizes::of_region`], [`Sizes::lengths`]) and of a size that changes from
//! place to place and grows at a bounded rate ([`Graded`]), which walls ask for that are to have some elements across
//! ([`across_walls`]), and a size field ([`field`]).

mod across;
mod cubes;
pub mod field;
mod sizes;
mod too_many;
mod tree;

pub use across::{Across, Thinnest, across_walls, thickness};
pub use sizes::{Local, Sizes};
pub use too_many::TooMany;
pub use tree::{Graded, Node, Source};
