//! The boundary of the assembled mesh: the outer faces that no gluing pairs.

use super::rim::Rim;
use crate::check::faces::sorted;
use crate::check::walls::Mesh;

/// Boundary faces of the instances to be compared.
pub struct Surface {
    /// Assembled vertices of each face, increasing.
    pub faces: Vec<[u32; 3]>,
    /// The instance of each.
    pub instances: Vec<u32>,
}

impl Surface {
    /// Collects the boundary; `on_wall` tells of each triangle of each template whether a gluing lists it.
    pub fn of(mesh: &Mesh<'_>, on_wall: &[Vec<bool>], compared: &[usize], rim: &Rim) -> Self {
        let mut surface = Self {
            faces: Vec::new(),
            instances: Vec::new(),
        };
        for &number in compared {
            let t = mesh.document.instances[number].template as usize;
            let skin = &mesh.skins[t];
            for (face, &triangle) in skin.faces.iter().zip(&skin.triangles) {
                if triangle == u32::MAX || !on_wall[t][triangle as usize] {
                    surface
                        .faces
                        .push(sorted(face.map(|v| rim.id(t, number, v))).0);
                    surface.instances.push(number as u32);
                }
            }
        }
        surface
    }

    /// Pairs of faces with the same three vertices.
    pub fn repeated(&self) -> Vec<[u32; 2]> {
        let mut order: Vec<u32> = (0..self.faces.len() as u32).collect();
        order.sort_unstable_by_key(|&f| (self.faces[f as usize], f));
        let same = |p: &&[u32]| self.faces[p[0] as usize] == self.faces[p[1] as usize];
        let pairs = order.windows(2).filter(same);
        pairs.map(|p| [p[0], p[1]]).collect()
    }
}
