//! The rotations of a body: candidate axes, and the highest order about each of them.

mod axes;
mod candidates;
mod facet_count;
mod find;
mod highest;
mod limits;
mod query;
mod refine;
mod scan;

pub use axes::FIRST_DIRECTIONS;
pub use candidates::principal;
pub use find::{Rotation, golden, powers};
pub use limits::{LOOSE_RANGE, Limits, OUTLIERS};
pub use query::{Drawn, Query};
pub use refine::{Canonical, Fit, explain, refine, settle};
pub use scan::TELLING_TURNS;
