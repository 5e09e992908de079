//! Template arrays: `VERT`, `TRIS`, `TETS`, `AXIS`. `SPEC.md`, section 6.

use super::chunk::{ChunkInfo, ChunkReader, ChunkWriter};
use crate::{DecodeError, Document, Template};
use std::io::{self, Read, Write};

/// Chunk of a template's vertices, [`glam::DVec3`] each; the template's first chunk.
pub const VERTICES: [u8; 4] = *b"VERT";
/// Chunk of a template's triangles, [`crate::Triangle`] each.
pub const TRIANGLES: [u8; 4] = *b"TRIS";
/// Chunk of a template's tetrahedra, [`crate::Tet`] each.
pub const TETS: [u8; 4] = *b"TETS";
const AXIS: [u8; 4] = *b"AXIS";

pub(super) fn read<R: Read>(
    reader: &mut ChunkReader<R>,
    info: &ChunkInfo,
    document: &mut Document,
) -> Result<bool, DecodeError> {
    if info.id == VERTICES {
        // A template begins with its vertices, templates in order.
        if info.scope as usize != document.templates.len() {
            return Err(info.bad(format!(
                "template {} where template {} should begin",
                info.scope,
                document.templates.len()
            )));
        }
        let vertices = reader.array(info)?;
        document.templates.push(Template {
            vertices,
            ..Template::default()
        });
        return Ok(true);
    }
    if ![TRIANGLES, TETS, AXIS].contains(&info.id) {
        return Ok(false);
    }
    let template = current(document, info)?;
    match info.id {
        TRIANGLES => template.triangles = reader.array(info)?,
        TETS => template.tets = reader.array(info)?,
        _ => template.axis = reader.array(info)?,
    }
    Ok(true)
}

/// The template a chunk belongs to: always the one whose vertices came last.
pub(super) fn current<'a>(
    document: &'a mut Document,
    info: &ChunkInfo,
) -> Result<&'a mut Template, DecodeError> {
    let begun = document.templates.len();
    if info.scope as usize + 1 != begun {
        let reason = format!(
            "it belongs to template {}, and {begun} have begun",
            info.scope
        );
        return Err(info.bad(reason));
    }
    Ok(&mut document.templates[begun - 1])
}

pub(super) fn write<W: Write>(
    template: &Template,
    index: u32,
    chunks: &mut ChunkWriter<W>,
) -> io::Result<()> {
    chunks.array(VERTICES, index, &template.vertices)?;
    chunks.array(TRIANGLES, index, &template.triangles)?;
    if !template.tets.is_empty() {
        chunks.array(TETS, index, &template.tets)?;
    }
    if !template.axis.is_empty() {
        chunks.array(AXIS, index, &template.axis)?;
    }
    Ok(())
}
