//! Walls (`WALL`, one chunk each). `SPEC.md`, section 7.

use super::chunk::{ChunkInfo, ChunkReader, ChunkWriter};
use super::instances::StoredIsometry;
use super::template::current;
use crate::{DecodeError, Document, HubWall, MirrorWall, Plane, Seam, Wall};
use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use std::io::{self, Read, Write};

const WALL: [u8; 4] = *b"WALL";
const MIRROR: u32 = 1;
const SEAM: u32 = 2;
const HUB: u32 = 3;

/// Fixed part, all fields in words of 32 bits so that the payload is one array of words.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Header {
    kind: u32,
    other: u32,
    isometry: StoredIsometry,
    name_bytes: u32,
    vertices: u32,
    triangles: u32,
    /// Normal and offset, each as low and high word of an `f64`.
    plane: [[u32; 2]; 4],
}

/// Whether a template may have several chunks of this kind.
pub(super) fn repeats(info: &ChunkInfo) -> bool {
    info.id == WALL
}

const HEADER_WORDS: usize = size_of::<Header>() / 4;

fn words(x: f64) -> [u32; 2] {
    let bits = x.to_bits();
    [bits as u32, (bits >> 32) as u32]
}

fn number([low, high]: [u32; 2]) -> f64 {
    f64::from_bits(u64::from(low) | (u64::from(high) << 32))
}

pub(super) fn write<W: Write>(
    wall: &Wall,
    template: u32,
    chunks: &mut ChunkWriter<W>,
) -> io::Result<()> {
    let zero = [0.0; 4];
    let (kind, other, isometry, plane, vertices, triangles): (_, _, _, _, &[u32], &[u32]) =
        match wall {
            Wall::Mirror(w) => {
                let Plane { normal: n, offset } = w.plane;
                (
                    MIRROR,
                    0,
                    w.reflection,
                    [n.x, n.y, n.z, offset],
                    &w.vertices,
                    &w.triangles,
                )
            }
            Wall::Seam(w) => (
                SEAM,
                0,
                w.rotation,
                zero,
                w.vertex_pairs.as_flattened(),
                w.triangle_pairs.as_flattened(),
            ),
            Wall::Hub(w) => (
                HUB,
                w.other,
                w.placement,
                zero,
                w.vertex_pairs.as_flattened(),
                w.triangle_pairs.as_flattened(),
            ),
        };
    let name = wall.name().as_bytes();
    let count = |length: usize| {
        u32::try_from(length).map_err(|_| {
            let text = format!("wall '{}' has {length} ids, too many to write", wall.name());
            io::Error::new(io::ErrorKind::InvalidData, text)
        })
    };
    let header = Header {
        kind,
        other,
        isometry: StoredIsometry::new(isometry),
        name_bytes: count(name.len())?,
        vertices: count(vertices.len())?,
        triangles: count(triangles.len())?,
        plane: plane.map(words),
    };
    let name_words = name.len().div_ceil(4);
    let length = 4 * (HEADER_WORDS + name_words + vertices.len() + triangles.len());
    chunks.chunk(WALL, template, length as u64, |p| {
        p.array(&[header])?;
        p.bytes(name)?;
        p.bytes(&[0; 4][..4 * name_words - name.len()])?;
        p.array(vertices)?;
        p.array(triangles)
    })
}

pub(super) fn read<R: Read>(
    reader: &mut ChunkReader<R>,
    info: &ChunkInfo,
    document: &mut Document,
) -> Result<bool, DecodeError> {
    if info.id != WALL {
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
    let (vertices, triangles) = (header.vertices as usize, header.triangles as usize);
    if rest.len() as u64 != name_words as u64 + vertices as u64 + triangles as u64 {
        return Err(info.bad(format!(
            "it announces a name of {} bytes, {vertices} vertices and {triangles} triangles, \
             which is not its size",
            header.name_bytes
        )));
    }
    let (name, rest) = rest.split_at(name_words);
    let (vertices, triangles) = rest.split_at(vertices);
    let name: Vec<u8> = name.iter().flat_map(|w| w.to_le_bytes()).collect();
    let name = std::str::from_utf8(&name[..header.name_bytes as usize])
        .map_err(|_| info.bad("its name is not UTF-8"))?
        .to_owned();
    let isometry = header.isometry.isometry(info)?;
    let pairs = |ids: &[u32]| -> Result<Vec<[u32; 2]>, DecodeError> {
        let (pairs, odd) = ids.as_chunks::<2>();
        if odd.is_empty() {
            Ok(pairs.to_vec())
        } else {
            Err(info.bad("an odd number of ids in pairs"))
        }
    };
    template.walls.push(match header.kind {
        MIRROR => {
            let [x, y, z, offset] = header.plane.map(number);
            Wall::Mirror(MirrorWall {
                name,
                plane: Plane {
                    normal: DVec3::new(x, y, z),
                    offset,
                },
                reflection: isometry,
                vertices: vertices.to_vec(),
                triangles: triangles.to_vec(),
            })
        }
        SEAM => Wall::Seam(Seam {
            name,
            rotation: isometry,
            vertex_pairs: pairs(vertices)?,
            triangle_pairs: pairs(triangles)?,
        }),
        HUB => Wall::Hub(HubWall {
            name,
            other: header.other,
            placement: isometry,
            vertex_pairs: pairs(vertices)?,
            triangle_pairs: pairs(triangles)?,
        }),
        kind => return Err(info.bad(format!("{kind} is no kind of wall"))),
    });
    Ok(true)
}
