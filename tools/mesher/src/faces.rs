//! What a template's walls mean for its triangles: which face of which wall they are on, and what must be preserved.

use crate::Piece;
use tmesh::{Document, FixedSet, Template};

/// Not on any wall.
pub const NO_FACE: u32 = 0;

/// Key of a wall's face: `second` for the high face of a seam.
pub fn face_key(wall: usize, second: bool) -> u32 {
    1 + 2 * wall as u32 + u32::from(second)
}

/// Whether a template may refine the faces that others list as hub walls: what lists them is given
/// the result. A template with a seam has its surface settled before, a listed face is not its own.
pub fn leads(document: &Document, index: usize) -> bool {
    let gluings = &document.templates[index].gluings;
    gluings.iter().all(|gluing| gluing.is_mirror(index))
}

/// A plane through the axis with a face of a wall in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Upright {
    /// Cosine and sine of its angle.
    pub direction: [f64; 2],
    /// Vertices of the wall.
    pub vertices: Vec<u32>,
}

/// What a template's walls mean for its triangles.
#[derive(Default)]
pub struct Faces {
    /// Wall face of each triangle, or [`NO_FACE`].
    pub of_triangle: Vec<u32>,
    /// Triangles that must come back as they are: seams, own hub walls, and faces that other
    /// templates list as hub walls unless this one leads.
    pub preserved: Vec<bool>,
    /// Planes through the axis that contain faces.
    pub planes: Vec<Upright>,
    /// Of each wall, whether the template meets its own images there.
    own: Vec<bool>,
    /// Whether the surface has edges that copies share by a step that moves them. Where the body only touches a wall,
    /// there is no triangle of the wall to tell, and edges that were divided would have no partner.
    shares_edges: bool,
}

impl Faces {
    /// Looks through the walls of a template, and those of others that name it.
    pub fn new(piece: Piece<'_>) -> Self {
        let Piece {
            document,
            index,
            template,
            ..
        } = piece;
        let n = template.triangles.len();
        let mut of_triangle = vec![NO_FACE; n];
        let mut preserved = vec![false; n];
        for (w, gluing) in template.gluings.iter().enumerate() {
            let is_seam = gluing.is_seam(index);
            for &[here, there] in &gluing.triangle_pairs {
                of_triangle[here as usize] = face_key(w, is_seam);
                if is_seam {
                    of_triangle[there as usize] = face_key(w, false);
                }
            }
            if !gluing.is_mirror(index) {
                for t in gluing.triangles_of(index) {
                    preserved[t as usize] = true;
                }
            }
        }
        let mut key = face_key(template.gluings.len(), false);
        let free = leads(document, index);
        for (o, other) in document.templates.iter().enumerate() {
            let named = other.gluings.iter();
            for gluing in named.filter(|gluing| gluing.other_than(o) == Some(index)) {
                for t in gluing.triangles_there() {
                    preserved[t as usize] |= !free;
                    if of_triangle[t as usize] == NO_FACE {
                        of_triangle[t as usize] = key;
                    }
                }
                key += 1;
            }
        }
        Self {
            of_triangle,
            preserved,
            planes: planes(template, index),
            own: (template.gluings.iter())
                .map(|gluing| gluing.other_than(index).is_none())
                .collect(),
            shares_edges: shares_edges(template, index),
        }
    }

    /// Whether anything must be preserved.
    pub fn preserve(&self) -> bool {
        self.shares_edges || self.preserved.contains(&true)
    }

    /// Whether a face, by its key, is one where the template meets its own images.
    pub fn is_glued_to_itself(&self, face: u32) -> bool {
        let wall = face.checked_sub(1).map(|k| k as usize / 2);
        wall.is_some_and(|w| self.own.get(w) == Some(&true))
    }
}

/// Whether the surface has an edge on a face that is glued to another one of the template. Edges on the axis count
/// only if the step does not leave them in place: those that it does may be divided, each point being its own partner.
fn shares_edges(template: &Template, own: usize) -> bool {
    let mut gluings = template.gluings.iter().filter(|gluing| gluing.is_seam(own));
    gluings.any(|gluing| {
        let mut on = vec![false; template.vertices.len()];
        gluing.vertices_of(own).for_each(|v| on[v as usize] = true);
        if FixedSet::of(gluing.step) == FixedSet::Axis {
            template.axis.iter().for_each(|&v| on[v as usize] = false);
        }
        let mut triangles = template.triangles.iter();
        triangles.any(|t| {
            let shared = t.vertices.iter().filter(|&&v| on[v as usize]);
            shared.count() > 1
        })
    })
}

/// Planes through the axis that contain faces of a template's walls, each with its vertices: a mirror's own, that of both
/// halves of a face that a half turn exchanges, else that of the image under the step, since the master is at angle 0.
fn planes(template: &Template, own: usize) -> Vec<Upright> {
    let gluings = template.gluings.iter();
    let own_faces = gluings.filter(|gluing| gluing.other_than(own).is_none());
    own_faces
        .filter_map(|gluing| match FixedSet::of(gluing.step) {
            FixedSet::Vertical { cos, sin } | FixedSet::Radial { cos, sin } => Some(Upright {
                direction: [cos, sin],
                vertices: gluing.vertices_of(own).collect(),
            }),
            FixedSet::Axis | FixedSet::Origin => Some(Upright {
                direction: gluing.step.cos_sin().into(),
                vertices: gluing.vertices_here().collect(),
            }),
            FixedSet::Horizontal | FixedSet::All => None,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use tmesh::{Gluing, Isometry, OUTSIDE, Triangle};

    /// A tetrahedron of which an edge, between its first two vertices, lies on a wall.
    fn touching(edge: [DVec3; 2], gluing: Gluing, axis: &[u32]) -> Document {
        let apexes = [0.2, -0.2].map(|z| 0.5 * (edge[0] + edge[1]) + DVec3::new(0.4, 0.3, z));
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        Document::single(Template {
            vertices: edge.into_iter().chain(apexes).collect(),
            triangles: faces
                .map(|vertices| Triangle {
                    vertices,
                    marker: 0,
                    front: OUTSIDE,
                    back: 1,
                })
                .to_vec(),
            gluings: vec![gluing],
            axis: axis.to_vec(),
            ..Template::default()
        })
    }

    #[test]
    fn edges_that_only_touch_a_half_turn_wall_are_not_divided() {
        let faces = |document: &Document| Faces::new(Piece::of(document, 0));
        let itself = [[0, 0], [1, 1]];
        let radial = [DVec3::X, 2.0 * DVec3::X];
        let turn = Gluing::seam("turn-a", 0, Isometry::half_turn(0, 1), itself, []);
        let mirror = Gluing::mirror("wall-a", 0, Isometry::MIRROR, [0, 1], []);
        assert!(faces(&touching(radial, turn, &[])).preserve());
        assert!(!faces(&touching(radial, mirror, &[])).preserve());
        // Points of the axis stay in place under a rotation, but not under what turns the axis over.
        let along = [-DVec3::Z, DVec3::Z];
        let seam = Gluing::seam("seam", 0, Isometry::rotation(1, 3), itself, []);
        assert!(!faces(&touching(along, seam, &[0, 1])).preserve());
        let turn = Gluing::seam("turn-a", 0, Isometry::half_turn(0, 1), [[0, 1], [1, 0]], []);
        assert!(faces(&touching(along, turn, &[0, 1])).preserve());
    }
}
