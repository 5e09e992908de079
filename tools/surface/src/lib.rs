//! The surfaces of wedges before they are filled.
//!
//! What stands for a curved shape is remeshed within the deviation ([`follow_shape`]). The two faces of a seam have to stay images of
//! each other, so their triangulation must be settled before the wedge is filled ([`settle_faces`]); wedges between mirror walls pass as they
//! are, as both neighbours of a mirror wall are images of the same face, and the mesher may refine it freely. A hub follows
//! its wedge: once the wedge's surface is made, the hub is given the face they share.

mod apart;
mod coarse;
mod error;
mod footing;
mod joined;
mod lengths;
mod needles;
mod remeshed;
mod seams;
mod settle;
mod shape;

pub use apart::{apart, note_deviation, note_moved};
pub use coarse::{Left, coarsened};
pub use error::{SurfaceError, failure};
pub use footing::Footing;
pub use joined::glued;
pub use lengths::{Divided, Lengths, Shared, divided, lengths, mean_edge};
pub use seams::{Guide, Made, Other, crosses_itself, impose, make};
pub use settle::{Remade, Report, settle_faces};
pub use shape::{Followed, follow_shape};
