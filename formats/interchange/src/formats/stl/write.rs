//! Binary STL of the surface. Coordinates are rounded to single precision.

use crate::sink::ByteSink;
use crate::stream::MeshStream;
use crate::{Surface, WriteError, WriteOptions};
use glam::DVec3;
use std::io::Write;
use tmesh::OUTSIDE;

const HEADER: usize = 80;

pub fn write(
    mesh: &dyn MeshStream,
    options: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let surface = options.surface;
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
    mesh.facets(&mut |block| {
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

pub fn size_estimate(mesh: &dyn MeshStream, _: &WriteOptions) -> u64 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::{Plain, test_document};

    fn only(surface: Surface) -> WriteOptions {
        WriteOptions {
            surface,
            ..WriteOptions::default()
        }
    }

    fn facets(surface: Surface, document: &tmesh::Document) -> Vec<[f32; 12]> {
        let mut bytes = Vec::new();
        write(&Plain::new(document).unwrap(), &only(surface), &mut bytes).unwrap();
        assert!(!bytes.starts_with(b"solid"));
        let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap());
        let (records, rest) = bytes[84..].as_chunks::<50>();
        assert_eq!((records.len(), rest.len()), (count as usize, 0));
        records
            .iter()
            .map(|r| {
                let words = r[..48].as_chunks::<4>().0;
                std::array::from_fn(|i| f32::from_le_bytes(words[i]))
            })
            .collect()
    }

    #[test]
    fn boundary_normals_point_out_whichever_way_triangles_are_stored() {
        let mut document = test_document();
        let straight = facets(Surface::Boundary, &document);
        assert_eq!(straight[0][..6], [0., 0., -1., 1., 0., 0.]);
        for t in &mut document.templates[0].triangles {
            t.vertices.swap(1, 2);
            (t.front, t.back) = (t.back, t.front);
        }
        assert_eq!(facets(Surface::Boundary, &document), straight);
        // An interface is left out, unless everything is wanted.
        document.templates[0].triangles[0].back = 7;
        assert_eq!(facets(Surface::Boundary, &document).len(), 3);
        assert_eq!(facets(Surface::All, &document).len(), 4);
    }

    #[test]
    fn no_surface_is_an_error() {
        let mut document = test_document();
        document.templates[0].triangles.clear();
        document.templates[0].gluings.clear();
        let plain = Plain::new(&document).unwrap();
        let mut bytes = Vec::new();
        let error = write(&plain, &only(Surface::All), &mut bytes).unwrap_err();
        assert!(matches!(error, WriteError::NoSurface("stl")));
        assert!(bytes.is_empty());
    }
}
