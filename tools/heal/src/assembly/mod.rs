//! Several files as one body: each is read and mended by itself, then their solids are put together, before it is told
//! which solid is on either side of a triangle. What holds for solids of one file holds for those of several.

mod names;
mod part;
mod surface_of;

pub use part::{Naming, Part, assemble, read_part};
