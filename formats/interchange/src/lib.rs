//! Readers and writers of foreign mesh formats: a folder per format, and one table of them.
//!
//! Readers return what the file lists ([`parsed`]); writers take a mesh block by block ([`MeshStream`]).
//! Nothing here judges or repairs geometry.

mod binary;
mod error;
mod formats;
mod options;
pub mod parsed;
mod sink;
mod stream;
pub mod text;
mod title;

pub use error::{ReadError, WriteError};
pub use formats::{
    Entry, Format, Writer, file_parts, parse, parse_points, size_estimate, sniff, write,
    write_document, write_part, write_pieces, write_text,
};
pub use options::{Parity, Surface, WriteOptions};
pub use parsed::Parsed;
pub use stream::{
    Coupling, Label, MeshStream, Middles, Patch, PatchBlock, PatchSink, Plain, PointSink, Side,
    TetBlock, TetRegionBlock, TetRegionSink, TetSink, TooManyPoints, TriangleBlock, TriangleSink,
    placed_side, second_order, sides,
};
pub use title::{parse_promise, promise_title};
