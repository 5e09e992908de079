//! Flats of a surface: what lies in one plane.

use geom::edges::Edges;
use glam::DVec3;

/// Cosine of the angle between triangles of one flat: a tenth of a degree.
const COPLANAR: f64 = 1.0 - 1.5e-6;
/// Vertices by which the width of a flat is measured at most.
const MOST_CORNERS: usize = 64;

/// Triangles that lie in one plane and hang together.
pub struct Flats {
    /// Flat of each triangle.
    pub of: Vec<u32>,
    /// Prefix offsets into `corners`, one more than there are flats.
    first: Vec<u32>,
    /// Some vertices of each flat.
    corners: Vec<u32>,
}

impl Flats {
    /// Grows flats from their first triangle, so that they cannot creep around a bend. Linear.
    pub fn new(triangles: &[[u32; 3]], normals: &[DVec3], edges: &Edges) -> Self {
        const NONE: u32 = u32::MAX;
        let mut beside = vec![[NONE; 3]; triangles.len()];
        for edge in 0..edges.len() {
            if let [u, v] = edges.around(edge) {
                beside[u.triangle as usize][u.corner as usize] = v.triangle;
                beside[v.triangle as usize][v.corner as usize] = u.triangle;
            }
        }
        let mut of = vec![NONE; triangles.len()];
        let (mut first, mut corners) = (vec![0], Vec::new());
        let mut queue = Vec::new();
        for seed in 0..triangles.len() {
            if of[seed] != NONE {
                continue;
            }
            let flat = first.len() as u32 - 1;
            of[seed] = flat;
            queue.push(seed);
            let mut members = Vec::new();
            while let Some(t) = queue.pop() {
                members.extend(triangles[t]);
                for s in beside[t].into_iter().filter(|s| *s != NONE) {
                    let s = s as usize;
                    if of[s] == NONE && normals[s].dot(normals[seed]) > COPLANAR {
                        of[s] = flat;
                        queue.push(s);
                    }
                }
            }
            members.sort_unstable();
            members.dedup();
            // Corners far apart in the list are far apart in the flat, more or less.
            let step = members.len().div_ceil(MOST_CORNERS);
            corners.extend(members.iter().step_by(step));
            first.push(corners.len() as u32);
        }
        Self { of, first, corners }
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.first.len() - 1
    }

    /// Some vertices of a flat.
    pub fn corners(&self, flat: u32) -> &[u32] {
        let [from, to] = [flat, flat + 1].map(|f| self.first[f as usize] as usize);
        &self.corners[from..to]
    }
}
