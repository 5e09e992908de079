//! Gmsh meshes, version 2.2, binary and text: what older programs read.
//!
//! Format: Gmsh reference manual, "Legacy formats", "MSH file format version 2". Contents as in
//! version 4.1; an element's two tags are its physical group (0 for none) and its entity.

use super::write::{
    AXIS, LINE, TETRA, TRIANGLE, gmsh_order, periodic, write_comments, write_names,
};
use crate::binary::Order;
use crate::sink::ByteSink;
use crate::stream::{MeshStream, Tags, runs};
use crate::{WriteError, WriteOptions};
use std::io::{self, Write};

const LIMIT: u64 = i32::MAX as u64;

pub fn write(
    mesh: &dyn MeshStream,
    options: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let ascii = options.ascii;
    let axis = mesh.axis_edges();
    let elements = axis.len() as u64 + mesh.triangle_count() + mesh.tet_count();
    for (what, count) in [("points", mesh.point_count()), ("elements", elements)] {
        if count > LIMIT {
            return Err(WriteError::TooLarge {
                format: "msh2",
                what,
                count,
                limit: LIMIT,
            });
        }
    }
    let tags = Tags::new(mesh, &runs(mesh)?);
    let mut sink = ByteSink::new(out);
    sink.text(&format!("$MeshFormat\n2.2 {} 8\n", u8::from(!ascii)))?;
    if !ascii {
        sink.bytes(&1_u32.to_le_bytes())?;
        sink.text("\n")?;
    }
    sink.text("$EndMeshFormat\n")?;
    write_comments(mesh, &mut sink)?;
    write_names(mesh, &tags, &mut sink)?;

    write_nodes(mesh, ascii, &mut sink)?;
    sink.text(&format!("$Elements\n{elements}\n"))?;
    let mut elements = Elements {
        sink: &mut sink,
        ascii,
        next: 1,
    };
    let second = usize::from(mesh.is_second_order());
    elements.block(LINE, axis.len() as u64)?;
    for edge in axis {
        elements.element(LINE, [AXIS; 2], edge, &[])?;
    }
    elements.block(TRIANGLE[second], mesh.triangle_count())?;
    for (i, patch) in mesh.patches().iter().enumerate() {
        let tag = tags.patch(i);
        let physical = mesh.patch_name(patch.label).map_or(0, |_| tag);
        mesh.patch(i, false, &mut |part| {
            for (k, vertices) in part.vertices.iter().enumerate() {
                let middles = part.middles.get(k).map_or(&[][..], |m| &m[..]);
                elements.element(TRIANGLE[second], [physical, tag], vertices, middles)?;
            }
            Ok(())
        })?;
    }
    elements.block(TETRA[second], mesh.tet_count())?;
    mesh.tets(&mut |part| {
        for (k, vertices) in part.vertices.iter().enumerate() {
            let tag = tags.region(part.regions[k]);
            let middles = part.middles.get(k).map(|&m| gmsh_order(m));
            let middles = middles.as_ref().map_or(&[][..], |m| &m[..]);
            elements.element(TETRA[second], [tag; 2], vertices, middles)?;
        }
        Ok(())
    })?;
    sink.text(if ascii {
        "$EndElements\n"
    } else {
        "\n$EndElements\n"
    })?;
    write_periodic(mesh, &tags, &mut sink)?;
    Ok(sink.finish()?)
}

fn write_nodes(mesh: &dyn MeshStream, ascii: bool, sink: &mut ByteSink<'_>) -> io::Result<()> {
    sink.text(&format!("$Nodes\n{}\n", mesh.point_count()))?;
    let mut next = 1_u32;
    mesh.points(&mut |points| {
        for p in points {
            if ascii {
                sink.write_fmt(format_args!("{next} {:?} {:?} {:?}\n", p.x, p.y, p.z))?;
            } else {
                sink.bytes(&next.to_le_bytes())?;
                sink.points(Order::Little, std::slice::from_ref(p))?;
            }
            next += 1;
        }
        Ok(())
    })?;
    sink.text(if ascii {
        "$EndNodes\n"
    } else {
        "\n$EndNodes\n"
    })
}

pub fn size_estimate(mesh: &dyn MeshStream, options: &WriteOptions) -> u64 {
    let (tet, triangle) = if mesh.is_second_order() {
        (52, 36)
    } else {
        (28, 24)
    };
    let binary =
        28 * mesh.point_count() + tet * mesh.tet_count() + triangle * mesh.triangle_count();
    if options.ascii {
        binary * 3 / 2
    } else {
        binary
    }
}

struct Elements<'a, 'b> {
    sink: &'a mut ByteSink<'b>,
    ascii: bool,
    next: u32,
}

impl Elements<'_, '_> {
    /// Begins a run of elements of one type.
    fn block(&mut self, kind: u32, count: u64) -> io::Result<()> {
        if self.ascii || count == 0 {
            return Ok(());
        }
        self.sink.u32s(Order::Little, &[kind, count as u32, 2])
    }

    fn element(
        &mut self,
        kind: u32,
        [physical, entity]: [u32; 2],
        vertices: &[u32],
        middles: &[u32],
    ) -> io::Result<()> {
        let id = self.next;
        self.next += 1;
        let points = vertices.iter().chain(middles);
        if self.ascii {
            self.sink
                .write_fmt(format_args!("{id} {kind} 2 {physical} {entity}"))?;
            for v in points {
                self.sink.write_fmt(format_args!(" {}", v + 1))?;
            }
            return self.sink.text("\n");
        }
        let mut record = [id, physical, entity, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        for (to, v) in record[3..].iter_mut().zip(points) {
            *to = v + 1;
        }
        let length = 3 + vertices.len() + middles.len();
        self.sink.u32s(Order::Little, &record[..length])
    }
}

/// This section is text in binary files too.
fn write_periodic(
    mesh: &dyn MeshStream,
    tags: &Tags,
    sink: &mut ByteSink<'_>,
) -> Result<(), WriteError> {
    let links = periodic(mesh, tags);
    if links.is_empty() {
        return Ok(());
    }
    sink.write_fmt(format_args!("$Periodic\n{}\n", links.len()))?;
    for (dependent, master, at) in links {
        let coupling = &mesh.couplings()[at];
        sink.write_fmt(format_args!("2 {dependent} {master}\nAffine"))?;
        for x in coupling.affine() {
            sink.write_fmt(format_args!(" {x:?}"))?;
        }
        sink.write_fmt(format_args!("\n{}\n", coupling.points.len()))?;
        for [low, high] in &coupling.points {
            sink.write_fmt(format_args!("{} {}\n", high + 1, low + 1))?;
        }
    }
    Ok(sink.text("$EndPeriodic\n")?)
}
