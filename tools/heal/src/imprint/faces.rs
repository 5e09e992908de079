//! Flat faces of triangles that may cross.

use geom::edges::{Across, Edges};
use geom::flat::{Flatness, Flats};
use glam::DVec3;
use rustc_hash::FxHashSet;

/// Triangles that may cross, in flat faces. What a face is made of inside its border may change.
#[derive(Clone, Debug, Default)]
pub struct Complex {
    /// Places.
    pub points: Vec<DVec3>,
    /// Three different points each.
    pub triangles: Vec<[u32; 3]>,
    /// The triangle of the file that each one is a part of.
    pub source: Vec<u32>,
    /// The face that each triangle belongs to; faces are numbered in the order of their first triangles.
    pub face: Vec<u32>,
}

impl Complex {
    /// Joins triangles that are in one plane within a distance, and `alike`, to faces.
    pub fn new(
        points: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        within: f64,
        alike: impl Fn(u32, u32) -> bool,
    ) -> Self {
        let across: Across = Edges::new(&triangles).across();
        let flatness = |_| {
            [Flatness {
                distance: within,
                // What the distance leaves of folds.
                cosine: 0.5,
            }]
        };
        let flats = Flats::new(&points, &triangles, &across, flatness, alike);
        let mut complex = Self {
            source: (0..triangles.len() as u32).collect(),
            face: flats.regions.of,
            points,
            triangles,
        };
        complex.number_faces();
        complex
    }

    /// Makes a face of each triangle of some faces, such as those that lie over themselves, where what is inside their
    /// borders cannot be told. Whether there are more faces then.
    pub fn break_up(&mut self, faces: &FxHashSet<u32>) -> bool {
        let before = self.number_faces();
        let all = self.face.len() as u32;
        for (t, f) in (0..).zip(&mut self.face) {
            if faces.contains(f) {
                *f = all + t;
            }
        }
        self.number_faces() > before
    }

    /// Numbers faces in the order of their first triangles; how many there are.
    pub fn number_faces(&mut self) -> usize {
        let most = self.face.iter().max().map_or(0, |m| *m as usize + 1);
        let mut number = vec![u32::MAX; most];
        let mut count = 0;
        for f in &mut self.face {
            let n = &mut number[*f as usize];
            if *n == u32::MAX {
                *n = count;
                count += 1;
            }
            *f = *n;
        }
        count as usize
    }

    /// Positions of a triangle's corners.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.points[v as usize])
    }
}

/// The faces of a complex.
pub struct Faces {
    /// Triangles of each.
    pub triangles: Vec<Vec<u32>>,
    /// Of each triangle, the edges that begin at its corners.
    pub edges: Vec<[u32; 3]>,
    /// Of each triangle, which of its edges are on the border of its face.
    pub border: Vec<[bool; 3]>,
}

impl Faces {
    /// Collects what faces are made of.
    pub fn new(complex: &Complex, edges: &Edges) -> Self {
        let count = complex.face.iter().max().map_or(0, |m| *m as usize + 1);
        let mut faces = Self {
            triangles: vec![Vec::new(); count],
            edges: vec![[0; 3]; complex.triangles.len()],
            border: vec![[false; 3]; complex.triangles.len()],
        };
        for (t, &f) in (0..).zip(&complex.face) {
            faces.triangles[f as usize].push(t);
        }
        let face = |t: u32| complex.face[t as usize];
        for e in 0..edges.len() {
            let around = edges.around(e);
            for u in around {
                let (t, corner) = (u.triangle as usize, u.corner as usize);
                faces.edges[t][corner] = e as u32;
                let own = around
                    .iter()
                    .filter(|w| face(w.triangle) == face(u.triangle));
                faces.border[t][corner] = own.count() != 2;
            }
        }
        faces
    }
}

/// The edges of a complex and its faces, from which one can tell which triangles, edges and faces are incident.
#[derive(Clone, Copy)]
pub struct Incidence<'a> {
    /// Edges of the triangles.
    pub edges: &'a Edges,
    /// Faces, which number their edges as `edges` does.
    pub faces: &'a Faces,
}
