//! The walls of the new surface.

use super::features::NONE;
use super::maker::Maker;
use mesher::{NO_FACE, face_key};
use rustc_hash::FxHashMap;
use tmesh::Wall;

impl Maker<'_> {
    /// The walls of the new surface.
    pub fn walls(&mut self) -> Vec<Wall> {
        let mut walls = self.input.walls.clone();
        let mut of_face: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for (t, &face) in self.face_of.iter().enumerate() {
            if face != NO_FACE {
                of_face.entry(face).or_default().push(t as u32);
            }
        }
        for (i, wall) in walls.iter_mut().enumerate() {
            match wall {
                Wall::Mirror(mirror) => {
                    mirror.triangles = of_face.remove(&face_key(i, false)).unwrap_or_default();
                    let mut on: Vec<u32> = self.on_wall(&mirror.vertices);
                    let corners = |&t: &u32| self.made.triangles[t as usize].vertices;
                    on.extend(mirror.triangles.iter().flat_map(corners));
                    on.sort_unstable();
                    on.dedup();
                    mirror.vertices = on;
                }
                Wall::Seam(seam) => {
                    let number = self.pairings.iter().position(|p| p.wall == i);
                    if let Some(number) = number {
                        let mut pairs = std::mem::take(&mut self.pairs[number]);
                        pairs.sort_unstable();
                        pairs.dedup();
                        seam.vertex_pairs = pairs;
                        seam.triangle_pairs = std::mem::take(&mut self.triangle_pairs[number]);
                    }
                }
                Wall::Hub(hub) => {
                    for pair in &mut hub.vertex_pairs {
                        pair[0] = self.of_input[pair[0] as usize];
                    }
                    hub.vertex_pairs.sort_unstable();
                    for pair in &mut hub.triangle_pairs {
                        pair[0] = self.of_triangle[pair[0] as usize];
                    }
                }
            }
        }
        walls
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
