//! From the mesher's answer back to a template: numbered, its walls restored, improved, checked.

mod answer;
mod doubled;
mod filled;
mod finish;
mod measures;
mod orientations;
mod preserved;
mod relief;
mod separation;
mod touching;
mod walls;

pub use answer::fill;
pub use filled::{Filled, NONE};
pub use finish::finish;
