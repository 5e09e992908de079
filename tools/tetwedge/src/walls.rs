//! Walls before and after meshing: which triangles belong to which face, what must be preserved,
//! and the walls of the refined surface.

use glam::DVec3;
use tmesh::{Document, Isometry, MAX_TURN_DENOMINATOR, MirrorWall, Template, Wall};

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

/// The template that has to be meshed before this one, whose hub walls are given what came of it.
pub fn leader(document: &Document, index: usize) -> Option<usize> {
    let mut others = document.templates[index]
        .walls
        .iter()
        .filter_map(|w| match w {
            Wall::Hub(hub) => Some(hub.other as usize),
            _ => None,
        });
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
    pub fn of(wall: &MirrorWall) -> Self {
        let reflection = wall.reflection;
        if reflection.flipped() {
            return Self::Horizontal;
        }
        // The reflection by k / n of a turn fixes the plane at half that angle.
        if reflection.n() <= MAX_TURN_DENOMINATOR / 2 {
            let half = Isometry::rotation(i64::from(reflection.k()), 2 * reflection.n());
            let (cos, sin) = half.cos_sin();
            Self::Vertical { cos, sin }
        } else {
            let normal = wall.plane.normal;
            Self::Vertical {
                cos: -normal.y,
                sin: normal.x,
            }
        }
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

/// Planes through the axis that contain faces of a template's walls, as cosine and sine, each with
/// its vertices.
pub fn vertical_planes(template: &Template) -> Vec<([f64; 2], Vec<u32>)> {
    let mut planes = Vec::new();
    for wall in &template.walls {
        match wall {
            Wall::Mirror(mirror) => {
                if let Projection::Vertical { cos, sin } = Projection::of(mirror) {
                    planes.push(([cos, sin], mirror.vertices.clone()));
                }
            }
            // The low face of a seam is at angle 0 in the canonical frame.
            Wall::Seam(seam) => {
                let (cos, sin) = seam.rotation.cos_sin();
                let high = seam.vertex_pairs.iter().map(|p| p[1]);
                planes.push(([cos, sin], high.collect()));
            }
            Wall::Hub(_) => {}
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
    use tmesh::Plane;

    fn wall(reflection: Isometry, normal: DVec3) -> MirrorWall {
        MirrorWall {
            name: "wall".to_owned(),
            plane: Plane {
                normal,
                offset: 0.0,
            },
            reflection,
            vertices: Vec::new(),
            triangles: Vec::new(),
        }
    }

    #[test]
    fn projections_are_exact_where_they_can_be() {
        let low = Projection::of(&wall(Isometry::reflection(0, 1), -DVec3::Y));
        let p = low.apply(DVec3::new(-1.25, -1e-17, 0.5));
        assert_eq!(p, DVec3::new(-1.25, 0.0, 0.5));
        assert!(p.y.is_sign_positive());
        let (cos, sin) = Isometry::rotation(1, 10).cos_sin();
        let high = Projection::of(&wall(
            Isometry::reflection(1, 5),
            DVec3::new(-sin, cos, 0.0),
        ));
        let p = high.apply(DVec3::new(2.0 * cos, 2.0 * sin + 1e-16, 0.1));
        assert!((p - DVec3::new(2.0 * cos, 2.0 * sin, 0.1)).length() < 1e-15);
        assert_eq!(
            high.apply(DVec3::new(0.0, 0.0, 3.0)),
            DVec3::new(0.0, 0.0, 3.0)
        );
        let across = Projection::of(&wall(Isometry::new(0, 1, false, true), -DVec3::Z));
        assert_eq!(
            across.apply(DVec3::new(1.0, 2.0, 1e-18)),
            DVec3::new(1.0, 2.0, 0.0)
        );
        // The largest denominator there is.
        let _ = Projection::of(&wall(
            Isometry::reflection(1, MAX_TURN_DENOMINATOR),
            DVec3::Y,
        ));
    }
}
