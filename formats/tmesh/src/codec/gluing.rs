//! Gluings (`GLUE`, one chunk each). `SPEC.md`, section 7.

use super::chunk::{ChunkInfo, ChunkReader, ChunkWriter};
use super::instances::StoredIsometry;
use super::template::current;
use crate::{DecodeError, Document, Gluing};
use bytemuck::{Pod, Zeroable};
use std::io::{self, Read, Write};

const GLUING: [u8; 4] = *b"GLUE";

/// Fixed part; with it the payload is one array of 32-bit words.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Header {
    other: u32,
    step: StoredIsometry,
    name_bytes: u32,
    vertex_pairs: u32,
    triangle_pairs: u32,
    reserved: u32,
}

const HEADER_WORDS: usize = size_of::<Header>() / 4;

/// Whether a template may have several chunks of this kind.
pub(super) fn repeats(info: &ChunkInfo) -> bool {
    info.id == GLUING
}

pub(super) fn write<W: Write>(
    gluing: &Gluing,
    template: u32,
    chunks: &mut ChunkWriter<W>,
) -> io::Result<()> {
    let name = gluing.name.as_bytes();
    let count = |length: usize| {
        u32::try_from(length).map_err(|_| {
            let text = format!(
                "gluing '{}' has {length} entries, too many to write",
                gluing.name
            );
            io::Error::new(io::ErrorKind::InvalidData, text)
        })
    };
    let header = Header {
        other: gluing.other,
        step: StoredIsometry::new(gluing.step),
        name_bytes: count(name.len())?,
        vertex_pairs: count(gluing.vertex_pairs.len())?,
        triangle_pairs: count(gluing.triangle_pairs.len())?,
        reserved: 0,
    };
    let name_words = name.len().div_ceil(4);
    let pairs = gluing.vertex_pairs.len() + gluing.triangle_pairs.len();
    let length = 4 * (HEADER_WORDS + name_words + 2 * pairs);
    chunks.chunk(GLUING, template, length as u64, |p| {
        p.array(&[header])?;
        p.bytes(name)?;
        p.bytes(&[0; 4][..4 * name_words - name.len()])?;
        p.array(&gluing.vertex_pairs)?;
        p.array(&gluing.triangle_pairs)
    })
}

pub(super) fn read<R: Read>(
    reader: &mut ChunkReader<R>,
    info: &ChunkInfo,
    document: &mut Document,
) -> Result<bool, DecodeError> {
    if info.id != GLUING {
        return Ok(false);
    }
    let payload: Vec<u32> = reader.array(info)?;
    let template = current(document, info)?;
    if payload.len() < HEADER_WORDS {
        return Err(info.bad("shorter than its fixed part"));
    }
    let (fixed, rest) = payload.split_at(HEADER_WORDS);
    let header: Header = bytemuck::cast_slice(fixed)[0];
    let name_words = (header.name_bytes as usize).div_ceil(4);
    let [vertices, triangles] = [header.vertex_pairs, header.triangle_pairs];
    let words = name_words as u64 + 2 * (u64::from(vertices) + u64::from(triangles));
    if rest.len() as u64 != words {
        return Err(info.bad(format!(
            "it announces a name of {} bytes, {vertices} vertex pairs and {triangles} triangle pairs, \
             which is not its size",
            header.name_bytes
        )));
    }
    if header.reserved != 0 {
        return Err(info.bad("a reserved field is not zero"));
    }
    let (name, rest) = rest.split_at(name_words);
    let (vertices, triangles) = rest.split_at(2 * vertices as usize);
    let name: Vec<u8> = name.iter().flat_map(|w| w.to_le_bytes()).collect();
    let (name, padding) = name.split_at(header.name_bytes as usize);
    if padding.iter().any(|&b| b != 0) {
        return Err(info.bad("the padding of its name is not zero"));
    }
    let name = std::str::from_utf8(name).map_err(|_| info.bad("its name is not UTF-8"))?;
    template.gluings.push(Gluing {
        name: name.to_owned(),
        other: header.other,
        step: header.step.isometry(info)?,
        vertex_pairs: bytemuck::cast_slice(vertices).to_vec(),
        triangle_pairs: bytemuck::cast_slice(triangles).to_vec(),
    });
    Ok(true)
}
