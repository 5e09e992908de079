//! Making parts of a wedge's faces images of each other.

mod align;
mod matching;
mod reconcile;

pub use matching::{Matched, Matching, match_sections};
