//! Input of Abaqus and CalculiX: the mesh with its sets, to be included in a deck.
//!
//! Format: CalculiX CrunchiX user's manual, "Input deck format". Sets of elements are regions; sets
//! of nodes and surfaces made of element faces are markers and walls. On a sector with a seam there
//! are a tie of the two faces and the number of sectors with two points of the axis, and of every
//! set of nodes the part that is not tied, for boundary conditions. Where a parity is given for a
//! mirror plane, its condition is there. Names are made to fit: letters, digits, `_` and `-`, unique
//! without regard to case.

use super::bytes::ByteSink;
use super::tags::{Tags, runs};
use super::title::one_line;
use super::{Parity, WriteError, conditions};
use crate::{Coupling, Label, MeshStream, Side};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;
use std::io::{self, Write};

/// Longest name.
const MAX_NAME: usize = 60;
/// Nodes per line.
const PER_LINE: usize = 10;
/// Number of the face opposite to each vertex.
const FACE: [u8; 4] = [3, 4, 2, 1];
const LIMIT: u64 = i32::MAX as u64;

/// Writes the file; `parities` are those of the walls, by position.
pub fn write(
    mesh: &dyn MeshStream,
    parities: &[Option<Parity>],
    out: &mut dyn Write,
) -> Result<(), WriteError> {
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
    let tags = Tags::new(mesh, &runs);
    let mut sink = ByteSink::new(out);
    let regions = tags.regions().iter();
    let region_names = fitting(regions.map(|&(id, _)| Some(mesh.region_name(id))));
    let patches = mesh.patches().iter();
    // The axis has a set of nodes too.
    let named = std::iter::once(Some("axis".to_owned()));
    let patch_names = fitting(named.chain(patches.map(|p| mesh.patch_name(p.label))));
    let patch_names = &patch_names[1..];
    sink.text(&format!("*HEADING\n{}\n", heading(&mesh.title())))?;
    for (&(id, _), name) in tags.regions().iter().zip(&region_names) {
        let given = one_line(&mesh.region_name(id));
        sink.text(&format!("** region {id} {given}: ELSET {name}\n"))?;
    }
    for (patch, name) in mesh.patches().iter().zip(patch_names) {
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
    sink.text("*NODE, NSET=all-nodes\n")?;
    let mut next = 1_u64;
    mesh.points(&mut |points| {
        for p in points {
            let [x, y, z] = p.to_array().map(coordinate);
            sink.write_fmt(format_args!("{next}, {x}, {y}, {z}\n"))?;
            next += 1;
        }
        Ok(())
    })?;
    let second = mesh.is_second_order();
    let mut names = runs.iter().map(|run| {
        let at = tags.regions().binary_search_by_key(&run.region, |r| r.0);
        (at.map_or("", |i| region_names[i].as_str()), run.count)
    });
    let (mut left, mut next) = (0, 1_u64);
    mesh.tets(&mut |part| {
        for (k, tet) in part.vertices.iter().enumerate() {
            if left == 0
                && let Some((name, count)) = names.next()
            {
                let kind = if second { "C3D10" } else { "C3D4" };
                sink.write_fmt(format_args!("*ELEMENT, TYPE={kind}, ELSET={name}\n"))?;
                left = count;
            }
            element(&mut sink, next, tet, part.middles.get(k).map(|m| &m[..]))?;
            next += 1;
            left -= 1;
        }
        Ok(())
    })?;
    if mesh.tet_count() > 0 {
        sink.text("*ELSET, ELSET=all-elements\n")?;
        for chunk in region_names.chunks(8) {
            sink.text(&format!("{}\n", chunk.join(", ")))?;
        }
    } else {
        write_shells(mesh, patch_names, &mut sink)?;
    }
    let tied = tied(mesh);
    write_node_sets(mesh, patch_names, &tied, &mut sink)?;
    if mesh.tet_count() > 0 {
        write_surfaces(mesh, patch_names, &mut sink)?;
    }
    write_axis(mesh, &mut sink)?;
    write_ties(mesh, patch_names, &mut sink)?;
    conditions::write(mesh, parities, &tied, &mut sink)?;
    Ok(sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream) -> u64 {
    let tet = if mesh.is_second_order() { 80 } else { 36 };
    60 * mesh.point_count() + tet * mesh.tet_count() + 22 * mesh.triangle_count()
}

/// A number in at most 20 characters, all that CalculiX reads of one; 14 significant digits where the
/// shortest exact form is longer.
pub fn coordinate(x: f64) -> String {
    let exact = format!("{x:?}");
    if exact.len() <= 20 {
        return exact;
    }
    let digits = format!("{x:.13e}");
    if digits.len() <= 20 {
        return digits;
    }
    format!("{x:.12e}")
}

fn heading(title: &str) -> String {
    // A line is limited, and an asterisk begins a keyword.
    let mut line = one_line(title).replace('*', " ");
    line.truncate(line.floor_char_boundary(120));
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

/// Names that the format can hold, unique, in the same order; what has no name is called so.
fn fitting(names: impl Iterator<Item = Option<String>>) -> Vec<String> {
    let mut seen: BTreeSet<String> = BTreeSet::new();
    for taken in ["all-nodes", "all-elements"] {
        seen.insert(taken.to_owned());
    }
    names
        .map(|name| {
            let name = name.unwrap_or_else(|| "unnamed".to_owned());
            let valid = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            let mut base: String = name
                .chars()
                .map(|c| if valid(c) { c } else { '_' })
                .collect();
            if !base.starts_with(|c: char| c.is_ascii_alphabetic()) {
                base.insert(0, 'n');
            }
            base.truncate(MAX_NAME);
            let mut candidate = base.clone();
            let mut n = 1;
            while !seen.insert(candidate.to_ascii_lowercase()) {
                n += 1;
                candidate = format!("{base}-{n}");
            }
            candidate
        })
        .collect()
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

/// Points whose values the tie of a seam or the solver's own conditions on the axis give.
fn tied(mesh: &dyn MeshStream) -> FxHashSet<u32> {
    let couplings = mesh.couplings().iter().filter(|c| c.low != c.high);
    couplings.flat_map(|c| &c.points).map(|p| p[0]).collect()
}

/// Points of each patch, each once and increasing, by way of a bit per point of the mesh; where some
/// of them are tied, the others once more.
fn write_node_sets(
    mesh: &dyn MeshStream,
    names: &[String],
    tied: &FxHashSet<u32>,
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    let mut set = vec![0_u64; mesh.point_count().div_ceil(64) as usize];
    let taken = names.iter().cloned().map(Some);
    let untied = names.iter().map(|n| Some(format!("{n}-untied")));
    let untied = fitting(taken.chain(untied)).split_off(names.len());
    for (i, name) in names.iter().enumerate() {
        if mesh.patches()[i].label == Label::Unnamed {
            continue;
        }
        let mut touched: Vec<u32> = Vec::new();
        mesh.patch(i, false, &mut |part| {
            let vertices = part.vertices.iter().flatten();
            for &v in vertices.chain(part.middles.iter().flatten()) {
                let bits = &mut set[v as usize / 64];
                if *bits == 0 {
                    touched.push(v / 64);
                }
                *bits |= 1 << (v % 64);
            }
            Ok(())
        })?;
        touched.sort_unstable();
        let mut nodes = Vec::new();
        for at in touched {
            let mut bits = std::mem::take(&mut set[at as usize]);
            while bits != 0 {
                nodes.push(64 * at + bits.trailing_zeros());
                bits &= bits - 1;
            }
        }
        write_set(name, &nodes, sink)?;
        let count = nodes.len();
        nodes.retain(|v| !tied.contains(v));
        if !nodes.is_empty() && nodes.len() < count {
            write_set(&untied[i], &nodes, sink)?;
        }
    }
    Ok(())
}

fn write_set(name: &str, nodes: &[u32], sink: &mut ByteSink<'_>) -> io::Result<()> {
    sink.text(&format!("*NSET, NSET={name}\n"))?;
    for line in nodes.chunks(PER_LINE) {
        for (k, v) in line.iter().enumerate() {
            let end = match (k + 1 == line.len(), k + 1 == PER_LINE) {
                (true, true) => ",\n",
                (true, false) => "\n",
                _ => ", ",
            };
            sink.write_fmt(format_args!("{}{end}", u64::from(*v) + 1))?;
        }
    }
    Ok(())
}

fn write_surfaces(
    mesh: &dyn MeshStream,
    names: &[String],
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    for (i, name) in names.iter().enumerate() {
        if mesh.patches()[i].label == Label::Unnamed {
            continue;
        }
        let mut begun = false;
        mesh.patch(i, true, &mut |part| {
            for side in part.sides.iter().filter(|s| s.tet != Side::NONE) {
                if !begun {
                    sink.text(&format!("*SURFACE, NAME={name}, TYPE=ELEMENT\n"))?;
                    begun = true;
                }
                let face = FACE[usize::from(side.opposite) % 4];
                sink.write_fmt(format_args!("{}, S{face}\n", side.tet + 1))?;
            }
            Ok(())
        })?;
    }
    Ok(())
}

fn write_axis(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
    let edges = mesh.axis_edges();
    if edges.is_empty() {
        return Ok(());
    }
    sink.text("*NSET, NSET=axis\n")?;
    let points: BTreeSet<u32> = edges.iter().flatten().copied().collect();
    for v in points {
        sink.text(&format!("{},\n", u64::from(v) + 1))?;
    }
    Ok(())
}

/// Ties of the faces of seams, and the cyclic symmetry of a sector that has one seam.
fn write_ties(mesh: &dyn MeshStream, names: &[String], sink: &mut ByteSink<'_>) -> io::Result<()> {
    let name = |wall: u32| {
        let mut patches = mesh.patches().iter();
        let at = patches.position(|p| p.label == Label::Wall(wall))?;
        Some(names[at].as_str())
    };
    let mut seams: Vec<(&Coupling, u32, &str, &str)> = Vec::new();
    for coupling in mesh.couplings() {
        if let (Some(n), Some(low), Some(high)) =
            (coupling.sectors, name(coupling.low), name(coupling.high))
            && low != high
        {
            seams.push((coupling, n, low, high));
        }
    }
    let alike = |(coupling, n, ..): &(&Coupling, u32, &str, &str)| {
        seams.first().is_some_and(|first| first.1 == *n) && coupling.axis == seams[0].0.axis
    };
    if seams.len() < mesh.couplings().len() || !seams.iter().all(alike) {
        return sink.text(
            "** No cyclic symmetry model: the column around the axis has a symmetry of its own, and\n\
             ** faces that other sectors touch elsewhere. Cut without it (wedgecut --hub none).\n",
        );
    }
    if seams.first().is_some_and(|s| s.1 > 2) && !mesh.axis_edges().is_empty() {
        sink.text(
            "** Material lies on the axis. In frequency steps CalculiX holds these nodes by nodal diameter:\n\
             ** along the axis (1), across it (0) or both (above), each in a step of its own. For nodal\n\
             ** diameter 1 that leaves them more freedom than they have in the whole body, which has them\n\
             ** move on a circle; take its frequencies from the whole mesh.\n",
        )?;
    }
    let tied = fitting(seams.iter().map(|s| Some(s.0.name.clone())));
    for ((_, _, low, high), tie) in seams.iter().zip(&tied) {
        // The dependent face comes first; copies go from it towards the other one.
        sink.text(&format!(
            "*TIE, NAME={tie}, CYCLIC SYMMETRY\n{low}, {high}\n"
        ))?;
    }
    for ((coupling, n, ..), tie) in seams.iter().zip(&tied) {
        let points = coupling.axis.map(|p| p.to_array().map(coordinate));
        let points = points.as_flattened().join(", ");
        sink.text(&format!(
            "*CYCLIC SYMMETRY MODEL, N={n}, TIE={tie}\n{points}\n"
        ))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fit_their_field() {
        for x in [
            0.0,
            1.0 / 3.0,
            -0.060_699_450_194_871_274,
            -1.0 / 3e17,
            -1.0 / 3e200,
        ] {
            let text = coordinate(x);
            assert!(text.len() <= 20, "{text}");
            let back: f64 = text.parse().unwrap();
            assert!((back - x).abs() <= 1e-12 * x.abs(), "{text}");
        }
        assert_eq!(coordinate(0.25), "0.25");
    }

    #[test]
    fn names_fit_and_are_unique() {
        let names = ["liner/copper", "Liner_copper", "3rd", "all-nodes", "a b"];
        let fitted = fitting(names.iter().map(|n| Some((*n).to_owned())));
        let expected = [
            "liner_copper",
            "Liner_copper-2",
            "n3rd",
            "all-nodes-2",
            "a_b",
        ];
        assert_eq!(fitted, expected);
    }
}
