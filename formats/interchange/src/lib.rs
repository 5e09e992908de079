//! Readers and writers of foreign mesh formats, one module per format, and content sniffing.

mod closure;
mod coincident;
mod decimal;
mod document;
mod error;
mod facet;
mod format;
mod grid;
mod middles;
mod msh;
mod near;
mod needles;
mod obj;
mod off;
mod place;
mod plc;
mod ply;
mod poly;
mod polygon;
mod read;
mod segments;
mod shells;
pub mod sides;
mod skin;
mod solids;
mod soup;
mod stl;
mod stream;
mod surface;
mod tokens;
mod vtk;
mod vtu;
mod weld;
mod write;

pub use error::{OddEdges, ReadError};
pub use format::Format;
pub use middles::{Middles, TooManyPoints, second_order};
pub use read::{Imported, read, sniff};
pub use stream::{
    Coupling, Label, MeshStream, Patch, PatchBlock, PatchSink, PointSink, Side, TetBlock,
    TetRegionBlock, TetRegionSink, TetSink, TriangleBlock, TriangleSink,
};
pub use write::{
    Parity, Plain, Surface, WriteError, WriteOptions, file_parts, parse_promise, placed_side,
    promise_title, size_estimate, write, write_document, write_part, write_pieces, write_text,
};
