//! Makes the surface mesh of a wedge whose glued faces are images of each other.
//!
//! Wedges between mirror walls pass as they are: both neighbours of a mirror wall are images of the
//! same face, so the mesher may refine it freely. The two faces of a seam have to stay images of
//! each other, so their triangulation must be settled before the wedge is filled. A hub follows
//! its wedge: once the wedge's surface is made, the hub is given the face they share.

mod apart;
mod cli;
mod coarse;
mod error;
mod footing;
mod joined;
mod memory;
mod needles;
mod prepare;
mod remeshed;
mod shape;
mod status;
mod surface;

pub use apart::apart;
pub use apart::note_moved;
pub use cli::Cli;
pub use coarse::{Left, coarsened};
pub use error::{SurfaceError, failure};
pub use footing::Footing;
pub use memory::MemoryArgs;
pub use prepare::{Report, prepare, settle_faces};
pub use shape::{Followed, follow_shape};
pub use status::watched;
pub use surface::{Made, Other, crosses_itself, impose, make};
