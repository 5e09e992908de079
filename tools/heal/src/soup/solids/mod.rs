//! Which solid is on either side of each triangle of a closed surface: how that is told, what the user is told where it
//! cannot be, and the regions and triangles of the document that follow from it.

mod label;
mod notices;
mod tables;

pub use label::{Labels, label};
pub use tables::tables;
