//! The surface that is cut: points with their class, faces with their flat patch; and what is made exact of it before.

mod coincident;
mod patches;
mod points;
mod slide;
mod snap;

pub use coincident::join_coincident;
pub use points::Surface;
pub use slide::{Plane, slide};
pub use snap::{snap_heights_and_columns, snap_walls};
