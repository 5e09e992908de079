//! What a template's walls mean for its triangles: which face of which wall they are on, and what must be preserved.

use tmesh::{Document, FixedSet, Template, Wall};

/// Not on any wall.
pub const NO_FACE: u32 = 0;

/// Key of a wall's face: `second` for the high face of a seam.
pub fn face_key(wall: usize, second: bool) -> u32 {
    1 + 2 * wall as u32 + u32::from(second)
}

/// Whether a template may refine the faces that others list as hub walls: what lists them is given
/// the result. A template with a seam has its surface settled before, a listed face is not its own.
pub fn leads(document: &Document, index: usize) -> bool {
    let walls = &document.templates[index].walls;
    walls.iter().all(|w| matches!(w, Wall::Mirror(_)))
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
}

impl Faces {
    /// Looks through the walls of template `index`, and those of others that name it.
    pub fn new(document: &Document, index: usize) -> Self {
        let template = &document.templates[index];
        let n = template.triangles.len();
        let mut of_triangle = vec![NO_FACE; n];
        let mut preserved = vec![false; n];
        for (w, wall) in template.walls.iter().enumerate() {
            match wall {
                Wall::Mirror(m) => {
                    for &t in &m.triangles {
                        of_triangle[t as usize] = face_key(w, false);
                    }
                }
                Wall::Seam(s) => {
                    for &[low, high] in &s.triangle_pairs {
                        of_triangle[low as usize] = face_key(w, false);
                        of_triangle[high as usize] = face_key(w, true);
                    }
                }
                Wall::Hub(h) => {
                    for &[here, _] in &h.triangle_pairs {
                        of_triangle[here as usize] = face_key(w, false);
                    }
                }
            }
            if !matches!(wall, Wall::Mirror(_)) {
                for t in wall.triangles() {
                    preserved[t as usize] = true;
                }
            }
        }
        let mut key = face_key(template.walls.len(), false);
        let free = leads(document, index);
        for other in &document.templates {
            for wall in &other.walls {
                if let Wall::Hub(h) = wall
                    && h.other as usize == index
                {
                    for &[_, t] in &h.triangle_pairs {
                        preserved[t as usize] |= !free;
                        if of_triangle[t as usize] == NO_FACE {
                            of_triangle[t as usize] = key;
                        }
                    }
                    key += 1;
                }
            }
        }
        Self {
            of_triangle,
            preserved,
            planes: planes(template),
            own: (template.walls.iter())
                .map(|w| !matches!(w, Wall::Hub(_)))
                .collect(),
        }
    }

    /// Whether anything must be preserved.
    pub fn preserve(&self) -> bool {
        self.preserved.contains(&true)
    }

    /// Whether a face, by its key, is one where the template meets its own images.
    pub fn is_glued_to_itself(&self, face: u32) -> bool {
        let wall = face.checked_sub(1).map(|k| k as usize / 2);
        wall.is_some_and(|w| self.own.get(w) == Some(&true))
    }
}

/// Planes through the axis that contain faces of a template's walls, each with its vertices.
fn planes(template: &Template) -> Vec<Upright> {
    let mut planes = Vec::new();
    for wall in &template.walls {
        match wall {
            Wall::Mirror(mirror) => {
                if let FixedSet::Vertical { cos, sin } = FixedSet::of(mirror.reflection) {
                    planes.push(Upright {
                        direction: [cos, sin],
                        vertices: mirror.vertices.clone(),
                    });
                }
            }
            // The low face of a seam is at angle 0 in the canonical frame.
            Wall::Seam(seam) => {
                planes.push(Upright {
                    direction: seam.rotation.cos_sin().into(),
                    vertices: seam.vertex_pairs.iter().map(|p| p[1]).collect(),
                });
            }
            Wall::Hub(_) => {}
        }
    }
    planes
}
