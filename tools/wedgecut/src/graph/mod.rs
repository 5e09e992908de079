//! Seams that are no planes: the graph of an angle over distance from the axis and height.
//!
//! A body is *straightened* by turning each of its points back by the angle of the graph there. The seam is a half plane then, and
//! so is its image under the rotation, as the angle is the same at all images of a point. The straightened body is cut,
//! its sections are matched and closed as any other, and the wedge is bent back. Only what lies between two points is asked of
//! the body as it is: crossings are on its own edges ([`crate::cell::Cell::between`]), edges that bend are
//! divided before ([`divide`]), and a section has points inside of it so that its triangles follow the graph
//! ([`follow`]).

mod between;
mod divide;
mod follow;
mod gaps;
mod rails;
mod restore;
mod seam;
mod table;

pub use between::between;
pub use divide::divide;
pub use follow::follow;
pub use rails::Rails;
pub use restore::restore;
pub use seam::{Graph, Parity};
pub use table::read;
