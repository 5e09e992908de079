//! Readers and writers of foreign mesh formats, one module per format, and content sniffing.

mod error;
mod format;
mod read;
mod soup;
mod stl;
mod stream;
mod surface;
mod tokens;
mod weld;

pub use error::ReadError;
pub use format::{Format, write};
pub use read::{Imported, read, sniff};
pub use stream::{MeshStream, TetBlock, TriangleBlock};
