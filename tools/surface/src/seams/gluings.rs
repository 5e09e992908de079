//! The gluings of the new surface.

use super::features::NONE;
use super::maker::Maker;
use mesher::{NO_FACE, face_key};
use rustc_hash::FxHashMap;
use tmesh::Gluing;

impl Maker<'_> {
    /// The gluings of the new surface.
    pub fn gluings(&mut self) -> Vec<Gluing> {
        let mut gluings = self.input.gluings.clone();
        let mut of_face: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for (t, &face) in self.face_of.iter().enumerate() {
            if face != NO_FACE {
                of_face.entry(face).or_default().push(t as u32);
            }
        }
        for (i, gluing) in gluings.iter_mut().enumerate() {
            let pairing = self.pairings.iter().position(|p| p.wall == i);
            if let Some(number) = pairing {
                let mut pairs = std::mem::take(&mut self.pairs[number]);
                pairs.sort_unstable();
                pairs.dedup();
                let triangles = std::mem::take(&mut self.triangle_pairs[number]);
                *gluing = Gluing::seam(&gluing.name, gluing.other, gluing.step, pairs, triangles);
            } else if gluing.is_mirror(self.index) {
                let triangles = of_face.remove(&face_key(i, false)).unwrap_or_default();
                let old: Vec<u32> = gluing.vertices_here().collect();
                let mut on: Vec<u32> = self.on_wall(&old);
                let corners = |&t: &u32| self.made.triangles[t as usize].vertices;
                on.extend(triangles.iter().flat_map(corners));
                on.sort_unstable();
                on.dedup();
                gluing.vertex_pairs = on.into_iter().map(|v| [v, v]).collect();
                gluing.triangle_pairs = triangles.into_iter().map(|t| [t, t]).collect();
            } else {
                for pair in &mut gluing.vertex_pairs {
                    pair[0] = self.of_input[pair[0] as usize];
                }
                for pair in &mut gluing.triangle_pairs {
                    pair[0] = self.of_triangle[pair[0] as usize];
                }
                gluing.sort();
            }
        }
        gluings
    }

    /// New vertices at input vertices of a wall, and on edges between them.
    fn on_wall(&self, vertices: &[u32]) -> Vec<u32> {
        let mut on = vec![false; self.input.vertices.len()];
        vertices.iter().for_each(|&v| on[v as usize] = true);
        let mut found: Vec<u32> = vertices
            .iter()
            .map(|&v| self.of_input[v as usize])
            .filter(|&v| v != NONE)
            .collect();
        for ([a, b], chain) in self.features.ends.iter().zip(&self.chains) {
            if on[*a as usize] && on[*b as usize] {
                found.extend(&chain.vertices);
            }
        }
        found
    }
}
