//! Bulk arrays: one read or write, no per-element parsing on little-endian machines.

use bytemuck::{Pod, Zeroable};
use std::io::{self, Read};

/// First allocation for an array whose length the file claims; it doubles as data really arrive.
const FIRST_BYTES: usize = 1 << 20;

/// Width in bytes of the scalars that `T` is made of. All types of the format are made of scalars
/// of one width: `f64`/`u64` (8) or `u32` (4) or bytes (1).
fn scalar<T>() -> usize {
    align_of::<T>()
}

/// Gives `write` the little-endian bytes of an array.
pub fn with_little_endian<T: Pod>(
    data: &[T],
    write: impl FnOnce(&[u8]) -> io::Result<()>,
) -> io::Result<()> {
    if cfg!(target_endian = "little") {
        return write(bytemuck::cast_slice(data));
    }
    let mut copy = data.to_vec();
    swap_bytes(&mut copy);
    write(bytemuck::cast_slice(&copy))
}

fn swap_bytes<T: Pod>(data: &mut [T]) {
    let width = scalar::<T>();
    for chunk in bytemuck::cast_slice_mut::<T, u8>(data).chunks_exact_mut(width) {
        chunk.reverse();
    }
}

/// Reads `count` values straight into place, allocating no more than twice what has arrived.
///
/// `seen` gets each piece of raw bytes and how many of them were filled. Returns `None` when the
/// stream ends early.
pub fn read_growing<T: Pod + Zeroable>(
    input: &mut impl Read,
    count: u64,
    mut seen: impl FnMut(&[u8], usize),
) -> io::Result<Option<Vec<T>>> {
    let first = (FIRST_BYTES / size_of::<T>()).max(1);
    let mut data: Vec<T> = Vec::new();
    while (data.len() as u64) < count {
        let old = data.len();
        let step = (count - old as u64).min(old.max(first) as u64) as usize;
        data.try_reserve_exact(step)
            .map_err(|e| io::Error::new(io::ErrorKind::OutOfMemory, e))?;
        data.resize(old + step, T::zeroed());
        let bytes = bytemuck::cast_slice_mut(&mut data[old..]);
        let got = fill(input, bytes)?;
        seen(bytes, got);
        if got < bytes.len() {
            return Ok(None);
        }
    }
    if cfg!(target_endian = "big") {
        swap_bytes(&mut data);
    }
    Ok(Some(data))
}

/// Reads until the buffer is full or the stream ends; returns the number of bytes read.
pub fn fill(input: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut got = 0;
    while got < buffer.len() {
        match input.read(&mut buffer[got..]) {
            Ok(0) => break,
            Ok(n) => got += n,
            Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
            Err(e) => return Err(e),
        }
    }
    Ok(got)
}
