//! Several files as one body: each is read and mended by itself, then their solids are put together, before it is told
//! which solid is on either side of a triangle. What holds for solids of one file holds for those of several.

mod assemble;
mod gaps;
mod names;
mod part;
mod read;
mod surface_of;

pub use assemble::assemble;
pub use gaps::{Gap, gaps};
pub use part::{Naming, Part};
pub use read::read_part;
