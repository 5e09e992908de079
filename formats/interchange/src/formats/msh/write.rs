//! Gmsh meshes, version 4.1, binary and text.
//!
//! Format: Gmsh reference manual, "MSH file format" and "Legacy formats". Regions are volume
//! entities, pieces of surface and walls are surface entities, edges on the axis are one curve
//! entity; each is a physical group with the same number and its name. Pairs of faces are the section
//! `$Periodic`: the low face is the master, and the map takes it to the high face.

use crate::binary::Order;
use crate::sink::ByteSink;
use crate::stream::{Coupling, MeshStream, Run, Tags, runs};
use crate::text::one_line;
use crate::{WriteError, WriteOptions};
use glam::DVec3;
use std::io::{self, Write};

/// Number of the curve that the axis is.
pub const AXIS: u32 = 1;

/// Gmsh's numbers of element types.
pub const LINE: u32 = 1;
pub const TRIANGLE: [u32; 2] = [2, 9];
pub const TETRA: [u32; 2] = [4, 11];

/// Longest name, without the quotes.
const MAX_NAME: usize = 127;

/// Writes numbers as the file's mode wants them: words of a text, or little-endian bytes.
struct Numbers<'a> {
    sink: ByteSink<'a>,
    ascii: bool,
    /// Whether the line has a word.
    begun: bool,
}

impl Numbers<'_> {
    fn word(&mut self, text: std::fmt::Arguments<'_>) -> io::Result<()> {
        if self.begun {
            self.sink.text(" ")?;
        }
        self.begun = true;
        self.sink.write_fmt(text)
    }

    fn ints(&mut self, values: &[u32]) -> io::Result<()> {
        if self.ascii {
            return values
                .iter()
                .try_for_each(|v| self.word(format_args!("{v}")));
        }
        self.sink.u32s(Order::Little, values)
    }

    fn sizes(&mut self, values: &[u64]) -> io::Result<()> {
        if self.ascii {
            return values
                .iter()
                .try_for_each(|v| self.word(format_args!("{v}")));
        }
        self.sink.integers(true, values)
    }

    fn doubles(&mut self, values: &[f64]) -> io::Result<()> {
        if self.ascii {
            return values
                .iter()
                .try_for_each(|v| self.word(format_args!("{v:?}")));
        }
        values
            .iter()
            .try_for_each(|v| self.sink.bytes(&v.to_le_bytes()))
    }

    /// Ends a line of text; nothing in binary.
    fn line(&mut self) -> io::Result<()> {
        self.begun = false;
        if self.ascii {
            self.sink.text("\n")
        } else {
            Ok(())
        }
    }

    fn begin(&mut self, section: &str) -> io::Result<()> {
        self.sink.text(&format!("${section}\n"))
    }

    fn end(&mut self, section: &str) -> io::Result<()> {
        let start = if self.ascii { "" } else { "\n" };
        self.sink.text(&format!("{start}$End{section}\n"))
    }
}

pub fn write(
    mesh: &dyn MeshStream,
    options: &WriteOptions,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let ascii = options.ascii;
    let runs = runs(mesh)?;
    let tags = Tags::new(mesh, &runs);
    let mut to = Numbers {
        sink: ByteSink::new(out),
        ascii,
        begun: false,
    };
    to.begin("MeshFormat")?;
    to.sink.text(&format!("4.1 {} 8\n", u8::from(!ascii)))?;
    if !ascii {
        to.sink.bytes(&1_u32.to_le_bytes())?;
    }
    to.end("MeshFormat")?;
    write_comments(mesh, &mut to.sink)?;
    write_names(mesh, &tags, &mut to.sink)?;
    write_entities(mesh, &tags, &mut to)?;
    write_nodes(mesh, &tags, &mut to)?;
    write_elements(mesh, &runs, &tags, &mut to)?;
    write_periodic(mesh, &tags, &mut to)?;
    Ok(to.sink.finish()?)
}

pub fn size_estimate(mesh: &dyn MeshStream, options: &WriteOptions) -> u64 {
    let (tet, triangle) = if mesh.is_second_order() {
        (88, 56)
    } else {
        (40, 32)
    };
    let binary =
        32 * mesh.point_count() + tet * mesh.tet_count() + triangle * mesh.triangle_count();
    if options.ascii {
        binary * 3 / 2
    } else {
        binary
    }
}

/// The title, where readers do not mind it.
pub fn write_comments(mesh: &dyn MeshStream, sink: &mut ByteSink<'_>) -> io::Result<()> {
    let title = one_line(&mesh.title()).replace('$', " ");
    sink.text(&format!("$Comments\n{title}\n$EndComments\n"))
}

/// Names of the curve, the surfaces and the volumes.
pub fn write_names(mesh: &dyn MeshStream, tags: &Tags, sink: &mut ByteSink<'_>) -> io::Result<()> {
    let mut names = Vec::new();
    if !mesh.axis_edges().is_empty() {
        names.push((1, AXIS, "axis".to_owned()));
    }
    for (i, patch) in mesh.patches().iter().enumerate() {
        if let Some(name) = mesh.patch_name(patch.label) {
            names.push((2, tags.patch(i), name));
        }
    }
    for &(id, tag) in tags.regions() {
        names.push((3, tag, mesh.region_name(id)));
    }
    if names.is_empty() {
        return Ok(());
    }
    sink.text(&format!("$PhysicalNames\n{}\n", names.len()))?;
    for (dimension, tag, name) in names {
        sink.text(&format!("{dimension} {tag} \"{}\"\n", quoted(&name)))?;
    }
    sink.text("$EndPhysicalNames\n")
}

/// A name as it can stand between quotes.
fn quoted(name: &str) -> String {
    let mut name = one_line(name).replace('"', "'");
    name.truncate(name.floor_char_boundary(MAX_NAME));
    name
}

fn bounds(mesh: &dyn MeshStream) -> io::Result<[f64; 6]> {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    mesh.points(&mut |points| {
        for &p in points {
            low = low.min(p);
            high = high.max(p);
        }
        Ok(())
    })?;
    if low.x > high.x {
        (low, high) = (DVec3::ZERO, DVec3::ZERO);
    }
    Ok([low.x, low.y, low.z, high.x, high.y, high.z])
}

/// Volumes of the file; one even when there are no tetrahedra, for points belong to an entity.
fn volumes(mesh: &dyn MeshStream, tags: &Tags) -> Vec<(u32, bool)> {
    let all: Vec<_> = tags.regions().iter().map(|&(_, tag)| (tag, true)).collect();
    if all.is_empty() && mesh.patches().is_empty() {
        vec![(1, false)]
    } else {
        all
    }
}

fn write_entities(
    mesh: &dyn MeshStream,
    tags: &Tags,
    to: &mut Numbers<'_>,
) -> Result<(), WriteError> {
    let bounds = bounds(mesh)?;
    let curves = u64::from(!mesh.axis_edges().is_empty());
    let patches = mesh.patches();
    let volumes = volumes(mesh, tags);
    to.begin("Entities")?;
    to.sizes(&[0, curves, patches.len() as u64, volumes.len() as u64])?;
    to.line()?;
    let mut entity = |tag: u32, named: bool| -> io::Result<()> {
        to.ints(&[tag])?;
        to.doubles(&bounds)?;
        to.sizes(&[u64::from(named)])?;
        if named {
            to.ints(&[tag])?;
        }
        // No entities bound it.
        to.sizes(&[0])?;
        to.line()
    };
    if curves > 0 {
        entity(AXIS, true)?;
    }
    for (i, patch) in patches.iter().enumerate() {
        entity(tags.patch(i), mesh.patch_name(patch.label).is_some())?;
    }
    for (tag, named) in volumes {
        entity(tag, named)?;
    }
    Ok(to.end("Entities")?)
}

fn write_nodes(mesh: &dyn MeshStream, tags: &Tags, to: &mut Numbers<'_>) -> Result<(), WriteError> {
    let count = mesh.point_count();
    let (dimension, entity) = match volumes(mesh, tags).first() {
        Some(&(tag, _)) => (3, tag),
        None => (2, tags.patch(0)),
    };
    to.begin("Nodes")?;
    to.sizes(&[u64::from(count > 0), count, u64::from(count > 0), count])?;
    to.line()?;
    if count > 0 {
        to.ints(&[dimension, entity, 0])?;
        to.sizes(&[count])?;
        to.line()?;
        counted(1, count, &mut |ids| {
            if !to.ascii {
                return to.sink.integers(true, ids);
            }
            ids.iter()
                .try_for_each(|id| to.sink.write_fmt(format_args!("{id}\n")))
        })?;
        mesh.points(&mut |points| {
            if !to.ascii {
                return to.sink.points(Order::Little, points);
            }
            let mut points = points.iter();
            points.try_for_each(|p| {
                to.sink
                    .write_fmt(format_args!("{:?} {:?} {:?}\n", p.x, p.y, p.z))
            })
        })?;
    }
    Ok(to.end("Nodes")?)
}

/// Gives the numbers from `first` on in blocks.
pub fn counted(
    first: u64,
    count: u64,
    sink: &mut dyn FnMut(&[u64]) -> io::Result<()>,
) -> io::Result<()> {
    let mut block = [0; 4096];
    let mut done = 0;
    while done < count {
        let step = (count - done).min(block.len() as u64);
        for (to, id) in block.iter_mut().zip(first + done..first + done + step) {
            *to = id;
        }
        sink(&block[..step as usize])?;
        done += step;
    }
    Ok(())
}

fn write_elements(
    mesh: &dyn MeshStream,
    runs: &[Run],
    tags: &Tags,
    to: &mut Numbers<'_>,
) -> Result<(), WriteError> {
    let second = usize::from(mesh.is_second_order());
    let axis = mesh.axis_edges();
    let lines = u64::from(!axis.is_empty());
    let count = axis.len() as u64 + mesh.triangle_count() + mesh.tet_count();
    to.begin("Elements")?;
    let blocks = lines + (mesh.patches().len() + runs.len()) as u64;
    to.sizes(&[blocks, count, u64::from(count > 0), count])?;
    to.line()?;
    let mut next = 1_u64;
    if lines > 0 {
        block(to, 1, AXIS, LINE, axis.len() as u64)?;
        for edge in axis {
            element(to, next, edge, &[])?;
            next += 1;
        }
    }
    for (i, patch) in mesh.patches().iter().enumerate() {
        block(to, 2, tags.patch(i), TRIANGLE[second], patch.triangles)?;
        mesh.patch(i, false, &mut |part| {
            for (k, vertices) in part.vertices.iter().enumerate() {
                let middles = part.middles.get(k).map_or(&[][..], |m| &m[..]);
                element(to, next, vertices, middles)?;
                next += 1;
            }
            Ok(())
        })?;
    }
    let mut runs = runs.iter();
    let mut left = 0;
    mesh.tets(&mut |part| {
        for (k, vertices) in part.vertices.iter().enumerate() {
            if left == 0
                && let Some(run) = runs.next()
            {
                block(to, 3, tags.region(run.region), TETRA[second], run.count)?;
                left = run.count;
            }
            match part.middles.get(k) {
                Some(&middles) => element(to, next, vertices, &gmsh_order(middles))?,
                None => element(to, next, vertices, &[])?,
            }
            next += 1;
            left -= 1;
        }
        Ok(())
    })?;
    Ok(to.end("Elements")?)
}

/// Middles of a tetrahedron in Gmsh's order: edges 01, 12, 20, 30, 32, 31.
pub fn gmsh_order([ab, bc, ac, ad, bd, cd]: [u32; 6]) -> [u32; 6] {
    [ab, bc, ac, ad, cd, bd]
}

fn block(to: &mut Numbers<'_>, dimension: u32, tag: u32, kind: u32, count: u64) -> io::Result<()> {
    to.ints(&[dimension, tag, kind])?;
    to.sizes(&[count])?;
    to.line()
}

fn element(to: &mut Numbers<'_>, id: u64, vertices: &[u32], middles: &[u32]) -> io::Result<()> {
    // The largest one has a number and ten points.
    let mut record = [id; 11];
    let points = vertices.iter().chain(middles);
    for (to, &v) in record[1..].iter_mut().zip(points) {
        *to = u64::from(v) + 1;
    }
    to.sizes(&record[..1 + vertices.len() + middles.len()])?;
    to.line()
}

/// Couplings of two different surfaces with their numbers: the dependent one and its master.
pub fn periodic(mesh: &dyn MeshStream, tags: &Tags) -> Vec<(u32, u32, usize)> {
    let couplings = mesh.couplings().iter().enumerate();
    couplings
        .filter_map(|(i, c)| {
            let (master, dependent) = (tags.wall(mesh, c.low)?, tags.wall(mesh, c.high)?);
            (master != dependent).then_some((dependent, master, i))
        })
        .collect()
}

fn write_periodic(
    mesh: &dyn MeshStream,
    tags: &Tags,
    to: &mut Numbers<'_>,
) -> Result<(), WriteError> {
    let links = periodic(mesh, tags);
    if links.is_empty() {
        return Ok(());
    }
    to.begin("Periodic")?;
    to.sizes(&[links.len() as u64])?;
    to.line()?;
    for (dependent, master, at) in links {
        let coupling: &Coupling = &mesh.couplings()[at];
        to.ints(&[2, dependent, master])?;
        to.line()?;
        to.sizes(&[16])?;
        to.doubles(&coupling.affine())?;
        to.line()?;
        to.sizes(&[coupling.points.len() as u64])?;
        to.line()?;
        for &[low, high] in &coupling.points {
            to.sizes(&[u64::from(high) + 1, u64::from(low) + 1])?;
            to.line()?;
        }
    }
    Ok(to.end("Periodic")?)
}
