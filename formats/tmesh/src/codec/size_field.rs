//! Lengths of edges that change from place to place: `FPTS`, `FTET`, `FTRI`. `SPEC.md`, section 5.

use super::chunk::{ChunkInfo, ChunkReader, ChunkWriter};
use crate::{DecodeError, Document, SizeField};
use std::io::{self, Read, Write};

const POINTS: [u8; 4] = *b"FPTS";
const TETS: [u8; 4] = *b"FTET";
const TRIANGLES: [u8; 4] = *b"FTRI";

pub(super) fn read<R: Read>(
    reader: &mut ChunkReader<R>,
    info: &ChunkInfo,
    document: &mut Document,
) -> Result<bool, DecodeError> {
    if ![POINTS, TETS, TRIANGLES].contains(&info.id) {
        return Ok(false);
    }
    info.of_document()?;
    let field = document.size_field.get_or_insert_default();
    match info.id {
        POINTS => field.points = reader.array(info)?,
        TETS => field.tets = reader.array(info)?,
        _ => field.triangles = reader.array(info)?,
    }
    Ok(true)
}

pub(super) fn write<W: Write>(field: &SizeField, chunks: &mut ChunkWriter<W>) -> io::Result<()> {
    chunks.array(POINTS, 0, &field.points)?;
    if !field.tets.is_empty() {
        chunks.array(TETS, 0, &field.tets)?;
    }
    if !field.triangles.is_empty() {
        chunks.array(TRIANGLES, 0, &field.triangles)?;
    }
    Ok(())
}
