//! Frame (`FRAM`, binary) and the JSON chunks: `SYMM`, `PROM`, `WISH`, `REGN`, `MARK`,
//! `RMAP`, `srch`, `srce`, `hist`.
//! `SPEC.md`, sections 4 and 5.

use super::chunk::{ChunkInfo, ChunkReader, ChunkWriter};
use super::size_field;
use crate::{DecodeError, Document, Frame};
use glam::{DMat3, DVec3};
use serde::{Serialize, de::DeserializeOwned};
use std::io::{self, Read, Write};

const FRAME: [u8; 4] = *b"FRAM";
const SYMMETRY: [u8; 4] = *b"SYMM";
const PROMISE: [u8; 4] = *b"PROM";
const WISHES: [u8; 4] = *b"WISH";
const SEARCH: [u8; 4] = *b"srch";
const REGIONS: [u8; 4] = *b"REGN";
const MARKERS: [u8; 4] = *b"MARK";
const REGION_MAPS: [u8; 4] = *b"RMAP";
const SOURCE: [u8; 4] = *b"srce";
const HISTORY: [u8; 4] = *b"hist";

pub(super) fn read<R: Read>(
    reader: &mut ChunkReader<R>,
    info: &ChunkInfo,
    document: &mut Document,
) -> Result<bool, DecodeError> {
    const KNOWN: [[u8; 4]; 10] = [
        FRAME,
        SYMMETRY,
        PROMISE,
        WISHES,
        SEARCH,
        REGIONS,
        MARKERS,
        REGION_MAPS,
        SOURCE,
        HISTORY,
    ];
    if !KNOWN.contains(&info.id) {
        return Ok(false);
    }
    info.of_document()?;
    match info.id {
        FRAME => {
            let v: Vec<f64> = reader.array(info)?;
            let v: [f64; 12] = v
                .try_into()
                .map_err(|v: Vec<f64>| info.bad(format!("{} numbers, not 12", v.len())))?;
            document.frame = Frame {
                rotation: DMat3::from_cols_slice(&v[..9]).transpose(),
                origin: DVec3::from_slice(&v[9..]),
            };
        }
        SYMMETRY => document.symmetry = Some(json(reader, info)?),
        PROMISE => document.promise = Some(json(reader, info)?),
        WISHES => document.wishes = json(reader, info)?,
        SEARCH => document.search = Some(json(reader, info)?),
        REGIONS => document.regions = json(reader, info)?,
        MARKERS => document.markers = json(reader, info)?,
        REGION_MAPS => document.region_maps = json(reader, info)?,
        SOURCE => document.source = Some(json(reader, info)?),
        _ => document.history = json(reader, info)?,
    }
    Ok(true)
}

/// Writes everything but templates and instances.
pub fn write_metadata<W: Write>(
    document: &Document,
    chunks: &mut ChunkWriter<W>,
) -> io::Result<()> {
    let mut frame = [0.0; 12];
    document
        .frame
        .rotation
        .transpose()
        .write_cols_to_slice(&mut frame[..9]);
    document.frame.origin.write_to_slice(&mut frame[9..]);
    chunks.array(FRAME, 0, &frame)?;
    if let Some(symmetry) = &document.symmetry {
        put(chunks, SYMMETRY, symmetry)?;
    }
    if let Some(promise) = &document.promise {
        put(chunks, PROMISE, promise)?;
    }
    if !document.wishes.is_empty() {
        put(chunks, WISHES, &document.wishes)?;
    }
    if let Some(field) = &document.size_field {
        size_field::write(field, chunks)?;
    }
    if let Some(search) = &document.search {
        put(chunks, SEARCH, search)?;
    }
    put(chunks, REGIONS, &document.regions)?;
    put(chunks, MARKERS, &document.markers)?;
    if !document.region_maps.is_empty() {
        put(chunks, REGION_MAPS, &document.region_maps)?;
    }
    if let Some(source) = &document.source {
        put(chunks, SOURCE, source)?;
    }
    put(chunks, HISTORY, &document.history)
}

fn json<T: DeserializeOwned, R: Read>(
    reader: &mut ChunkReader<R>,
    info: &ChunkInfo,
) -> Result<T, DecodeError> {
    let bytes: Vec<u8> = reader.array(info)?;
    serde_json::from_slice(&bytes)
        .map_err(|e| info.bad(format!("its JSON is not as expected: {e}")))
}

fn put<T: Serialize, W: Write>(
    chunks: &mut ChunkWriter<W>,
    id: [u8; 4],
    value: &T,
) -> io::Result<()> {
    chunks.array(id, 0, &serde_json::to_vec(value)?)
}
