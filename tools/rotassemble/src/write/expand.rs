//! The assembled mesh as a tmesh document with one template, streamed.

use crate::mesh::Assembled;
use interchange::MeshStream;
use std::io::{self, Write};
use tmesh::{
    ChunkWriter, Document, TETS, TRIANGLES, Template, Tet, Triangle, VERTICES, Wishes,
    write_instances, write_metadata,
};

/// Writes the assembled mesh of `document`: one template in world coordinates with the identity
/// instance. Regions, markers, source, history and what was asked of the elements are those of `document`, as is the symmetry found; the
/// promise is that of the mesh.
///
/// # Errors
/// Fails when writing fails.
pub fn write_expanded(
    mesh: &Assembled<'_>,
    document: &Document,
    out: &mut dyn Write,
) -> io::Result<()> {
    let metadata = metadata(mesh, document);
    let mut chunks = ChunkWriter::begin(out)?;
    write_metadata(&metadata, &mut chunks)?;
    let bytes = |size: usize, count: u64| size as u64 * count;
    let length = bytes(size_of::<glam::DVec3>(), mesh.point_count());
    chunks.chunk(VERTICES, 0, length, |payload| {
        mesh.points(&mut |points| payload.array(points))
    })?;
    let length = bytes(size_of::<Triangle>(), mesh.triangle_count());
    chunks.chunk(TRIANGLES, 0, length, |payload| {
        let mut triangles = Vec::new();
        mesh.triangles(&mut |block| {
            triangles.clear();
            triangles.extend((0..block.vertices.len()).map(|i| Triangle {
                vertices: block.vertices[i],
                marker: block.markers[i],
                front: block.front[i],
                back: block.back[i],
            }));
            payload.array(&triangles)
        })
    })?;
    if mesh.tet_count() > 0 {
        let length = bytes(size_of::<Tet>(), mesh.tet_count());
        chunks.chunk(TETS, 0, length, |payload| {
            let mut tets = Vec::new();
            mesh.tets(&mut |block| {
                tets.clear();
                let both = block.vertices.iter().zip(block.regions);
                tets.extend(both.map(|(&vertices, &region)| Tet { vertices, region }));
                payload.array(&tets)
            })
        })?;
    }
    write_instances(&metadata.instances, &mut chunks)?;
    chunks.finish()
}

/// All of the expanded document but its template.
fn metadata(mesh: &Assembled<'_>, document: &Document) -> Document {
    let mut metadata = Document::single(Template::default());
    metadata.symmetry = document.symmetry.clone();
    metadata.search = document.search.clone();
    let promise = mesh.promise();
    metadata.promise = (!promise.group.is_trivial()).then(|| promise.clone());
    metadata.wishes = Wishes {
        // There are no faces that copies share any more.
        keep_surface: None,
        ..document.wishes.clone()
    };
    metadata.size_field = document.size_field.clone();
    metadata.regions = document.regions.clone();
    metadata.markers = document.markers.clone();
    metadata.source = document.source.clone();
    metadata.history = document.history.clone();
    metadata
}
