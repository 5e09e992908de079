//! Fills a template's surface with tetrahedra.
//!
//! [`Plc`] describes the surface as a piecewise linear complex, a [`Mesher`] (TetGen, in a process of its own) makes
//! tetrahedra of it, and [`label`] says which region each of them is in. [`Climb`] repeats this by the rungs of a
//! [`LADDER`] until a mesh is as asked for.

mod cells;
mod complex;
mod deadline;
mod error;
mod faces;
mod failure;
mod ladder;
mod log;
mod mesher;
mod params;
mod piece;
mod tetgen;

pub use cells::{Cells, Contradiction, Surface, label};
pub use complex::{Attributes, Description, Facet, Facets, Order, Plc, Relief, SizeSeed, settled};
pub use deadline::Deadline;
pub use error::{Error, Fault, Place, RegionName};
pub use faces::{Faces, NO_FACE, Upright, face_key, leads};
pub use failure::{Failure, FailureKind};
pub use ladder::{
    Answer, Asks, Attempt, Change, Climb, EASING, Ending, IN_CUBE, Kept, LADDER, RESOLUTION, Room,
    Rung,
};
pub use log::{Log, Progress};
pub use mesher::{Elements, Limits, Mesh, Mesher, Task};
pub use params::Params;
pub use piece::Piece;
pub use sizing::field::mean_volume;
pub use sizing::{Sizes, TooMany, thickness};
pub use tetgen::TetGen;
