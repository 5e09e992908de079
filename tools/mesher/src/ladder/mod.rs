//! One ladder of attempts at a surface, with one rule when to stop.

mod attempt;
mod climb;
mod room;
mod rungs;

pub use attempt::{Answer, Asks, Attempt};
pub use climb::{Climb, Judged};
pub use rungs::{Change, Ending, LADDER, Rung};
