//! What writers see of a mesh: blocks of points and elements, labels, couplings.

mod boundary;
mod couplings;
mod mesh_stream;
mod middles;
mod plain;
#[cfg(test)]
mod sample;
pub mod sides;
mod tags;
mod walls;

pub(crate) use boundary::{BoundaryFace, boundary};
pub use mesh_stream::{
    Coupling, Label, MeshStream, Patch, PatchBlock, PatchSink, PointSink, Side, TetBlock,
    TetRegionBlock, TetRegionSink, TetSink, TriangleBlock, TriangleSink,
};
pub use middles::{Middles, TooManyPoints, second_order};
pub use plain::{Plain, placed_side};
#[cfg(test)]
pub use sample::test_document;
pub(crate) use sides::FACES;
pub(crate) use tags::{Run, Tags, runs};
