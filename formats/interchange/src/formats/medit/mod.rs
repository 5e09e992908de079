//! Medit's text format, version 2 (double precision).
//!
//! Format: "MEDIT: an interactive mesh visualization software", INRIA technical report 0253, section
//! on mesh files. References of tetrahedra are regions, those of triangles are markers and walls;
//! comments at the top say which is which. Edges on the axis are edges with reference 1.

use crate::sink::ByteSink;
use crate::stream::{MeshStream, Tags, runs};
use crate::text::one_line;
use crate::{WriteError, WriteOptions};
use std::io::Write;

pub fn write(
    mesh: &dyn MeshStream,
    _: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let tags = Tags::new(mesh, &runs(mesh)?);
    let mut sink = ByteSink::new(out);
    sink.text("MeshVersionFormatted 2\n")?;
    sink.text(&format!("# {}\n", one_line(&mesh.title())))?;
    for &(id, tag) in tags.regions() {
        let name = one_line(&mesh.region_name(id));
        sink.text(&format!("# Tetrahedra {tag} {name}\n"))?;
    }
    for (i, patch) in mesh.patches().iter().enumerate() {
        if let Some(name) = mesh.patch_name(patch.label) {
            let name = one_line(&name);
            sink.text(&format!("# Triangles {} {name}\n", tags.patch(i)))?;
        }
    }
    let axis = mesh.axis_edges();
    if !axis.is_empty() {
        sink.text("# Edges 1 axis\n")?;
    }
    sink.text("Dimension 3\n")?;
    sink.text(&format!("Vertices\n{}\n", mesh.point_count()))?;
    mesh.points(&mut |points| {
        let mut points = points.iter();
        points.try_for_each(|p| sink.write_fmt(format_args!("{:?} {:?} {:?} 0\n", p.x, p.y, p.z)))
    })?;
    if !axis.is_empty() {
        sink.text(&format!("Edges\n{}\n", axis.len()))?;
        for [a, b] in axis {
            sink.write_fmt(format_args!("{} {} 1\n", a + 1, b + 1))?;
        }
    }
    if mesh.triangle_count() > 0 {
        sink.text(&format!("Triangles\n{}\n", mesh.triangle_count()))?;
    }
    for i in 0..mesh.patches().len() {
        let tag = tags.patch(i);
        mesh.patch(i, false, &mut |part| {
            for [a, b, c] in part.vertices.iter().map(|t| t.map(|v| u64::from(v) + 1)) {
                sink.write_fmt(format_args!("{a} {b} {c} {tag}\n"))?;
            }
            Ok(())
        })?;
    }
    if mesh.tet_count() > 0 {
        sink.text(&format!("Tetrahedra\n{}\n", mesh.tet_count()))?;
    }
    mesh.tets(&mut |part| {
        for (tet, &region) in part.vertices.iter().zip(part.regions) {
            let [a, b, c, d] = tet.map(|v| u64::from(v) + 1);
            let tag = tags.region(region);
            sink.write_fmt(format_args!("{a} {b} {c} {d} {tag}\n"))?;
        }
        Ok(())
    })?;
    sink.text("End\n")?;
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, _: &WriteOptions) -> u64 {
    55 * mesh.point_count() + 30 * mesh.tet_count() + 24 * mesh.triangle_count()
}
