//! Faces of a template that are images of each other.

use tmesh::{FixedSet, Isometry, Template};

/// Two faces of a template: a master, and its image under a step. What the step leaves where it is pairs with itself.
pub struct Pairing {
    /// Number of the wall.
    pub wall: usize,
    /// Takes the master onto its image.
    pub step: Isometry,
    /// Pairs (master vertex, its image).
    pub vertices: Vec<[u32; 2]>,
    /// Pairs (master triangle, its image).
    pub triangles: Vec<[u32; 2]>,
}

impl Pairing {
    /// All pairings of template `own`. A mirror wall is its own image, and free.
    pub fn of(template: &Template, own: usize) -> Vec<Self> {
        let turned =
            |pairs: &[[u32; 2]]| pairs.iter().map(|&[here, there]| [there, here]).collect();
        let gluings = template.gluings.iter().enumerate();
        let seams = gluings.filter(|(_, gluing)| gluing.is_seam(own));
        seams
            .map(|(wall, gluing)| Self {
                wall,
                step: gluing.step,
                vertices: turned(&gluing.vertex_pairs),
                triangles: turned(&gluing.triangle_pairs),
            })
            .collect()
    }

    /// The points that the step leaves where they are.
    pub fn fixed(&self) -> FixedSet {
        FixedSet::of(self.step)
    }
}

/// The corners of a triangle's image under the step of a gluing, in the order that faces out of its template if the
/// triangle does: the step takes what is outside of the one face to the inside of the other.
pub fn facing(step: Isometry, [a, b, c]: [u32; 3]) -> [u32; 3] {
    match step.reverses_orientation() {
        true => [a, b, c],
        false => [a, c, b],
    }
}
