//! Pictures of a mesh: what is seen from where, in which colours, and the triangles of it on a canvas.

mod canvas;
mod colours;
mod layout;
mod picture;
mod view;

pub use colours::{quality_colour, quality_legend, region_colour};
pub use picture::{Colour, inside, outside};
