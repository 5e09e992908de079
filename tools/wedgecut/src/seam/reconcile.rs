//! Giving two sections that are images of each other the same points.
//!
//! Where the tessellation does not share the body's symmetry, the two sections are the same curves
//! with different points on them. Each point without a partner is then inserted into an edge of the
//! other section ([`super::align`] says which), and the faces at that edge are divided.

use crate::cell::Cell;
use crate::section::{Chain, Place, Section};
use crate::surface::Surface;
use rustc_hash::FxHashMap;
use tmesh::Triangle;

/// A point of one section that the other one gets as well.
#[derive(Clone, Copy, Debug)]
pub struct Insertion {
    /// The point without partner.
    pub of: u32,
    /// Index of the edge of the other section that gets it.
    pub edge: usize,
    /// Where along that edge, from its first end (0) to its second (1).
    pub at: f64,
}

impl Insertion {
    /// The insertion of a copy of the point `of` of the other section at a place of a section's curve.
    pub fn new(section: &Section, chain: &Chain, of: u32, place: Place) -> Self {
        let edge = chain.edges[place.edge];
        let forward = section.edges[edge].ends[0] == chain.points[place.edge];
        let at = if forward { place.at } else { 1.0 - place.at };
        Self { of, edge, at }
    }
}

/// Inserts points into the edges of a section and divides the faces there. Returns the new point
/// for each insertion.
pub fn insert(
    surface: &mut Surface,
    cell: &Cell,
    section: &mut Section,
    insertions: &[Insertion],
) -> Vec<u32> {
    let mut order: Vec<usize> = (0..insertions.len()).collect();
    order.sort_by(|&i, &j| {
        let (a, b) = (&insertions[i], &insertions[j]);
        a.edge
            .cmp(&b.edge)
            .then(a.at.total_cmp(&b.at))
            .then(a.of.cmp(&b.of))
    });
    let mut new = vec![0; insertions.len()];
    let mut chains: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
    for i in order {
        let insertion = &insertions[i];
        let ends = section.edges[insertion.edge].ends;
        let [a, b] = ends.map(|v| surface.points[v as usize]);
        let classes = ends.map(|v| surface.classes[v as usize]);
        let (p, class) = cell.on_edge(cell.between(a, b, insertion.at), classes);
        new[i] = surface.add(p, class);
        section.points.push(new[i]);
        chains.entry(ends).or_default().push(new[i]);
    }
    section.points.sort_unstable();
    let edges = std::mem::take(&mut section.edges);
    for e in edges {
        let Some(chain) = chains.get(&e.ends) else {
            section.edges.push(e);
            continue;
        };
        let stops: Vec<u32> = [e.ends[0]]
            .into_iter()
            .chain(chain.iter().copied())
            .chain([e.ends[1]])
            .collect();
        for pair in stops.windows(2) {
            let mut piece = e;
            piece.ends = [pair[0], pair[1]];
            if pair[0] > pair[1] {
                piece.ends.reverse();
                std::mem::swap(&mut piece.left, &mut piece.right);
            }
            section.edges.push(piece);
        }
    }
    section.edges.sort_unstable_by_key(|e| e.ends);
    divide_faces(surface, &chains);
    new
}

fn divide_faces(surface: &mut Surface, chains: &FxHashMap<[u32; 2], Vec<u32>>) {
    let faces = std::mem::take(&mut surface.faces);
    let patches = std::mem::take(&mut surface.patches);
    for (face, patch) in faces.into_iter().zip(patches) {
        let divided = (0..3).find_map(|k| {
            let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
            let key = if v < w { [v, w] } else { [w, v] };
            chains.get(&key).map(|chain| (k, chain, v > w))
        });
        let Some((k, chain, backwards)) = divided else {
            surface.faces.push(face);
            surface.patches.push(patch);
            continue;
        };
        let (v, w, apex) = (
            face.vertices[k],
            face.vertices[(k + 1) % 3],
            face.vertices[(k + 2) % 3],
        );
        let mut stops = vec![v];
        if backwards {
            stops.extend(chain.iter().rev());
        } else {
            stops.extend(chain);
        }
        stops.push(w);
        for pair in stops.windows(2) {
            surface.faces.push(Triangle {
                vertices: [pair[0], pair[1], apex],
                ..face
            });
            surface.patches.push(patch);
        }
    }
}
