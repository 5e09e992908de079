//! Why a document could not be decoded.

use crate::Violation;
use thiserror::Error;

/// Why a document could not be decoded. Offsets are bytes from the start of the document.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DecodeError {
    /// Nothing to read.
    #[error("the input is empty; did the previous stage fail?")]
    Empty,
    /// The first bytes are not those of a tmesh document.
    #[error("not a tmesh document: it begins with {found:02x?}")]
    BadMagic {
        /// The first bytes, up to eight.
        found: Vec<u8>,
    },
    /// Written by a newer, incompatible version.
    #[error(
        "the document has format version {found}, this tool reads version {supported}; update the tools"
    )]
    Version {
        /// Major version of the document.
        found: u16,
        /// Major version of this reader.
        supported: u16,
    },
    /// A critical chunk this version does not know.
    #[error(
        "chunk '{id}' at byte {offset} is required to understand the document, and this version does not know it; update the tools"
    )]
    UnknownCritical {
        /// The chunk's id.
        id: String,
        /// Where it begins.
        offset: u64,
    },
    /// The document ends early.
    #[error("the document is cut off at byte {offset}, {context}; did the previous stage fail?")]
    Truncated {
        /// Bytes that were there.
        offset: u64,
        /// What was being read.
        context: String,
    },
    /// Bytes after the end marker.
    #[error("there are bytes after the end of the document at byte {offset}")]
    TrailingBytes {
        /// Where the document ends.
        offset: u64,
    },
    /// A checksum differs.
    #[error("{what} at byte {offset} is damaged: checksum {stored:08x}, computed {computed:08x}")]
    Checksum {
        /// What the checksum covers.
        what: String,
        /// Where it begins.
        offset: u64,
        /// The stored checksum.
        stored: u32,
        /// The checksum of the bytes read.
        computed: u32,
    },
    /// A chunk is there, whole and undamaged, but makes no sense.
    #[error("chunk '{id}' at byte {offset}: {reason}")]
    BadChunk {
        /// The chunk's id.
        id: String,
        /// Where it begins.
        offset: u64,
        /// What is wrong with it.
        reason: String,
    },
    /// All chunks could be read, but together they are not a valid document.
    #[error("the document is inconsistent: {first}{}", more(.count))]
    Invalid {
        /// The first violation.
        first: Violation,
        /// How many there are.
        count: usize,
    },
    /// Reading failed.
    #[error("cannot read the document: {0}")]
    Io(#[from] std::io::Error),
}

fn more(count: &usize) -> String {
    match count {
        0 | 1 => String::new(),
        n => format!(" (and {} more)", n - 1),
    }
}
