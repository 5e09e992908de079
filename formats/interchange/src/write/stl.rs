//! Binary STL of the surface. Coordinates are rounded to single precision.

use super::WriteError;
use super::bytes::ByteSink;
use crate::MeshStream;
use glam::DVec3;
use std::io::Write;
use tmesh::OUTSIDE;

/// Which triangles to write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Surface {
    /// Those with material on exactly one side, turned so that normals point out of it: a closed
    /// surface. Of a wedge, its walls are part of it.
    #[default]
    Boundary,
    /// All of them, interfaces between regions included, as they are stored.
    All,
}

const HEADER: usize = 80;

pub fn write(
    mesh: &dyn MeshStream,
    surface: Surface,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let mut count = 0_u64;
    mesh.triangles(&mut |block| {
        let sides = block.front.iter().zip(block.back);
        count += sides
            .filter(|&(&f, &b)| turned(surface, f, b).is_some())
            .count() as u64;
        Ok(())
    })?;
    if count == 0 {
        return Err(WriteError::NoSurface("stl"));
    }
    let limit = u64::from(u32::MAX);
    if count > limit {
        return Err(WriteError::TooLarge {
            format: "stl",
            what: "triangles",
            count,
            limit,
        });
    }
    let mut sink = ByteSink::new(out);
    let mut header = [b' '; HEADER];
    // Readers take a file that begins with "solid" for text.
    let text = b"binary STL by symtet";
    header[..text.len()].copy_from_slice(text);
    sink.bytes(&header)?;
    sink.bytes(&(count as u32).to_le_bytes())?;
    mesh.triangles(&mut |block| {
        for (i, &[a, b, c]) in block.corners.iter().enumerate() {
            match turned(surface, block.front[i], block.back[i]) {
                None => {}
                Some(false) => sink.bytes(&record(a, b, c))?,
                Some(true) => sink.bytes(&record(a, c, b))?,
            }
        }
        Ok(())
    })?;
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream) -> u64 {
    HEADER as u64 + 4 + 50 * mesh.triangle_count()
}

/// Whether to turn a triangle over; `None` to leave it out.
fn turned(surface: Surface, front: u32, back: u32) -> Option<bool> {
    match surface {
        Surface::All => Some(false),
        Surface::Boundary => ((front == OUTSIDE) != (back == OUTSIDE)).then_some(back == OUTSIDE),
    }
}

fn record(a: DVec3, b: DVec3, c: DVec3) -> [u8; 50] {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let mut bytes = [0; 50];
    let (words, _) = bytes.as_chunks_mut::<4>();
    let numbers = [normal, a, b, c].map(|v| v.to_array());
    for (to, &x) in words.iter_mut().zip(numbers.as_flattened()) {
        *to = (x as f32).to_le_bytes();
    }
    bytes
}
