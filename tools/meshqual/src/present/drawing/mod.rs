//! Pictures of a mesh: what is seen from where, in which colours, and the triangles of it on a canvas; and the labels of
//! axes.

mod canvas;
mod colours;
mod layout;
mod picture;
mod ticks;
mod view;

pub use colours::{quality_colour, quality_legend, region_colour};
pub use picture::{Colour, inside, outside};
pub use ticks::Ticks;
