//! Surfaces that are settled before a template is filled: graded to thin layers and to the quality and
//! size asked for, with both faces of a seam alike, and faces shared with another template as that
//! one has them.
//!
//! 1. A free pass of the mesher gives the guide (`guide.rs`): where the surface must be fine. Or, where lengths of edges are asked for, it is the
//!    surface divided into these (`even.rs`).
//! 2. Feature edges (`features.rs`) that are images of each other form orbits (`orbits.rs`), under the steps of all
//!    pairs of faces that are glued to each other (`pairing.rs`). Each orbit gets one division (`divide.rs`); edges of faces that another template shares stay undivided.
//! 3. Of two faces glued to each other, the master is triangulated between these edges (`fill.rs`), with the
//!    guide's inner points; the other one is its image.
//! 4. Flat facets whose outline differs from the guide's are triangulated anew; all others are as in
//!    the guide.
//!
//! `impose.rs` gives a template the refined face that another one shares with it.

mod check;
mod divide;
mod division;
mod even;
mod features;
mod fill;
mod gluings;
mod guide;
mod impose;
mod make;
mod maker;
mod orbits;
mod pairing;

pub use check::{same_body, same_size};
pub use guide::Guide;
pub use impose::{Other, impose};
pub use make::{Made, crosses_itself, make};
