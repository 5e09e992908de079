//! The template vertices that lie on closed walls, related by the gluings.

use super::orbit::Orbits;
use super::places::{Neighbours, Places};
use tmesh::Document;

/// The vertices that lie on closed walls, and how they relate.
pub struct Nodes {
    pub orbits: Orbits,
    /// Node per vertex of each template, or [`Nodes::NONE`]; empty for templates without closed walls.
    pub of_vertex: Vec<Vec<u32>>,
    /// Template and vertex of each node.
    pub vertex: Vec<(u32, u32)>,
}

impl Nodes {
    /// Stands for a vertex that lies on no closed wall.
    pub const NONE: u32 = u32::MAX;

    /// Relates the vertices of all gluings beyond which something is placed.
    pub fn new(document: &Document, places: &Places, neighbours: &Neighbours) -> Self {
        let mut nodes = Self {
            orbits: Orbits::new(),
            of_vertex: vec![Vec::new(); document.templates.len()],
            vertex: Vec::new(),
        };
        // The template with more instances represents shared vertices: each of the others'
        // instances leads to one of its, but not the other way round.
        let node = |nodes: &mut Self, t: usize, v: u32| {
            let of_vertex = &mut nodes.of_vertex[t];
            if of_vertex.is_empty() {
                of_vertex.resize(document.templates[t].vertices.len(), Self::NONE);
            }
            let entry = &mut of_vertex[v as usize];
            if *entry == Self::NONE {
                *entry = nodes.orbits.add(places.of_template[t].len() as u32);
                nodes.vertex.push((t as u32, v));
            }
            *entry
        };
        for (t, template) in document.templates.iter().enumerate() {
            for (w, gluing) in template.gluings.iter().enumerate() {
                if neighbours[t][w].is_none() {
                    continue;
                }
                for &[here, there] in &gluing.vertex_pairs {
                    let here = node(&mut nodes, t, here);
                    let there = node(&mut nodes, gluing.other as usize, there);
                    nodes.orbits.relate(here, gluing.step, there);
                }
            }
        }
        nodes
    }
}
