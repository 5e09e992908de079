//! Input of Abaqus and CalculiX: the mesh with its sets, to be included in a deck.
//!
//! Format: CalculiX CrunchiX user's manual, "Input deck format". Sets of elements are regions; sets
//! of nodes and surfaces made of element faces are markers and walls. On a sector with a seam there
//! are a tie of the two faces and the number of sectors with two points of the axis, and of every
//! set of nodes the part that is not tied, for boundary conditions. Where a parity is given for a
//! mirror plane, its condition is there. Names are made to fit: letters, digits, `_` and `-`, unique
//! without regard to case.

use super::names::fitting;
use super::number::coordinate;
use super::{conditions, cyclic, sets};
use crate::sink::ByteSink;
use crate::stream::{Label, MeshStream, Run, Tags, runs};
use crate::text::one_line;
use crate::{Parity, WriteError, WriteOptions};
use std::io::{self, Write};

/// Names of sets on one line: CalculiX reads 16, Abaqus 16.
const NAMES_PER_LINE: usize = 8;
/// CalculiX numbers nodes and elements by 32-bit integers.
const LIMIT: u64 = i32::MAX as u64;
/// Bytes of a heading: CalculiX reads lines of 132 characters and keeps less of this one.
const HEADING: usize = 120;

/// Writes the file, with conditions at the mirror planes that [`WriteOptions::parities`] names.
pub fn write(
    mesh: &dyn MeshStream,
    options: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let parities = &options.parities;
    let elements = mesh.tet_count().max(mesh.triangle_count());
    for (what, count) in [("points", mesh.point_count()), ("elements", elements)] {
        if count > LIMIT {
            return Err(WriteError::TooLarge {
                format: "inp",
                what,
                count,
                limit: LIMIT,
            });
        }
    }
    let runs = runs(mesh)?;
    let names = Names::of(mesh, &Tags::new(mesh, &runs));
    let mut sink = ByteSink::new(out);
    sink.text(&format!("*HEADING\n{}\n", heading(&mesh.title())))?;
    write_comments(mesh, &names, parities, &mut sink)?;
    write_nodes(mesh, &mut sink)?;
    if mesh.tet_count() > 0 {
        write_tets(mesh, &runs, &names, &mut sink)?;
    } else {
        write_shells(mesh, &names.patches, &mut sink)?;
    }
    let tied = cyclic::tied(mesh);
    sets::write_node_sets(mesh, &names.patches, &tied, &mut sink)?;
    if mesh.tet_count() > 0 {
        sets::write_surfaces(mesh, &names.patches, &mut sink)?;
    }
    sets::write_axis(mesh, &mut sink)?;
    cyclic::write(mesh, &names.patches, &mut sink)?;
    conditions::write(mesh, parities, &tied, &mut sink)?;
    Ok(sink.finish()?)
}

/// Names of sets as the file has them.
struct Names {
    /// Region ids that occur, with their names, increasing in id.
    regions: Vec<(u32, String)>,
    /// Name of each patch.
    patches: Vec<String>,
}

impl Names {
    fn of(mesh: &dyn MeshStream, tags: &Tags) -> Self {
        let ids = tags.regions().iter().map(|r| r.0);
        let names = fitting(ids.clone().map(|id| Some(mesh.region_name(id))));
        let patches = mesh.patches().iter();
        // The axis has a set of nodes too.
        let named = std::iter::once(Some("axis".to_owned()));
        let patches = fitting(named.chain(patches.map(|p| mesh.patch_name(p.label))));
        Self {
            regions: ids.zip(names).collect(),
            patches: patches[1..].to_vec(),
        }
    }

    fn region(&self, id: u32) -> &str {
        let found = self.regions.binary_search_by_key(&id, |r| r.0);
        found.map_or("", |i| &self.regions[i].1)
    }
}

/// Which set is what, under the names that regions, markers and walls have elsewhere.
fn write_comments(
    mesh: &dyn MeshStream,
    names: &Names,
    parities: &[Option<Parity>],
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    for (id, name) in &names.regions {
        let given = one_line(&mesh.region_name(*id));
        sink.text(&format!("** region {id} {given}: ELSET {name}\n"))?;
    }
    for (patch, name) in mesh.patches().iter().zip(&names.patches) {
        let what = match patch.label {
            Label::Marker(id) => format!("marker {id}"),
            Label::Wall(wall) => match parities.get(wall as usize).copied().flatten() {
                Some(Parity::Symmetric) => "wall with a symmetric solution".to_owned(),
                Some(Parity::Antisymmetric) => "wall with an antisymmetric solution".to_owned(),
                None => "wall".to_owned(),
            },
            Label::Unnamed => continue,
        };
        let given = one_line(&mesh.patch_name(patch.label).unwrap_or_default());
        sink.text(&format!("** {what} {given}: NSET and SURFACE {name}\n"))?;
    }
    Ok(())
}

fn write_nodes(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
    sink.text("*NODE, NSET=all-nodes\n")?;
    let mut next = 1_u64;
    mesh.points(&mut |points| {
        for p in points {
            let [x, y, z] = p.to_array().map(coordinate);
            sink.write_fmt(format_args!("{next}, {x}, {y}, {z}\n"))?;
            next += 1;
        }
        Ok(())
    })
}

fn write_tets(
    mesh: &dyn MeshStream,
    runs: &[Run],
    names: &Names,
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    let kind = if mesh.is_second_order() {
        "C3D10"
    } else {
        "C3D4"
    };
    let mut runs = runs.iter();
    let (mut left, mut next) = (0, 1_u64);
    mesh.tets(&mut |part| {
        for (k, tet) in part.vertices.iter().enumerate() {
            if left == 0
                && let Some(run) = runs.next()
            {
                let name = names.region(run.region);
                sink.write_fmt(format_args!("*ELEMENT, TYPE={kind}, ELSET={name}\n"))?;
                left = run.count;
            }
            element(sink, next, tet, part.middles.get(k).map(|m| &m[..]))?;
            next += 1;
            left -= 1;
        }
        Ok(())
    })?;
    sink.text("*ELSET, ELSET=all-elements\n")?;
    for chunk in names.regions.chunks(NAMES_PER_LINE) {
        let chunk: Vec<&str> = chunk.iter().map(|r| r.1.as_str()).collect();
        sink.text(&format!("{}\n", chunk.join(", ")))?;
    }
    Ok(())
}

pub fn size_estimate(mesh: &dyn MeshStream, _: &WriteOptions) -> u64 {
    let tet = if mesh.is_second_order() { 80 } else { 36 };
    60 * mesh.point_count() + tet * mesh.tet_count() + 22 * mesh.triangle_count()
}

fn heading(title: &str) -> String {
    // A line is limited, and an asterisk begins a keyword.
    let mut line = one_line(title).replace('*', " ");
    line.truncate(line.floor_char_boundary(HEADING));
    line
}

fn element(
    sink: &mut ByteSink<'_>,
    id: u64,
    vertices: &[u32],
    middles: Option<&[u32]>,
) -> io::Result<()> {
    sink.write_fmt(format_args!("{id}"))?;
    for v in vertices.iter().chain(middles.unwrap_or_default()) {
        sink.write_fmt(format_args!(", {}", u64::from(*v) + 1))?;
    }
    sink.text("\n")
}

/// A mesh without tetrahedra: the triangles as shells, a set per patch.
fn write_shells(
    mesh: &dyn MeshStream,
    names: &[String],
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    let mut next = 1_u64;
    for (i, name) in names.iter().enumerate() {
        let kind = if mesh.is_second_order() { "S6" } else { "S3" };
        sink.text(&format!("*ELEMENT, TYPE={kind}, ELSET={name}\n"))?;
        mesh.patch(i, false, &mut |part| {
            for (k, triangle) in part.vertices.iter().enumerate() {
                element(sink, next, triangle, part.middles.get(k).map(|m| &m[..]))?;
                next += 1;
            }
            Ok(())
        })?;
    }
    Ok(())
}
