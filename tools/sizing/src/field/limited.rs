//! Lengths at the points of a size field, limited by the gradation, and the border of its mesh.

use glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use tmesh::{Frame, SizeField};

/// A size field in the canonical frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limited {
    /// Positions, canonical coordinates, model units.
    pub points: Vec<DVec3>,
    /// Lengths of edges wanted there: along each edge they grow by the gradation at most.
    pub sizes: Vec<f64>,
    /// Tetrahedra.
    pub tets: Vec<[u32; 4]>,
    /// Triangles from which lengths grow into what is beyond: the border of the tetrahedra, and the triangles of the field.
    pub border: Vec<[u32; 3]>,
}

impl Limited {
    /// Limits a field so that lengths grow by `growth` of the distance at most. m log m with m elements.
    ///
    /// What edges allow is what elements that are not flat allow, but for a factor of their shape; the exact limit ("Mesh size functions
    /// for implicit geometries and PDE-based gradient limiting", Persson 2006) differs from it within elements only.
    pub fn new(field: &SizeField, frame: &Frame, growth: f64) -> Self {
        let position = |p: &tmesh::SizePoint| frame.to_canonical(p.position);
        let mut limited = Self {
            points: field.points.iter().map(position).collect(),
            sizes: field.points.iter().map(|p| p.size).collect(),
            tets: field.tets.clone(),
            border: border(field),
        };
        let elements = field.tets.iter().map(|t| t.as_slice());
        let elements: Vec<&[u32]> = elements
            .chain(field.triangles.iter().map(|t| t.as_slice()))
            .collect();
        limited.limit(&elements, growth);
        limited
    }

    fn limit(&mut self, elements: &[&[u32]], growth: f64) {
        let points = &self.points;
        let sizes = &mut self.sizes;
        let allowed = |sizes: &[f64], from: u32, to: u32| {
            let [p, q] = [from, to].map(|v| points[v as usize]);
            sizes[from as usize] + growth * p.distance(q)
        };
        // Lengths are above zero, so that their bits have their order.
        let mut open: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
        for element in elements {
            for (i, &v) in element.iter().enumerate() {
                for &w in &element[..i] {
                    let [p, q] = [v, w].map(|v| points[v as usize]);
                    let [s, t] = [v, w].map(|v| sizes[v as usize]);
                    // Of most fields nothing is steep: no roots.
                    if (s - t) * (s - t) > growth * growth * p.distance_squared(q) {
                        let low = if s < t { v } else { w };
                        open.push(Reverse((sizes[low as usize].to_bits(), low)));
                    }
                }
            }
        }
        if open.is_empty() {
            return;
        }
        // The elements at each point, one after the other.
        let mut begin = vec![0_u32; points.len() + 1];
        let corners = || elements.iter().flat_map(|e| e.iter());
        corners().for_each(|&v| begin[v as usize + 1] += 1);
        for v in 0..points.len() {
            begin[v + 1] += begin[v];
        }
        let mut next = begin.clone();
        let mut at = vec![0_u32; corners().count()];
        for (e, element) in (0..).zip(elements) {
            for &v in *element {
                at[next[v as usize] as usize] = e;
                next[v as usize] += 1;
            }
        }
        while let Some(Reverse((bits, v))) = open.pop() {
            if bits != sizes[v as usize].to_bits() {
                continue;
            }
            let around = begin[v as usize] as usize..begin[v as usize + 1] as usize;
            for &e in &at[around] {
                for &w in elements[e as usize] {
                    let most = allowed(sizes, v, w);
                    if w != v && sizes[w as usize] > most {
                        sizes[w as usize] = most;
                        open.push(Reverse((most.to_bits(), w)));
                    }
                }
            }
        }
    }
}

/// Triangles that one tetrahedron has alone, and those of the field. Linear where few elements are at a point.
fn border(field: &SizeField) -> Vec<[u32; 3]> {
    let of_tet = |&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, b, d], [a, c, d], [b, c, d]];
    let sorted = |mut face: [u32; 3]| {
        face.sort_unstable();
        face
    };
    let faces = || field.tets.iter().flat_map(of_tet).map(sorted);
    // By their lowest points, and only then sorted.
    let mut begin = vec![0_u32; field.points.len() + 1];
    faces().for_each(|[a, ..]| begin[a as usize + 1] += 1);
    for v in 0..field.points.len() {
        begin[v + 1] += begin[v];
    }
    let mut next = begin.clone();
    let mut of_lowest = vec![[0_u32; 2]; 4 * field.tets.len()];
    for [a, b, c] in faces() {
        of_lowest[next[a as usize] as usize] = [b, c];
        next[a as usize] += 1;
    }
    let mut border = Vec::new();
    for (a, range) in (0..).zip(begin.windows(2)) {
        let others = &mut of_lowest[range[0] as usize..range[1] as usize];
        others.sort_unstable();
        let alone = others
            .chunk_by(|s, t| s == t)
            .filter(|same| same.len() == 1);
        border.extend(alone.map(|same| [a, same[0][0], same[0][1]]));
    }
    border.extend(&field.triangles);
    border
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::SizePoint;

    /// Tetrahedra along a row of points on a helix.
    fn row(sizes: &[f64]) -> SizeField {
        let point = |(i, &size): (usize, &f64)| SizePoint {
            position: DVec3::new(i as f64, (i as f64).cos(), (i as f64).sin()),
            size,
        };
        let count = sizes.len() as u32;
        SizeField {
            points: sizes.iter().enumerate().map(point).collect(),
            tets: (3..count).map(|i| [i - 3, i - 2, i - 1, i]).collect(),
            triangles: Vec::new(),
        }
    }

    #[test]
    fn lengths_grow_by_the_gradation() {
        let mut sizes = [100.0; 40];
        sizes[17] = 0.25;
        let field = row(&sizes);
        let found = Limited::new(&field, &Frame::IDENTITY, 0.5);
        assert_eq!(found.sizes[17], 0.25);
        for tet in &found.tets {
            for v in tet {
                for w in tet {
                    let [p, q] = [v, w].map(|v| found.points[*v as usize]);
                    let [s, t] = [v, w].map(|v| found.sizes[*v as usize]);
                    assert!(t <= s + 0.5 * p.distance(q));
                }
            }
        }
        // From point to point in threes.
        assert!(found.sizes[20] < 0.25 + 0.5 * 4.0 && found.sizes[20] > 0.25 + 0.5 * 3.0);
        // Nothing is to be done where they grow less.
        assert_eq!(Limited::new(&field, &Frame::IDENTITY, 1e3).sizes, sizes);
        // No gradation at all.
        let flat = Limited::new(&field, &Frame::IDENTITY, 0.0);
        assert_eq!(flat.sizes, [0.25; 40]);
    }

    #[test]
    fn borders_are_the_triangles_of_one_tetrahedron() {
        let mut field = row(&[1.0; 6]);
        assert_eq!(Limited::new(&field, &Frame::IDENTITY, 1.0).border.len(), 8);
        field.triangles.push([0, 2, 5]);
        assert_eq!(Limited::new(&field, &Frame::IDENTITY, 1.0).border.len(), 9);
    }
}
