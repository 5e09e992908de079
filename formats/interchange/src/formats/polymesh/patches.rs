//! The pieces of the boundary.

use super::face::Face;
use super::lists::head;
use crate::sink::ByteSink;
use crate::stream::{BoundaryFace, Coupling, Label, MeshStream, boundary};
use crate::text::fitting;
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::io;

/// Faces of the boundary with the same label.
pub struct Patch {
    label: Label,
    /// How many there are.
    count: usize,
    kind: Kind,
}

/// What holds at a patch.
enum Kind {
    /// Nothing that follows from the mesh.
    Plain,
    /// It lies on a mirror plane.
    Mirror,
    /// It is the image of another patch by a rotation.
    Cyclic { other: Label, axis: [DVec3; 2] },
}

/// The faces of the boundary, patch by patch, and the patches. `open` has the faces of one tetrahedron,
/// increasing in the sorted vertices that they come with.
pub fn patches(
    mesh: &dyn MeshStream,
    open: &[([u32; 3], Face)],
) -> io::Result<(Vec<Face>, Vec<Patch>)> {
    let mut listed = vec![false; open.len()];
    let mut find = |vertices: [u32; 3]| {
        let mut key = vertices;
        key.sort_unstable();
        let at = open.binary_search_by_key(&key, |o| o.0).ok()?;
        let face = Face {
            vertices,
            ..open[at].1
        };
        (!std::mem::replace(&mut listed[at], true)).then_some(face)
    };
    let surface = boundary(mesh)?;
    let cyclic: Vec<&Coupling> = mesh.couplings().iter().filter(|c| is_cyclic(c)).collect();
    let in_order = cyclic.iter().map(|c| paired(c, &surface));
    let in_order: FxHashMap<Label, Vec<[u32; 3]>> = in_order.flatten().collect();
    let (mut faces, mut patches) = (Vec::new(), Vec::new());
    for piece in surface.chunk_by(|a, b| a.label == b.label) {
        let label = piece[0].label;
        let before = faces.len();
        match in_order.get(&label) {
            Some(list) => faces.extend(list.iter().filter_map(|&v| find(v))),
            None => faces.extend(piece.iter().filter_map(|face| find(face.vertices))),
        }
        let kind = match in_order.contains_key(&label) {
            true => cyclic_kind(&cyclic, label),
            false => kind(mesh, label),
        };
        patches.push(Patch {
            label,
            count: faces.len() - before,
            kind,
        });
    }
    let rest = open.iter().zip(&listed).filter(|(_, listed)| !**listed);
    let rest: Vec<Face> = rest.map(|((_, face), _)| *face).collect();
    if !rest.is_empty() {
        patches.push(Patch {
            label: Label::Unnamed,
            count: rest.len(),
            kind: Kind::Plain,
        });
        faces.extend(rest);
    }
    Ok((faces, patches))
}

/// Whether two different faces are images of each other by a rotation about the axis.
fn is_cyclic(coupling: &Coupling) -> bool {
    coupling.sectors.is_some() && coupling.low != coupling.high
}

/// The two faces of a coupling, triangle by triangle in the same order; each begins with the same corner and goes
/// the other way round. None where the pairs are not all that the faces consist of.
fn paired(coupling: &Coupling, surface: &[BoundaryFace]) -> Vec<(Label, Vec<[u32; 3]>)> {
    let labels = [coupling.low, coupling.high].map(Label::Wall);
    let count = |label: Label| surface.iter().filter(|f| f.label == label).count();
    let image: FxHashMap<u32, u32> = coupling.points.iter().map(|p| (p[0], p[1])).collect();
    let of_position: FxHashMap<u64, &BoundaryFace> =
        surface.iter().map(|f| (f.position, f)).collect();
    let pairs = coupling.triangles.iter().map(|[low, high]| {
        let low = of_position.get(low).filter(|f| f.label == labels[0])?;
        of_position.get(high).filter(|f| f.label == labels[1])?;
        let [a, b, c] = low.vertices;
        let image = |v: u32| image.get(&v).copied();
        Some(([a, b, c], [image(a)?, image(c)?, image(b)?]))
    });
    let pairs: Option<Vec<_>> = pairs.collect();
    let pairs = pairs.filter(|pairs| labels.iter().all(|&l| count(l) == pairs.len()));
    pairs.map_or(Vec::new(), |pairs| {
        let (low, high) = pairs.into_iter().unzip();
        vec![(labels[0], low), (labels[1], high)]
    })
}

fn cyclic_kind(cyclic: &[&Coupling], label: Label) -> Kind {
    let sides = |c: &Coupling| [c.low, c.high].map(Label::Wall);
    let coupling = cyclic.iter().find(|c| sides(c).contains(&label));
    coupling.map_or(Kind::Plain, |coupling| {
        let [low, high] = sides(coupling);
        Kind::Cyclic {
            other: if label == low { high } else { low },
            axis: coupling.axis,
        }
    })
}

fn kind(mesh: &dyn MeshStream, label: Label) -> Kind {
    let normals = mesh.wall_normals();
    let is_mirror = |wall: u32| matches!(normals.get(wall as usize), Some(Some(_)));
    match label {
        Label::Wall(wall) if is_mirror(wall) => Kind::Mirror,
        _ => Kind::Plain,
    }
}

/// Writes the list of patches, whose faces come after those inside.
pub fn write(
    mesh: &dyn MeshStream,
    patches: &[Patch],
    inner: usize,
    sink: &mut ByteSink<'_>,
) -> io::Result<()> {
    head(sink, "polyBoundaryMesh", None, "boundary")?;
    let labels = patches.iter().map(|p| p.label);
    let names = fitting(labels.clone().map(|label| mesh.patch_name(label)), &[]);
    let by_label: FxHashMap<Label, &String> = labels.zip(&names).collect();
    sink.text(&format!("{}\n(\n", patches.len()))?;
    let mut first = inner;
    for (patch, name) in patches.iter().zip(&names) {
        let entries = match &patch.kind {
            Kind::Plain => "    type            patch;\n".to_owned(),
            Kind::Mirror => "    type            symmetryPlane;\n".to_owned(),
            Kind::Cyclic { other, axis } => {
                let [from, to] = axis;
                let direction = *to - *from;
                let other = by_label.get(other).map_or("", |name| name.as_str());
                // The two lines of development of the program have a key of their own each.
                format!(
                    "    type            cyclic;\n    neighbourPatch  {other};\n    \
                     transform       rotational;\n    transformType   rotational;\n    \
                     rotationAxis    {};\n    rotationCentre  {};\n",
                    vector(direction),
                    vector(*from)
                )
            }
        };
        let count = patch.count;
        sink.text(&format!(
            "{name}\n{{\n{entries}    nFaces          {count};\n    startFace       {first};\n}}\n"
        ))?;
        first += count;
    }
    sink.text(")\n")
}

fn vector(v: DVec3) -> String {
    format!("({:?} {:?} {:?})", v.x, v.y, v.z)
}
