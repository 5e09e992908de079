//! The bytes of a document. `SPEC.md`, section 2 onwards.

mod array;
mod chunk;
mod gluing;
mod instances;
mod metadata;
mod size_field;
mod template;

pub use chunk::{ChunkInfo, ChunkWriter, MAGIC, VERSION_MAJOR, VERSION_MINOR};
pub use instances::write as write_instances;
pub use metadata::write_metadata;
pub use template::{TETS, TRIANGLES, VERTICES};

use crate::{DecodeError, Document, validate};
use chunk::ChunkReader;
use std::collections::BTreeSet;
use std::io::{self, Read, Write};

/// Reads a whole document and checks every invariant of [`crate::validate`].
///
/// Reads to the end of the stream; memory stays within twice the bytes that are really there.
pub fn read<R: Read>(reader: R) -> Result<Document, DecodeError> {
    read_with_chunks(reader).map(|(document, _)| document)
}

/// As [`read`], and lists the chunks met, unknown ones included.
pub fn read_with_chunks<R: Read>(reader: R) -> Result<(Document, Vec<ChunkInfo>), DecodeError> {
    let mut reader = ChunkReader::begin(reader)?;
    let mut document = Document::default();
    let mut met = BTreeSet::new();
    while let Some(header) = reader.next_chunk()? {
        let known = metadata::read(&mut reader, &header, &mut document)?
            || instances::read(&mut reader, &header, &mut document)?
            || template::read(&mut reader, &header, &mut document)?
            || gluing::read(&mut reader, &header, &mut document)?
            || size_field::read(&mut reader, &header, &mut document)?;
        if !known {
            reader.skip(&header)?;
        } else if !gluing::repeats(&header) && !met.insert((header.id, header.scope)) {
            return Err(header.bad("it is there twice"));
        }
    }
    let chunks = reader.finish()?;
    let violations = validate(&document);
    match violations.first() {
        None => Ok((document, chunks)),
        Some(first) => Err(DecodeError::Invalid {
            first: first.clone(),
            count: violations.len(),
        }),
    }
}

/// Writes a document. The same document always gives the same bytes.
pub fn write<W: Write>(document: &Document, writer: W) -> io::Result<()> {
    let mut chunks = ChunkWriter::begin(writer)?;
    write_metadata(document, &mut chunks)?;
    for (index, template) in document.templates.iter().enumerate() {
        template::write(template, index as u32, &mut chunks)?;
        for gluing in &template.gluings {
            gluing::write(gluing, index as u32, &mut chunks)?;
        }
    }
    instances::write(&document.instances, &mut chunks)?;
    chunks.finish()
}
