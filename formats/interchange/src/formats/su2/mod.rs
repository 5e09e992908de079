//! SU2's mesh: text, numbered from 0, each piece of the boundary a marker.
//!
//! Format: SU2 documentation, "Mesh File". The format has no materials and no faces inside: regions are
//! comments, and interfaces are left out. Two faces of a sector that are images of each other are markers, and a
//! comment says how many sectors there are.

use crate::sink::ByteSink;
use crate::stream::{MeshStream, boundary};
use crate::text::{fitting, one_line};
use crate::{WriteError, WriteOptions};
use std::io::Write;

/// Types of elements, those of VTK.
const TRIANGLE: u8 = 5;
const TETRA: u8 = 10;

/// Writes the file.
///
/// # Errors
/// Fails when writing fails, and for meshes without tetrahedra.
pub fn write(
    mesh: &dyn MeshStream,
    _: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    if mesh.tet_count() == 0 {
        return Err(WriteError::NoVolume("su2"));
    }
    let mut sink = ByteSink::new(out);
    sink.text(&format!("% {}\n", one_line(&mesh.title())))?;
    for coupling in mesh.couplings() {
        let names = [coupling.low, coupling.high].map(|wall| &mesh.wall_names()[wall as usize]);
        if let Some(sectors) = coupling.sectors {
            sink.text(&format!(
                "% {} is {} turned by 1/{sectors}\n",
                names[1], names[0]
            ))?;
        }
    }
    sink.text(&format!("NDIME= 3\nNELEM= {}\n", mesh.tet_count()))?;
    let mut next = 0_u64;
    mesh.tets(&mut |part| {
        for [a, b, c, d] in part.vertices {
            sink.write_fmt(format_args!("{TETRA} {a} {b} {c} {d} {next}\n"))?;
            next += 1;
        }
        Ok(())
    })?;
    sink.text(&format!("NPOIN= {}\n", mesh.point_count()))?;
    let mut next = 0_u64;
    mesh.points(&mut |points| {
        for p in points {
            sink.write_fmt(format_args!("{:?} {:?} {:?} {next}\n", p.x, p.y, p.z))?;
            next += 1;
        }
        Ok(())
    })?;
    let faces = boundary(mesh)?;
    let patches: Vec<_> = faces.chunk_by(|a, b| a.label == b.label).collect();
    let names = fitting(patches.iter().map(|p| mesh.patch_name(p[0].label)), &[]);
    sink.text(&format!("NMARK= {}\n", patches.len()))?;
    for (patch, name) in patches.iter().zip(names) {
        let count = patch.len();
        sink.text(&format!("MARKER_TAG= {name}\nMARKER_ELEMS= {count}\n"))?;
        for face in *patch {
            let [a, b, c] = face.vertices;
            sink.write_fmt(format_args!("{TRIANGLE} {a} {b} {c}\n"))?;
        }
    }
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, _: &WriteOptions) -> u64 {
    65 * mesh.point_count() + 40 * mesh.tet_count() + 24 * mesh.triangle_count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stream::{Plain, test_document};

    #[test]
    fn a_tetrahedron() {
        let document = test_document();
        let mut bytes = Vec::new();
        let mesh = Plain::new(&document).unwrap();
        write(&mesh, &WriteOptions::default(), &mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let expected = "% symtet mesh\nNDIME= 3\nNELEM= 1\n10 0 1 2 3 0\nNPOIN= 4\n\
                        1.0 0.0 0.0 0\n2.0 0.0 0.0 1\n1.0 1.0 0.0 2\n1.0 0.0 1.0 3\nNMARK= ";
        assert!(text.starts_with(expected), "{text}");
        assert!(
            text.contains("MARKER_TAG= floor\nMARKER_ELEMS= 1\n5 0 2 1\n"),
            "{text}"
        );
        assert!(text.contains("MARKER_TAG= top\nMARKER_ELEMS= "), "{text}");
    }

    #[test]
    fn a_surface_is_no_mesh() {
        let mut document = test_document();
        document.templates[0].tets.clear();
        let mesh = Plain::new(&document).unwrap();
        let mut bytes = Vec::new();
        let error = write(&mesh, &WriteOptions::default(), &mut bytes).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the mesh has no tetrahedra, so there is nothing to write as su2"
        );
        assert!(bytes.is_empty());
    }
}
