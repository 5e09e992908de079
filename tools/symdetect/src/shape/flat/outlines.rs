//! What bounds the flat faces of a surface: edges, straightened and numbered.

use geom::edges::Edges;
use glam::DVec3;

/// Edges that bound faces.
pub struct Outlines {
    /// Vertex ids.
    ends: Vec<[u32; 2]>,
    /// Faces of each edge, increasing.
    faces: Vec<Vec<u32>>,
}

impl Outlines {
    /// Edges with each face that has them on one side only.
    pub fn new(edges: &Edges, face_of: &[u32]) -> Self {
        let mut bounds = Self {
            ends: Vec::new(),
            faces: Vec::new(),
        };
        for (e, &ends) in edges.ends.iter().enumerate() {
            let mut faces: Vec<u32> = Vec::new();
            for u in edges.around(e) {
                let face = face_of[u.triangle as usize];
                match faces.iter().position(|f| *f == face) {
                    Some(twice) => _ = faces.swap_remove(twice),
                    None => faces.push(face),
                }
            }
            if !faces.is_empty() {
                faces.sort_unstable();
                bounds.ends.push(ends);
                bounds.faces.push(faces);
            }
        }
        bounds
    }

    /// Makes one edge of those that continue each other in a line; `None` where many that hardly bend do not make
    /// a line together.
    pub fn straighten(&mut self, vertices: &[DVec3], flat: f64) -> Option<()> {
        let mut at: Vec<Vec<u32>> = vec![Vec::new(); vertices.len()];
        for (ends, e) in self.ends.iter().zip(0..) {
            ends.iter().for_each(|&v| at[v as usize].push(e));
        }
        let p = |v: u32| vertices[v as usize];
        let other = |e: u32, v: u32| {
            let [a, b] = self.ends[e as usize];
            if a == v { b } else { a }
        };
        let off_line = |v: u32, a: u32, b: u32| {
            let along = (p(b) - p(a)).normalize_or_zero();
            (p(v) - p(a)).cross(along).length()
        };
        let passes = |v: u32| match at[v as usize][..] {
            [d, e] if self.faces[d as usize] == self.faces[e as usize] => {
                let (a, b) = (other(d, v), other(e, v));
                (p(a) - p(v)).dot(p(b) - p(v)) < 0.0 && off_line(v, a, b) <= flat
            }
            _ => false,
        };
        let passed: Vec<bool> = (0..vertices.len() as u32).map(passes).collect();
        let mut kept = Self {
            ends: Vec::with_capacity(self.ends.len()),
            faces: Vec::with_capacity(self.ends.len()),
        };
        let mut joined = 0;
        for first in (0..self.ends.len() as u32).filter(|&e| {
            let ends = self.ends[e as usize];
            ends.iter().any(|&v| !passed[v as usize])
        }) {
            let [a, b] = self.ends[first as usize];
            let start = if passed[a as usize] { b } else { a };
            let (mut e, mut v) = (first, other(first, start));
            let mut between = Vec::new();
            while passed[v as usize] {
                between.push(v);
                let [c, d] = at[v as usize][..] else { break };
                e = if c == e { d } else { c };
                v = other(e, v);
            }
            if start == v || between.iter().any(|&m| off_line(m, start, v) > 2.0 * flat) {
                return None;
            }
            // Each line is found from both of its ends.
            if e >= first {
                joined += 1 + between.len();
                kept.ends.push([start, v]);
                kept.faces.push(self.faces[first as usize].clone());
            }
        }
        // A ring without corners is not a line.
        if joined < self.ends.len() {
            return None;
        }
        *self = kept;
        Some(())
    }

    /// Positions of the corners, and their numbers at the ends of each edge, lower one first.
    pub fn numbered(&self, vertices: &[DVec3]) -> (Vec<DVec3>, Vec<[u32; 2]>) {
        let mut number = vec![u32::MAX; vertices.len()];
        let mut corners = Vec::new();
        let mut numbered = |v: u32| {
            let number = &mut number[v as usize];
            if *number == u32::MAX {
                *number = corners.len() as u32;
                corners.push(vertices[v as usize]);
            }
            *number
        };
        let mut ends: Vec<[u32; 2]> = self.ends.iter().map(|e| e.map(&mut numbered)).collect();
        ends.iter_mut().for_each(|e| e.sort_unstable());
        (corners, ends)
    }

    /// Each edge with each of its faces.
    pub fn pairs(&self) -> impl Iterator<Item = (u32, u32)> + Clone {
        let faces = self.faces.iter().zip(0..);
        faces.flat_map(|(faces, e)| faces.iter().map(move |&f| (e, f)))
    }
}
