//! Facets: maximal connected groups of coplanar triangles that agree in all their attributes.
//!
//! Each facet gets a marker of its own. So TetGen merges what is flat and nothing else, and every
//! triangle of the refined surface comes back with its marker, regions and wall.
//!
//! What is nearly flat is one facet, too: edges between facets stay as they are, and elements have to fit in between. Where a
//! flat face is drawn with folds that nobody would see, they get smaller and worse for nothing. Such a facet is uneven, and
//! [`Relief`](super::relief::Relief) has its shape.

use crate::faces::NO_FACE;
use geom::edges::Edges;
use geom::flat::{FOLD_COSINE, Flatness, Flats};
use geom::measure::{corners, triangle_area};
use glam::DVec3;
use tmesh::Template;

/// How far off the plane of a facet its vertices may be, model units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flat {
    /// On walls.
    pub walls: f64,
    /// Elsewhere, whatever the angle.
    pub elsewhere: f64,
    /// Elsewhere, where folds are shallow.
    pub folds: f64,
}

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

impl Facets {
    /// Groups the triangles of a template. `face` gives each triangle's wall face.
    pub fn new(template: &Template, edges: &Edges, face: &[u32], flat: Flat) -> Self {
        let attributes = |t: u32| {
            let triangle = &template.triangles[t as usize];
            Attributes {
                marker: triangle.marker,
                front: triangle.front,
                back: triangle.back,
                face: face[t as usize],
            }
        };
        let flatness = |seed: u32| {
            let [distance, folds] = match face[seed as usize] {
                NO_FACE => [flat.elsewhere, flat.folds],
                _ => [flat.walls; 2],
            };
            // What is folded over is another facet, however thin the fold.
            [(distance, 0.0), (folds, FOLD_COSINE)]
                .map(|(distance, cosine)| Flatness { distance, cosine })
        };
        let ids: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        let across = edges.across();
        let alike = |s: u32, t: u32| attributes(s) == attributes(t);
        let flats = Flats::new(&template.vertices, &ids, &across, flatness, alike);
        let seeds = flats.regions.seeds.iter().zip(&flats.planes);
        let mut facets: Vec<Facet> = seeds
            .map(|(&seed, plane)| Facet {
                attributes: attributes(seed),
                normal: plane.normal,
                origin: plane.origin,
                area: 0.0,
                deviation: 0.0,
            })
            .collect();
        for (t, &id) in (0..).zip(&flats.regions.of) {
            let [a, b, c] = corners(&template.vertices, ids[t as usize]);
            let facet = &mut facets[id as usize];
            facet.area += triangle_area(a, b, c);
            if t != flats.regions.seeds[id as usize] {
                let off = flats.planes[id as usize].off([a, b, c]);
                facet.deviation = facet.deviation.max(off);
            }
        }
        Self {
            of_triangle: flats.regions.of,
            facets,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::{OUTSIDE, Triangle};

    fn flat(distance: f64) -> Flat {
        Flat {
            walls: distance,
            elsewhere: distance,
            folds: 0.0,
        }
    }

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
        let facets = Facets::new(&template, &edges, &[0; 4], flat(1e-9));
        let of = &facets.of_triangle;
        assert_eq!(facets.facets.len(), 2);
        assert_eq!((of[0], of[2]), (of[1], of[3]));
        assert_ne!(of[0], of[2]);
        let level = facets.facets[of[0] as usize];
        assert!((level.area - 1.0).abs() < 1e-12 && level.deviation > 0.0);
        assert!(level.normal.z > 0.99);
        // A wall face or a marker of its own keeps a triangle apart.
        let facets = Facets::new(&template, &edges, &[0, 1, 0, 0], flat(1e-9));
        assert_eq!(facets.facets.len(), 3);
    }
}
