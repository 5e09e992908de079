//! OpenFOAM's mesh: a folder, usually `constant/polyMesh`, of text files.
//!
//! Format: OpenFOAM User Guide, "Mesh description". Regions are cell zones. Pieces of the boundary are patches;
//! faces between regions are inside, and belong to none. Of a sector, mirror planes are of the type `symmetryPlane`,
//! and two faces that are images of each other by a rotation are `cyclic`, face by face in the same order.

mod face;
mod faces;
mod lists;
mod patches;

use crate::WriteError;
use crate::sink::ByteSink;
use crate::stream::{MeshStream, runs};
use crate::text::fitting;
use faces::Faces;
use lists::{head, write_labels};
use std::io::{self, Write};

/// The files of the folder.
pub const FILES: [&str; 6] = [
    "points",
    "faces",
    "owner",
    "neighbour",
    "boundary",
    "cellZones",
];

/// Writes one of the files, by its position in [`FILES`].
///
/// # Errors
/// Fails when writing fails, and for meshes without tetrahedra or with more faces than can be numbered.
pub fn write_file(
    mesh: &dyn MeshStream,
    file: usize,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    if mesh.tet_count() == 0 {
        return Err(WriteError::NoVolume("polymesh"));
    }
    // Labels are signed; a tetrahedron has four faces at most.
    let limit = i32::MAX as u64 / 4;
    if mesh.tet_count() > limit {
        return Err(WriteError::TooLarge {
            format: "polymesh",
            what: "tetrahedra",
            count: mesh.tet_count(),
            limit,
        });
    }
    let mut sink = ByteSink::new(out);
    match FILES[file] {
        "points" => write_points(mesh, &mut sink)?,
        "cellZones" => write_zones(mesh, &mut sink)?,
        name => {
            let faces = Faces::of(mesh)?;
            match name {
                "faces" => write_faces(&faces, &mut sink)?,
                "owner" => write_cells(mesh, &faces, &mut sink)?,
                "neighbour" => write_neighbours(mesh, &faces, &mut sink)?,
                _ => patches::write(mesh, &faces.patches, faces.inner, &mut sink)?,
            }
        }
    }
    Ok(sink.finish()?)
}

fn write_points(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
    head(sink, "vectorField", None, "points")?;
    sink.text(&format!("{}\n(\n", mesh.point_count()))?;
    mesh.points(&mut |points| {
        let mut points = points.iter();
        points.try_for_each(|p| sink.write_fmt(format_args!("({:?} {:?} {:?})\n", p.x, p.y, p.z)))
    })?;
    sink.text(")\n")
}

fn write_faces(faces: &Faces, sink: &mut ByteSink<'_>) -> io::Result<()> {
    head(sink, "faceList", None, "faces")?;
    sink.text(&format!("{}\n(\n", faces.all.len()))?;
    for face in &faces.all {
        let [a, b, c] = face.vertices;
        sink.write_fmt(format_args!("3({a} {b} {c})\n"))?;
    }
    sink.text(")\n")
}

/// The note of the lists of cells, which readers show and some use.
fn note(mesh: &dyn MeshStream, faces: &Faces) -> String {
    format!(
        "nPoints: {} nCells: {} nFaces: {} nInternalFaces: {}",
        mesh.point_count(),
        mesh.tet_count(),
        faces.all.len(),
        faces.inner
    )
}

fn write_cells(mesh: &dyn MeshStream, faces: &Faces, sink: &mut ByteSink<'_>) -> io::Result<()> {
    head(sink, "labelList", Some(&note(mesh, faces)), "owner")?;
    write_labels(sink, faces.all.iter().map(|face| face.owner))?;
    sink.text("\n")
}

fn write_neighbours(
    mesh: &dyn MeshStream,
    faces: &Faces,
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    head(sink, "labelList", Some(&note(mesh, faces)), "neighbour")?;
    let inner = faces.all[..faces.inner].iter();
    write_labels(sink, inner.map(|face| face.neighbour))?;
    sink.text("\n")
}

/// Writes a zone for each region.
fn write_zones(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
    head(sink, "regIOobject", None, "cellZones")?;
    let runs = runs(mesh)?;
    let mut ids: Vec<u32> = runs.iter().map(|run| run.region).collect();
    ids.sort_unstable();
    ids.dedup();
    let names = fitting(ids.iter().map(|&id| Some(mesh.region_name(id))), &[]);
    sink.text(&format!("{}\n(\n", ids.len()))?;
    for (id, name) in ids.into_iter().zip(names) {
        let (mut next, mut cells) = (0, Vec::new());
        for run in &runs {
            let end = next + run.count as u32;
            if run.region == id {
                cells.extend(next..end);
            }
            next = end;
        }
        sink.text(&format!(
            "{name}\n{{\n    type cellZone;\n    cellLabels List<label>\n"
        ))?;
        write_labels(sink, cells.into_iter())?;
        sink.text(";\n}\n")?;
    }
    sink.text(")\n")
}
