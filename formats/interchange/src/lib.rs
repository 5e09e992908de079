//! Readers and writers of foreign mesh formats, one module per format, and content sniffing.

mod closure;
mod coincident;
mod document;
mod error;
mod facet;
mod format;
mod grid;
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
pub use read::{Imported, read, sniff};
pub use stream::{
    MeshStream, PointSink, TetBlock, TetRegionBlock, TetRegionSink, TetSink, TriangleBlock,
    TriangleSink,
};
pub use write::{
    Plain, Surface, WriteError, WriteOptions, parse_promise, promise_title, size_estimate, write,
    write_document, write_text,
};
