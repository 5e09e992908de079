//! Surfaces that are settled before a template is filled: graded to thin layers and to the quality and
//! size asked for, with both faces of a seam alike, and faces shared with another template as that
//! one has them.
//!
//! 1. A free pass of the mesher gives the guide (`guide.rs`): where the surface must be fine.
//! 2. Edges of the seam's low face and their images get one division (`outline.rs`); edges of faces
//!    that another template shares stay undivided.
//! 3. The low face is triangulated between these edges, with the guide's inner points (`planar.rs`);
//!    the high face is its image.
//! 4. Flat facets whose outline differs from the guide's are triangulated anew; all others are as in
//!    the guide (`make.rs`).
//!
//! `impose.rs` gives a template the refined face that another one shares with it.

mod check;
mod features;
mod guide;
mod impose;
mod make;
mod outline;
mod planar;

pub use guide::EASED as GUIDE_EASED;
pub use impose::{Other, impose};
pub use make::{Made, make};
