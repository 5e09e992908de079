//! One ladder of attempts at a surface, with one rule when to stop.

mod attempt;
mod climb;
mod layers;
mod room;
mod rungs;

pub use attempt::{Answer, Asks, Attempt, EASING, Kept};
pub use climb::Climb;
pub use layers::IN_CUBE;
pub use room::{RESOLUTION, Room};
pub use rungs::{Change, Ending, LADDER, Rung};
