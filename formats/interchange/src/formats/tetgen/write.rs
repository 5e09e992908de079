//! TetGen's mesh: nodes, elements and faces, a text file each, numbered from 1.
//!
//! Format: TetGen manual, section "File formats". The attribute of an element is its region, the
//! marker of a face its marker or wall; comments at the end say which is which.

use crate::sink::ByteSink;
use crate::stream::{MeshStream, Tags, runs};
use crate::text::one_line;
use crate::{WriteError, WriteOptions};
use std::io::Write;

/// Extensions of the files.
pub const PARTS: [&str; 3] = ["node", "ele", "face"];

/// Writes one of the files, by its position in [`PARTS`].
pub fn write_part(
    mesh: &dyn MeshStream,
    part: usize,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let mut sink = ByteSink::new(out);
    match part {
        0 => write_nodes(mesh, &mut sink)?,
        1 => write_elements(mesh, &mut sink)?,
        _ => write_faces(mesh, &mut sink)?,
    }
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, _: &WriteOptions) -> u64 {
    58 * mesh.point_count() + 38 * mesh.tet_count() + 30 * mesh.triangle_count()
}

fn write_nodes(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> Result<(), WriteError> {
    sink.text(&format!("{} 3 0 0\n", mesh.point_count()))?;
    let mut next = 1_u64;
    mesh.points(&mut |points| {
        for p in points {
            sink.write_fmt(format_args!("{next} {:?} {:?} {:?}\n", p.x, p.y, p.z))?;
            next += 1;
        }
        Ok(())
    })?;
    Ok(sink.text(&format!("# {}\n", one_line(&mesh.title())))?)
}

fn write_elements(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> Result<(), WriteError> {
    let tags = Tags::new(mesh, &runs(mesh)?);
    sink.text(&format!("{} 4 1\n", mesh.tet_count()))?;
    let mut next = 1_u64;
    mesh.tets(&mut |part| {
        for (tet, &region) in part.vertices.iter().zip(part.regions) {
            let [a, b, c, d] = tet.map(|v| u64::from(v) + 1);
            let tag = tags.region(region);
            sink.write_fmt(format_args!("{next} {a} {b} {c} {d} {tag}\n"))?;
            next += 1;
        }
        Ok(())
    })?;
    for &(id, tag) in tags.regions() {
        sink.text(&format!("# {tag} {}\n", one_line(&mesh.region_name(id))))?;
    }
    Ok(())
}

fn write_faces(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> Result<(), WriteError> {
    let tags = Tags::new(mesh, &[]);
    sink.text(&format!("{} 1\n", mesh.triangle_count()))?;
    let mut next = 1_u64;
    for i in 0..mesh.patches().len() {
        let tag = tags.patch(i);
        mesh.patch(i, false, &mut |part| {
            for [a, b, c] in part.vertices.iter().map(|t| t.map(|v| u64::from(v) + 1)) {
                sink.write_fmt(format_args!("{next} {a} {b} {c} {tag}\n"))?;
                next += 1;
            }
            Ok(())
        })?;
    }
    for (i, patch) in mesh.patches().iter().enumerate() {
        if let Some(name) = mesh.patch_name(patch.label) {
            sink.text(&format!("# {} {}\n", tags.patch(i), one_line(&name)))?;
        }
    }
    Ok(())
}
