//! Cutting along a seam that is no plane, the [`Graph`](crate::graph::Graph) of an angle.
//!
//! The body is straightened and cut at planes as any other, its sections are matched and closed, and the wedge is bent back.
//! Only what lies between two points is asked of the body as it is: crossings are on its own edges
//! ([`crate::cell::Cell::between`]), edges that bend are divided before ([`divide`]), a section has points inside of
//! it so that its triangles follow the graph ([`follow`]), and faces that are images of each other are made so anew once they
//! are bent ([`restore`]).

mod divide;
mod follow;
mod restore;

pub use divide::divide;
pub use follow::follow;
pub use restore::restore;
