//! Seams that are no planes: the graph of an angle over distance from the axis and height.
//!
//! A body is *straightened* by turning each of its points back by the angle of the graph there. The seam is a half plane then, and
//! so is its image under the rotation, as the angle is the same at all images of a point. A graph is read from a table
//! ([`read`]), or found [`between`] the blades and bent to edges beside it ([`Rails`]). How a body is cut along one is in
//! [`crate::along`].

mod between;
mod gaps;
mod rails;
mod seam;
mod table;

pub use between::between;
pub use rails::Rails;
pub use seam::{Graph, Parity, STRAIGHT, samples};
pub use table::read;
