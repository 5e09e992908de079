//! Instances (`INST`). `SPEC.md`, section 8.

use super::chunk::{ChunkInfo, ChunkReader, ChunkWriter};
use crate::{DecodeError, Document, Instance, Isometry, MAX_TURN_DENOMINATOR};
use bytemuck::{Pod, Zeroable};
use std::io::{self, Read, Write};

const INSTANCES: [u8; 4] = *b"INST";
const MIRRORED: u32 = 1;
const FLIPPED: u32 = 2;

/// An isometry as stored: turn `k / n`, flags.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct StoredIsometry {
    k: u32,
    n: u32,
    flags: u32,
}

impl StoredIsometry {
    pub fn new(isometry: Isometry) -> Self {
        let mirrored = if isometry.mirrored() { MIRRORED } else { 0 };
        let flipped = if isometry.flipped() { FLIPPED } else { 0 };
        Self {
            k: isometry.k(),
            n: isometry.n(),
            flags: mirrored | flipped,
        }
    }

    pub fn isometry(self, info: &ChunkInfo) -> Result<Isometry, DecodeError> {
        let Self { k, n, flags } = self;
        if n == 0 || n > MAX_TURN_DENOMINATOR || k >= n || flags > (MIRRORED | FLIPPED) {
            return Err(info.bad(format!("{k}/{n} with flags {flags} is no isometry")));
        }
        let (mirrored, flipped) = (flags & MIRRORED != 0, flags & FLIPPED != 0);
        Ok(Isometry::new(i64::from(k), n, mirrored, flipped))
    }
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct StoredInstance {
    template: u32,
    isometry: StoredIsometry,
    region_map: u32,
    reserved: u32,
}

pub(super) fn read<R: Read>(
    reader: &mut ChunkReader<R>,
    info: &ChunkInfo,
    document: &mut Document,
) -> Result<bool, DecodeError> {
    if info.id != INSTANCES {
        return Ok(false);
    }
    info.of_document()?;
    let stored: Vec<StoredInstance> = reader.array(info)?;
    document.instances = stored
        .into_iter()
        .map(|s| {
            if s.reserved != 0 {
                return Err(info.bad("a reserved field is not zero"));
            }
            let isometry = s.isometry.isometry(info)?;
            Ok(Instance {
                template: s.template,
                isometry,
                region_map: s.region_map,
            })
        })
        .collect::<Result<_, _>>()?;
    Ok(true)
}

/// Writes the instances of a document, the chunk after the last template.
pub fn write<W: Write>(instances: &[Instance], chunks: &mut ChunkWriter<W>) -> io::Result<()> {
    let stored: Vec<StoredInstance> = instances
        .iter()
        .map(|i| StoredInstance {
            template: i.template,
            isometry: StoredIsometry::new(i.isometry),
            region_map: i.region_map,
            reserved: 0,
        })
        .collect();
    chunks.array(INSTANCES, 0, &stored)
}
