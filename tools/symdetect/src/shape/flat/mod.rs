//! Flat parts of a surface: faces with their edges and corners, and flats.

mod faces;
mod flats;
mod outlines;

pub use faces::{Exactness, Faces, Surface};
pub use flats::{Flats, SAME_DIRECTION};
