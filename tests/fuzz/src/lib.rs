//! What the fuzz targets share: a limit on memory, and what has to hold of readers and documents.

mod documents;
mod memory;
pub mod plan;
mod readers;
mod repair;

pub use documents::check_document;
pub use memory::limited;
pub use readers::{check_reader, check_round_trip};
pub use repair::repaired;
