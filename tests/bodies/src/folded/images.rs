//! The isometries that take a body, as it is drawn, onto itself.

use crate::{Body, Face};
use glam::DVec3;
use std::collections::{HashMap, HashSet};
use tmesh::Isometry;

/// An isometry about the z axis that takes a body's triangles onto each other.
pub struct Image {
    /// What it does to places.
    pub motion: Isometry,
    /// The vertex that each vertex comes to.
    pub of: Vec<u32>,
}

/// All isometries of a body drawn about the z axis whose angles are multiples of half a sector: a group.
pub fn images(body: &Body, sectors: u32) -> Vec<Image> {
    let places = Places::new(&body.vertices);
    let faces: HashSet<_> = body.faces.iter().map(key).collect();
    let kinds = [(false, false), (true, false), (false, true), (true, true)];
    let motions = kinds.into_iter().flat_map(|(mirrored, flipped)| {
        let turns = 0..i64::from(2 * sectors);
        turns.map(move |k| Isometry::new(k, 2 * sectors, mirrored, flipped))
    });
    let image = |motion: Isometry| {
        let placed = motion.placed();
        let vertices = body.vertices.iter();
        let of: Option<Vec<u32>> = vertices.map(|&p| places.find(placed.apply(p))).collect();
        let of = of?;
        let turned = |face: &Face| {
            let [a, b, c] = face.vertices.map(|v| of[v as usize]);
            let reversed = motion.reverses_orientation();
            key(&Face {
                vertices: if reversed { [a, c, b] } else { [a, b, c] },
                ..*face
            })
        };
        let holds = body.faces.iter().all(|face| faces.contains(&turned(face)));
        holds.then_some(Image { motion, of })
    };
    motions.filter_map(image).collect()
}

/// A face whatever corner comes first and whichever side is in front.
fn key(face: &Face) -> ([u32; 3], Option<usize>, Option<usize>) {
    let [a, b, c] = face.vertices;
    let first = a.min(b).min(c);
    let [a, b, c] = match first {
        _ if first == a => [a, b, c],
        _ if first == b => [b, c, a],
        _ => [c, a, b],
    };
    if b < c {
        ([a, b, c], face.front, face.back)
    } else {
        ([a, c, b], face.back, face.front)
    }
}

/// Width of the cells in which vertices are looked for, in units of the radius: rounding is far smaller, and vertices are far
/// apart.
const CELL: f64 = 1e-10;

/// Vertices by their places.
struct Places<'a> {
    points: &'a [DVec3],
    cells: HashMap<[i64; 3], u32>,
}

impl<'a> Places<'a> {
    fn new(points: &'a [DVec3]) -> Self {
        let cells = (0..).zip(points).map(|(v, &p)| (cell(p), v)).collect();
        Self { points, cells }
    }

    fn find(&self, p: DVec3) -> Option<u32> {
        let [x, y, z] = cell(p);
        let near = (0..27).map(|n| [x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1]);
        let near = near.filter_map(|cell| self.cells.get(&cell).copied());
        let distance = |v: &u32| self.points[*v as usize].distance(p);
        near.min_by(|v, w| distance(v).total_cmp(&distance(w)))
    }
}

fn cell(p: DVec3) -> [i64; 3] {
    (p / CELL).round().as_i64vec3().to_array()
}
