//! The cell of cutting faces that bounds a wedge.
//!
//! A cell is a list of faces and a list of joins: which part of which face is the image of which other part, and by
//! which isometry. Everything that cuts, closes and matches works on these two lists.

mod bounds;
mod class;
mod face;
mod join;
mod part;
mod table;
#[cfg(test)]
mod tests;

pub use bounds::Cell;
pub use class::Class;
pub use face::{Face, Role, Shape};
pub use join::Join;
pub use part::{Border, Part};
pub use table::{LEVEL_WALL, angle, has_room_for_hub, hub_order, may_have_hub, of_group};
