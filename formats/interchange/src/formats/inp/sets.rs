//! Sets of nodes and surfaces.

use super::names::fitting;
use crate::sink::ByteSink;
use crate::stream::{Label, MeshStream, Side};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;
use std::io;

/// Nodes per line: CalculiX and Abaqus read 16, and ten numbers of ten digits fit on a line of 132.
const PER_LINE: usize = 10;
/// Number of the face opposite to each vertex.
const FACE: [u8; 4] = [3, 4, 2, 1];

/// Points of each patch, each once and increasing, by way of a bit per point of the mesh; where some
/// of them are tied, the others once more.
pub fn write_node_sets(
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

/// The faces of elements that make up each patch.
pub fn write_surfaces(
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

/// The nodes on the axis.
pub fn write_axis(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
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
