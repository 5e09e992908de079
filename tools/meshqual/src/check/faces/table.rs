//! The faces of a template's tetrahedra, matched with each other and with the surface triangles.

use crate::error::Error;
use geom::tet::FACES;
use tmesh::Template;

/// One side of a face: a tetrahedron's face or a surface triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// Index of the tetrahedron, or of the triangle.
    pub element: u32,
    /// Whether the element's face (outward for a tetrahedron) runs through the three vertices in
    /// increasing order up to rotation.
    pub even: bool,
}

#[derive(Clone, Copy)]
struct Entry {
    middle: u32,
    highest: u32,
    /// Twice the number of the element's face (four per tetrahedron, then triangles), plus parity.
    id: u32,
}

/// Faces sorted by their vertices, lowest vertex first. Twelve bytes per tetrahedron face.
pub struct FaceTable {
    start: Vec<u32>,
    entries: Vec<Entry>,
    tet_faces: u32,
}

/// Most faces a table can number.
const LIMIT: u64 = 1 << 31;

impl FaceTable {
    /// Collects the faces of all tetrahedra and all triangles. Linear but for the sorting of the few
    /// faces that share their lowest vertex.
    ///
    /// # Errors
    /// Fails on more than 2^31 faces in one template.
    pub fn new(template: &Template) -> Result<Self, Error> {
        let count = 4 * template.tets.len() as u64 + template.triangles.len() as u64;
        if count >= LIMIT {
            return Err(Error::TooLarge { faces: count });
        }
        let mut start = vec![0_u32; template.vertices.len() + 1];
        each_face(template, |lowest, _| start[lowest as usize + 1] += 1);
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let blank = Entry {
            middle: 0,
            highest: 0,
            id: 0,
        };
        let mut entries = vec![blank; count as usize];
        let mut next = start.clone();
        each_face(template, |lowest, entry| {
            let place = &mut next[lowest as usize];
            entries[*place as usize] = entry;
            *place += 1;
        });
        Ok(Self {
            start,
            entries,
            tet_faces: 4 * template.tets.len() as u32,
        })
    }

    /// Visits every face in order of its vertices: `visit(vertices, tetrahedra, triangles)`, the
    /// vertices increasing.
    pub fn visit(mut self, mut visit: impl FnMut([u32; 3], &[Side], &[Side])) {
        let mut sides = Vec::new();
        for lowest in 0..self.start.len() - 1 {
            let range = self.start[lowest] as usize..self.start[lowest + 1] as usize;
            let bucket = &mut self.entries[range];
            bucket.sort_unstable_by_key(|e| (e.middle, e.highest, e.id));
            for group in bucket.chunk_by(|a, b| (a.middle, a.highest) == (b.middle, b.highest)) {
                sides.clear();
                let mut tets = 0;
                for entry in group {
                    let face = entry.id >> 1;
                    let even = entry.id & 1 == 0;
                    let element = if face < self.tet_faces {
                        tets += 1;
                        face / 4
                    } else {
                        face - self.tet_faces
                    };
                    sides.push(Side { element, even });
                }
                let (tets, triangles) = sides.split_at(tets);
                let vertices = [lowest as u32, group[0].middle, group[0].highest];
                visit(vertices, tets, triangles);
            }
        }
    }
}

fn each_face(template: &Template, mut visit: impl FnMut(u32, Entry)) {
    let mut number = 0_u32;
    let mut add = |face: [u32; 3]| {
        let ([lowest, middle, highest], odd) = sorted(face);
        let id = 2 * number + u32::from(odd);
        number += 1;
        visit(
            lowest,
            Entry {
                middle,
                highest,
                id,
            },
        );
    };
    for tet in &template.tets {
        for corners in FACES {
            add(corners.map(|i| tet.vertices[i]));
        }
    }
    for triangle in &template.triangles {
        add(triangle.vertices);
    }
}

/// Three numbers in increasing order, and whether that took an odd number of exchanges.
pub fn sorted([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    let (a, b, odd1) = if a <= b { (a, b, false) } else { (b, a, true) };
    let (b, c, odd2) = if b <= c { (b, c, false) } else { (c, b, true) };
    let (a, b, odd3) = if a <= b { (a, b, false) } else { (b, a, true) };
    ([a, b, c], odd1 ^ odd2 ^ odd3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use tmesh::{Tet, Triangle};

    #[test]
    fn two_tetrahedra_share_a_face_from_opposite_sides() {
        let template = Template {
            vertices: vec![DVec3::ZERO; 5],
            triangles: vec![Triangle {
                vertices: [3, 1, 2],
                marker: 0,
                front: 7,
                back: 7,
            }],
            tets: [[0, 1, 2, 3], [4, 2, 1, 3]]
                .map(|vertices| Tet {
                    vertices,
                    region: 7,
                })
                .to_vec(),
            ..Template::default()
        };
        let mut faces = Vec::new();
        FaceTable::new(&template)
            .unwrap()
            .visit(|vertices, tets, triangles| {
                faces.push((vertices, tets.to_vec(), triangles.to_vec()));
            });
        assert_eq!(faces.len(), 7);
        assert!(faces.is_sorted_by_key(|f| f.0));
        let shared = faces.iter().find(|f| f.1.len() == 2).unwrap();
        assert_eq!(shared.0, [1, 2, 3]);
        assert_ne!(shared.1[0].even, shared.1[1].even);
        let side = Side {
            element: 0,
            even: true,
        };
        assert_eq!(shared.2, [side]);
        assert!(faces.iter().filter(|f| f.1.len() == 1).count() == 6);
    }

    #[test]
    fn parity_of_all_orders() {
        for (order, odd) in [
            ([1, 2, 3], false),
            ([2, 3, 1], false),
            ([3, 1, 2], false),
            ([2, 1, 3], true),
            ([1, 3, 2], true),
            ([3, 2, 1], true),
        ] {
            assert_eq!(sorted(order), ([1, 2, 3], odd));
        }
    }
}
