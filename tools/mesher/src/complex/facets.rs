//! Facets: maximal connected groups of coplanar triangles that agree in all their attributes.
//!
//! Each facet gets a marker of its own. So TetGen merges what is flat and nothing else, and every
//! triangle of the refined surface comes back with its marker, regions and wall.

use crate::faces::NO_FACE;
use geom::edges::Edges;
use geom::measure::double_area_vector;
use glam::DVec3;
use tmesh::Template;

/// What triangles of one facet have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attributes {
    /// Boundary marker.
    pub marker: u32,
    /// Region on the side of the facet's normal.
    pub front: u32,
    /// Region on the other side.
    pub back: u32,
    /// Wall face, 0 for none; see [`crate::face_key`].
    pub face: u32,
}

/// A facet.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// What its triangles have in common.
    pub attributes: Attributes,
    /// Unit normal of its largest triangle; zero when that has no area.
    pub normal: DVec3,
    /// Middle of its largest triangle.
    pub origin: DVec3,
    /// Sum of its triangles' areas, model units squared.
    pub area: f64,
    /// Largest distance of a vertex from the plane of the largest triangle, model units.
    pub deviation: f64,
}

/// The facets of a template.
#[derive(Default)]
pub struct Facets {
    /// Facet of each triangle.
    pub of_triangle: Vec<u32>,
    /// The facets.
    pub facets: Vec<Facet>,
}

/// No neighbour across an edge.
const NONE: u32 = u32::MAX;

impl Facets {
    /// Groups the triangles of a template. `face` gives each triangle's wall face; vertices may be
    /// `tolerance` (model units) off a facet's plane: the first on walls, the second elsewhere.
    pub fn new(template: &Template, edges: &Edges, face: &[u32], tolerance: [f64; 2]) -> Self {
        let n = template.triangles.len();
        let attributes = |t: usize| {
            let triangle = &template.triangles[t];
            Attributes {
                marker: triangle.marker,
                front: triangle.front,
                back: triangle.back,
                face: face[t],
            }
        };
        let area_vectors: Vec<DVec3> = template
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.vertices.map(|v| template.vertices[v as usize]);
                0.5 * double_area_vector(a, b, c)
            })
            .collect();
        let areas: Vec<f64> = area_vectors.iter().map(|v| v.length()).collect();
        let across = neighbours(n, edges);

        let mut order: Vec<u32> = (0..n as u32).collect();
        order.sort_by(|&a, &b| areas[b as usize].total_cmp(&areas[a as usize]));
        let mut of_triangle = vec![NONE; n];
        let mut facets = Vec::new();
        let mut queue = Vec::new();
        for &seed in &order {
            let seed = seed as usize;
            if of_triangle[seed] != NONE {
                continue;
            }
            let tolerance = tolerance[usize::from(face[seed] == NO_FACE)];
            let id = facets.len() as u32;
            let triangle = &template.triangles[seed];
            let [a, b, c] = triangle.vertices.map(|v| template.vertices[v as usize]);
            let mut facet = Facet {
                attributes: attributes(seed),
                normal: area_vectors[seed].try_normalize().unwrap_or_default(),
                origin: (a + b + c) / 3.0,
                area: 0.0,
                deviation: 0.0,
            };
            of_triangle[seed] = id;
            queue.push(seed);
            while let Some(t) = queue.pop() {
                facet.area += areas[t];
                for &next in &across[3 * t..3 * t + 3] {
                    let next_index = next as usize;
                    if next == NONE
                        || of_triangle[next_index] != NONE
                        || attributes(next_index) != facet.attributes
                        || area_vectors[next_index].dot(facet.normal) < 0.0
                        || facet.normal == DVec3::ZERO
                    {
                        continue;
                    }
                    let off = template.triangles[next_index]
                        .vertices
                        .iter()
                        .map(|&v| {
                            (template.vertices[v as usize] - facet.origin)
                                .dot(facet.normal)
                                .abs()
                        })
                        .fold(0.0, f64::max);
                    if off <= tolerance {
                        facet.deviation = facet.deviation.max(off);
                        of_triangle[next_index] = id;
                        queue.push(next_index);
                    }
                }
            }
            facets.push(facet);
        }
        Self {
            of_triangle,
            facets,
        }
    }
}

/// For each triangle the ones across its edges, where exactly two triangles meet and are wound
/// alike.
fn neighbours(triangles: usize, edges: &Edges) -> Vec<u32> {
    let mut across = vec![NONE; 3 * triangles];
    let mut count = vec![0_u8; triangles];
    for edge in 0..edges.len() {
        if let [a, b] = edges.around(edge)
            && a.forward != b.forward
        {
            for (from, to) in [(a, b), (b, a)] {
                let t = from.triangle as usize;
                across[3 * t + usize::from(count[t])] = to.triangle;
                count[t] += 1;
            }
        }
    }
    across
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{OUTSIDE, Triangle};

    #[test]
    fn coplanar_neighbours_with_the_same_attributes_are_one_facet() {
        // A strip of four triangles: two flat, then two tilted by far more than the tolerance.
        let vertices = [
            (0.0, 0.0, 0.0),
            (0.0, 1.0, 0.0),
            (1.0, 0.0, 0.0),
            (1.0, 1.0, 1e-12),
            (2.0, 0.0, 0.1),
            (2.0, 1.0, 0.1),
        ]
        .map(|(x, y, z)| DVec3::new(x, y, z));
        let triangle = |vertices, marker| Triangle {
            vertices,
            marker,
            front: OUTSIDE,
            back: 0,
        };
        let template = Template {
            vertices: vertices.to_vec(),
            triangles: vec![
                triangle([0, 2, 1], 4),
                triangle([1, 2, 3], 4),
                triangle([2, 4, 3], 4),
                triangle([3, 4, 5], 4),
            ],
            ..Template::default()
        };
        let corners: Vec<_> = template.triangles.iter().map(|t| t.vertices).collect();
        let edges = Edges::new(&corners);
        let facets = Facets::new(&template, &edges, &[0; 4], [0.0, 1e-9]);
        let of = &facets.of_triangle;
        assert_eq!(facets.facets.len(), 2);
        assert_eq!((of[0], of[2]), (of[1], of[3]));
        assert_ne!(of[0], of[2]);
        let flat = facets.facets[of[0] as usize];
        assert!((flat.area - 1.0).abs() < 1e-12 && flat.deviation > 0.0);
        assert!(flat.normal.z > 0.99);
        // A wall face or a marker of its own keeps a triangle apart.
        let facets = Facets::new(&template, &edges, &[0, 1, 0, 0], [1e-9; 2]);
        assert_eq!(facets.facets.len(), 3);
    }
}
