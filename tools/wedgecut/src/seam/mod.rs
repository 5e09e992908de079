//! Making parts of a wedge's faces images of each other.

mod align;
mod crossing;
mod matching;
mod reconcile;

pub use crossing::check_moved;
pub use matching::{Matched, Matching, match_sections};
