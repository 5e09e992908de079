//! What is left open in a sector: walls, and what they have to do with each other.

use crate::numbering::Numbering;
use glam::{DMat3, DVec3};
use interchange::{Coupling, MeshStream, Middles, Plain};
use tmesh::Document;

/// What is left open in a sector; nothing in a whole mesh.
#[derive(Default)]
pub struct Open {
    /// Names of the walls.
    pub names: Vec<String>,
    /// Outward normals of those that are mirror planes.
    pub normals: Vec<Option<DVec3>>,
    /// Wall per triangle of each template, as in [`interchange::TriangleBlock::walls`]; empty when nothing is open.
    pub walls: Vec<Vec<u32>>,
    /// The faces that a solver has to couple.
    pub couplings: Vec<Coupling>,
    /// Names of faces that only other sectors adjoin, where the faces of this one that are their images are welded to others.
    pub uncoupled: Vec<String>,
    /// Edges on the axis.
    pub axis_edges: Vec<[u32; 2]>,
}

/// Where the triangles of a sector are in the mesh.
pub struct Positions<'a> {
    /// Triangles of each template that come into the mesh, increasing.
    pub kept: &'a [Vec<u32>],
    /// Position of the first triangle of each instance.
    pub first: &'a [u64],
}

impl Open {
    /// Names, pairs and axis of a sector: of a document in which each template is placed once.
    pub fn of(
        document: &Document,
        middles: Option<&Middles>,
        numbering: &Numbering,
        positions: &Positions<'_>,
    ) -> Self {
        let Some(placed) = placed_once(document) else {
            return Self::default();
        };
        let Ok(plain) = Plain::of_order(document, middles) else {
            return Self::default();
        };
        // From the ids of the templates one after the other to those of the mesh.
        let first = plain.first_ids();
        let locate = |id: u32| {
            let t = first.partition_point(|&f| f <= id) - 1;
            numbering.id(placed[t], id - first[t])
        };
        let position = positions.of_all(document, &placed);
        let mut uncoupled = Vec::new();
        let mut couplings = Vec::new();
        for coupling in plain.couplings() {
            let pairs = coupling.triangles.iter();
            let triangles: Option<Vec<[u64; 2]>> = pairs
                .map(|p| Some([position[p[0] as usize]?, position[p[1] as usize]?]))
                .collect();
            let Some(triangles) = triangles else {
                // What is welded needs no coupling.
                if coupling.matrix != DMat3::IDENTITY {
                    uncoupled.push(coupling.name.clone());
                }
                continue;
            };
            let mut points: Vec<[u32; 2]> = coupling.points.iter().map(|p| p.map(locate)).collect();
            points.sort_unstable();
            points.dedup();
            couplings.push(Coupling {
                triangles,
                points,
                ..coupling.clone()
            });
        }
        let templates = 0..document.templates.len();
        Self {
            couplings,
            uncoupled,
            axis_edges: plain.axis_edges().iter().map(|e| e.map(locate)).collect(),
            names: plain.wall_names().to_vec(),
            normals: plain.wall_normals().to_vec(),
            walls: templates.map(|t| plain.walls_of(t).to_vec()).collect(),
        }
    }
}

/// The instance of each template, if each has one.
fn placed_once(document: &Document) -> Option<Vec<usize>> {
    let mut placed = vec![None; document.templates.len()];
    for (i, instance) in document.instances.iter().enumerate() {
        if placed[instance.template as usize].replace(i).is_some() {
            return None;
        }
    }
    placed.into_iter().collect()
}

impl Positions<'_> {
    /// Position in the mesh of each triangle of the templates, one template after the other.
    fn of_all(&self, document: &Document, placed: &[usize]) -> Vec<Option<u64>> {
        let mut all = Vec::new();
        for (t, template) in document.templates.iter().enumerate() {
            let from = all.len();
            all.resize(from + template.triangles.len(), None);
            for (at, &i) in (self.first[placed[t]]..).zip(&self.kept[t]) {
                all[from + i as usize] = Some(at);
            }
        }
        all
    }
}
