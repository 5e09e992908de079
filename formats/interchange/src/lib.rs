//! Readers and writers of foreign mesh formats, one module per format, and content sniffing.

mod error;
mod format;
mod stream;

pub use error::ReadError;
pub use format::{Format, read, sniff, write};
pub use stream::{MeshStream, TetBlock, TriangleBlock};
