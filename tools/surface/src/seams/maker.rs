//! A new surface while it is made.

use super::features::{Features, NONE};
use super::guide::Refined;
use super::pairing::Pairing;
use crate::SurfaceError;
use glam::DVec3;
use tmesh::{FixedSet, Template};

/// New points of a feature edge.
#[derive(Clone, Default)]
pub struct Chain {
    /// Vertices of the new template, from the edge's lower to its higher input vertex, without
    /// these.
    pub vertices: Vec<u32>,
    /// Whether they are not the guide's.
    pub changed: bool,
}

/// A new surface while it is made, and what it is made from.
pub struct Maker<'a> {
    /// The template as it was.
    pub input: &'a Template,
    /// Its number.
    pub index: usize,
    /// Its faces that are images of each other.
    pub pairings: &'a [Pairing],
    /// Where the surface must be fine.
    pub guide: &'a Refined,
    /// Its feature edges.
    pub features: &'a Features,
    /// Facets that stay as they are.
    pub frozen: Vec<bool>,
    /// The template as it is to be.
    pub made: Template,
    /// Wall face of each new triangle; see [`mesher::Faces`].
    pub face_of: Vec<u32>,
    /// Facet of each new triangle, `u32::MAX` for images of others.
    pub facet_of: Vec<u32>,
    /// New vertex of each input vertex.
    pub of_input: Vec<u32>,
    /// New vertex of each guide vertex.
    pub of_guide: Vec<u32>,
    /// New index of each triangle of the facets that stay.
    pub of_triangle: Vec<u32>,
    /// Vertex pairs of each pairing.
    pub pairs: Vec<Vec<[u32; 2]>>,
    /// Triangle pairs of each pairing.
    pub triangle_pairs: Vec<Vec<[u32; 2]>>,
    /// New points of each feature edge.
    pub chains: Vec<Chain>,
}

impl<'a> Maker<'a> {
    /// Begins with what stays: faces shared with another template, ends of feature edges, and the axis.
    pub fn new(
        (input, index): (&'a Template, usize),
        pairings: &'a [Pairing],
        guide: &'a Refined,
        features: &'a Features,
    ) -> Self {
        let mut frozen = vec![false; guide.facets.facets.len()];
        let shared = (input.gluings.iter()).filter(|gluing| gluing.other_than(index).is_some());
        for t in shared.flat_map(|gluing| gluing.triangles_here()) {
            frozen[guide.facets.of_triangle[t as usize] as usize] = true;
        }
        let mut maker = Self {
            input,
            index,
            pairings,
            guide,
            features,
            frozen,
            made: Template::default(),
            face_of: Vec::new(),
            facet_of: Vec::new(),
            of_input: vec![NONE; input.vertices.len()],
            of_guide: vec![NONE; guide.vertices.len()],
            of_triangle: vec![NONE; input.triangles.len()],
            pairs: Vec::new(),
            triangle_pairs: vec![Vec::new(); pairings.len()],
            chains: vec![Chain::default(); features.ends.len()],
        };
        maker.corners();
        maker
    }

    /// The error for faces that do not correspond at an input vertex.
    pub fn unmatched(&self, v: u32) -> SurfaceError {
        SurfaceError::Unmatched {
            template: self.index,
            place: self.input.vertices[v as usize],
        }
    }

    /// Adds a vertex; returns its number.
    pub fn add(&mut self, p: DVec3) -> u32 {
        self.made.vertices.push(p);
        self.made.vertices.len() as u32 - 1
    }

    /// Takes over the input vertices where feature edges end, those on the axis and on facets that
    /// stay.
    fn corners(&mut self) {
        let mut stays = vec![false; self.input.vertices.len()];
        self.input
            .axis
            .iter()
            .for_each(|&v| stays[v as usize] = true);
        self.features
            .ends
            .iter()
            .flatten()
            .for_each(|&v| stays[v as usize] = true);
        for (t, &facet) in self.guide.facets.of_triangle.iter().enumerate() {
            if self.frozen[facet as usize] {
                let corners = self.input.triangles[t].vertices;
                corners.iter().for_each(|&v| stays[v as usize] = true);
            }
        }
        for (point, &v) in self.guide.vertex_of_point.iter().enumerate() {
            if stays[v as usize] {
                let new = self.add(self.input.vertices[v as usize]);
                self.of_input[v as usize] = new;
                self.of_guide[point] = new;
            }
        }
        let new = |v: &u32| self.of_input[*v as usize];
        self.made.axis = self
            .input
            .axis
            .iter()
            .map(new)
            .filter(|&v| v != NONE)
            .collect();
        let pairs = |pairing: &Pairing| -> Vec<[u32; 2]> {
            let pairs = pairing.vertices.iter().map(|p| [new(&p[0]), new(&p[1])]);
            pairs.filter(|p| !p.contains(&NONE)).collect()
        };
        self.pairs = self.pairings.iter().map(pairs).collect();
    }

    /// The exact place of the image of a point under a pairing's step.
    pub fn image(&self, pairing: usize, p: DVec3, back: bool) -> DVec3 {
        let step = self.pairings[pairing].step;
        let step = if back { step.inverse() } else { step };
        step.apply(p)
    }

    /// The points that a pairing's step leaves where they are.
    pub fn fixed(&self, pairing: usize) -> FixedSet {
        self.pairings[pairing].fixed()
    }
}
