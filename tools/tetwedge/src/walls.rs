//! Walls before and after meshing: which triangles belong to which face, what must be preserved,
//! and the walls of the refined surface.

use glam::DVec3;
use tmesh::{Document, Gluing, Template};

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
    gluings.iter().all(|g| g.is_mirror(index))
}

/// The template that has to be meshed before this one, whose hub walls are given what came of it.
pub fn leader(document: &Document, index: usize) -> Option<usize> {
    let mut others = document.templates[index]
        .gluings
        .iter()
        .filter_map(|g| g.other_than(index));
    let first = others.next()?;
    (others.all(|o| o == first) && leads(document, first)).then_some(first)
}

/// What a template's walls mean for its triangles.
pub struct Faces {
    /// Wall face of each triangle, or [`NO_FACE`].
    pub of_triangle: Vec<u32>,
    /// Triangles that must come back as they are: seams, own hub walls, and faces that other
    /// templates list as hub walls unless this one leads.
    pub preserved: Vec<bool>,
}

impl Faces {
    /// Looks through the walls of template `index`, and those of others that name it.
    pub fn new(document: &Document, index: usize) -> Self {
        let template = &document.templates[index];
        let n = template.triangles.len();
        let mut of_triangle = vec![NO_FACE; n];
        let mut preserved = vec![false; n];
        for (w, gluing) in template.gluings.iter().enumerate() {
            let seam = gluing.is_seam(index);
            for &[here, there] in &gluing.triangle_pairs {
                of_triangle[here as usize] = face_key(w, seam);
                if seam {
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
            for gluing in &other.gluings {
                if gluing.other_than(o) != Some(index) {
                    continue;
                }
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
        }
    }

    /// Whether anything must be preserved.
    pub fn preserve(&self) -> bool {
        self.preserved.contains(&true)
    }
}

/// Projection onto a plane that new vertices belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// The plane through the axis at the angle with this cosine and sine.
    Vertical {
        /// Cosine.
        cos: f64,
        /// Sine.
        sin: f64,
    },
    /// The plane z = 0.
    Horizontal,
    /// Any plane, of a facet.
    Facet {
        /// Unit normal.
        normal: DVec3,
        /// A point of the plane.
        origin: DVec3,
    },
}

impl Projection {
    /// The projection onto a mirror wall's plane.
    pub fn of(wall: &Gluing) -> Self {
        if wall.step.flipped() {
            return Self::Horizontal;
        }
        let (cos, sin) = wall.step.half_angle();
        Self::Vertical { cos, sin }
    }

    /// The nearest point of the plane; exactly y = 0 for the vertical plane at angle 0.
    pub fn apply(self, p: DVec3) -> DVec3 {
        match self {
            Self::Vertical { cos, sin } => {
                let r = p.x * cos + p.y * sin;
                // Adding zero turns a negative zero into zero.
                DVec3::new(r * cos + 0.0, r * sin + 0.0, p.z)
            }
            Self::Horizontal => DVec3::new(p.x, p.y, 0.0),
            Self::Facet { normal, origin } => p - normal * (p - origin).dot(normal),
        }
    }
}

/// Planes through the axis that contain faces of the walls of a template, `own`, as cosine and sine,
/// each with its vertices.
pub fn vertical_planes(template: &Template, own: usize) -> Vec<([f64; 2], Vec<u32>)> {
    let mut planes = Vec::new();
    for gluing in &template.gluings {
        if gluing.is_mirror(own) {
            if let Projection::Vertical { cos, sin } = Projection::of(gluing) {
                planes.push(([cos, sin], gluing.vertices_here().collect()));
            }
        } else if gluing.is_seam(own) {
            // The low face of a seam is at angle 0 in the canonical frame.
            let (cos, sin) = gluing.step.cos_sin();
            planes.push(([cos, sin], gluing.vertices_here().collect()));
        }
    }
    planes
}

/// Edges of the surface that lie on a wall or on the axis, though no triangle of the wall has them:
/// where the body only touches it.
pub fn touching_edges(template: &Template, vertices: &[u32], triangles: &[u32]) -> Vec<[u32; 2]> {
    let mut on = vec![false; template.vertices.len()];
    for &v in vertices {
        on[v as usize] = true;
    }
    let mut covered: Vec<[u32; 2]> = triangles
        .iter()
        .flat_map(|&t| edges_of(template.triangles[t as usize].vertices))
        .collect();
    covered.sort_unstable();
    let mut found: Vec<[u32; 2]> = template
        .triangles
        .iter()
        .flat_map(|t| edges_of(t.vertices))
        .filter(|e| on[e[0] as usize] && on[e[1] as usize] && covered.binary_search(e).is_err())
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

fn edges_of([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
}

/// Whether a point lies on one of the segments, within `tolerance` (model units).
pub fn on_segments(p: DVec3, segments: &[[DVec3; 2]], tolerance: f64) -> bool {
    segments.iter().any(|&[a, b]| {
        let along = b - a;
        let t = (p - a).dot(along) / along.length_squared();
        t > 0.0 && t < 1.0 && (a + along * t - p).length() <= tolerance
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{Isometry, MAX_TURN_DENOMINATOR};

    fn wall(reflection: Isometry) -> Gluing {
        Gluing::mirror("wall", 0, reflection, [], [])
    }

    #[test]
    fn projections_are_exact_where_they_can_be() {
        let low = Projection::of(&wall(Isometry::reflection(0, 1)));
        let p = low.apply(DVec3::new(-1.25, -1e-17, 0.5));
        assert_eq!(p, DVec3::new(-1.25, 0.0, 0.5));
        assert!(p.y.is_sign_positive());
        let (cos, sin) = Isometry::rotation(1, 10).cos_sin();
        let high = Projection::of(&wall(Isometry::reflection(1, 5)));
        let p = high.apply(DVec3::new(2.0 * cos, 2.0 * sin + 1e-16, 0.1));
        assert!((p - DVec3::new(2.0 * cos, 2.0 * sin, 0.1)).length() < 1e-15);
        assert_eq!(
            high.apply(DVec3::new(0.0, 0.0, 3.0)),
            DVec3::new(0.0, 0.0, 3.0)
        );
        let across = Projection::of(&wall(Isometry::FLIP));
        assert_eq!(
            across.apply(DVec3::new(1.0, 2.0, 1e-18)),
            DVec3::new(1.0, 2.0, 0.0)
        );
        // The largest denominator there is.
        let _ = Projection::of(&wall(Isometry::reflection(1, MAX_TURN_DENOMINATOR)));
    }
}
