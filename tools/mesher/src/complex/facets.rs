//! Facets: maximal connected groups of coplanar triangles that agree in all their attributes.
//!
//! Each facet gets a marker of its own. So TetGen merges what is flat and nothing else, and every
//! triangle of the refined surface comes back with its marker, regions and wall.
//!
//! What is nearly flat is one facet, too: edges between facets stay as they are, and elements have to fit in between. Where a
//! flat face is drawn with folds that nobody would see, they get smaller and worse for nothing. Such a facet is uneven, and
//! [`Relief`](super::relief::Relief) has its shape. Folds may be steeper in a face that ends than in a surface that goes on as a curved
//! one.

use crate::faces::NO_FACE;
use geom::edges::{Across, Edges};
use geom::flat::{FACE_FOLD_COSINE, FOLD_COSINE, Flatness, Flats};
use geom::measure::{corners, double_area_vector, triangle_area};
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
    /// Groups the triangles of a template. `face` gives each triangle's wall face, `apart` those that are in no uneven facet, as
    /// [`Piece`](crate::Piece) has them.
    pub fn new(
        template: &Template,
        edges: &Edges,
        (face, apart): (&[u32], &[bool]),
        flat: Flat,
    ) -> Self {
        let is_apart = |t: u32| apart.get(t as usize) == Some(&true);
        let attributes = |t: u32| {
            let triangle = &template.triangles[t as usize];
            Attributes {
                marker: triangle.marker,
                front: triangle.front,
                back: triangle.back,
                face: face[t as usize],
            }
        };
        let flatness = |seed: u32, cosine: f64| {
            let [distance, folds] = match face[seed as usize] {
                NO_FACE if is_apart(seed) => [flat.elsewhere; 2],
                NO_FACE => [flat.elsewhere, flat.folds],
                _ => [flat.walls; 2],
            };
            // What is folded over is another facet, however thin the fold.
            [(distance, 0.0), (folds, cosine)]
                .map(|(distance, cosine)| Flatness { distance, cosine })
        };
        let ids: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
        let across = edges.across();
        let alike = |s: u32, t: u32| attributes(s) == attributes(t);
        let points = &template.vertices;
        let steep = |seed| flatness(seed, FACE_FOLD_COSINE);
        let wide = Flats::new(points, &ids, &across, steep, alike).regions.of;
        let ends = ending(points, &ids, &across, &wide, alike);
        let is_face = |t: u32| ends[wide[t as usize] as usize];
        let shallow = |seed| match is_face(seed) {
            true => steep(seed),
            false => flatness(seed, FOLD_COSINE),
        };
        let together = |s: u32, t: u32| {
            let same = wide[s as usize] == wide[t as usize];
            let together = is_apart(s) == is_apart(t) && is_face(s) == is_face(t);
            alike(s, t) && together && (same || !is_face(s))
        };
        let flats = Flats::new(points, &ids, &across, shallow, together);
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

/// Whether each region ends at edges that are sharper than the folds of a face, wherever its triangles have `alike` neighbours.
fn ending(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    across: &Across,
    region: &[u32],
    alike: impl Fn(u32, u32) -> bool,
) -> Vec<bool> {
    let normal = |t: u32| {
        let [a, b, c] = corners(points, triangles[t as usize]);
        double_area_vector(a, b, c).normalize_or_zero()
    };
    let mut ends = vec![true; triangles.len()];
    for (t, &own) in (0..).zip(region) {
        let goes_on = |u: u32| {
            let other = region[u as usize];
            other != own && alike(t, u) && normal(t).dot(normal(u)) >= FACE_FOLD_COSINE
        };
        if across.of(t).any(goes_on) {
            ends[own as usize] = false;
        }
    }
    ends
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
        let facets = Facets::new(&template, &edges, (&[0; 4], &[]), flat(1e-9));
        let of = &facets.of_triangle;
        assert_eq!(facets.facets.len(), 2);
        assert_eq!((of[0], of[2]), (of[1], of[3]));
        assert_ne!(of[0], of[2]);
        let level = facets.facets[of[0] as usize];
        assert!((level.area - 1.0).abs() < 1e-12 && level.deviation > 0.0);
        assert!(level.normal.z > 0.99);
        // A wall face or a marker of its own keeps a triangle apart.
        let facets = Facets::new(&template, &edges, (&[0, 1, 0, 0], &[]), flat(1e-9));
        assert_eq!(facets.facets.len(), 3);
    }

    /// A band of squares, each folded off the one before by an angle in degrees.
    fn band(folds: &[f64]) -> Vec<u32> {
        let mut at = DVec3::ZERO;
        let mut vertices = vec![at, at + DVec3::Y];
        let mut angle = 0.0_f64;
        for fold in folds {
            angle += fold.to_radians();
            at += DVec3::new(libm::cos(angle), 0.0, libm::sin(angle));
            vertices.extend([at, at + DVec3::Y]);
        }
        let square = |i: u32| {
            let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3];
            [[a, c, b], [b, c, d]]
        };
        let triangles = (0..folds.len() as u32).flat_map(square);
        let template = Template {
            triangles: triangles
                .map(|vertices| Triangle {
                    vertices,
                    marker: 4,
                    front: OUTSIDE,
                    back: 0,
                })
                .collect(),
            vertices,
            ..Template::default()
        };
        let corners: Vec<_> = template.triangles.iter().map(|t| t.vertices).collect();
        let flat = Flat {
            walls: 1e-9,
            elsewhere: 1e-9,
            folds: 0.1,
        };
        let none = vec![NO_FACE; corners.len()];
        Facets::new(&template, &Edges::new(&corners), (&none, &[]), flat).of_triangle
    }

    fn count(of_triangle: &[u32]) -> usize {
        let mut all = of_triangle.to_vec();
        all.sort_unstable();
        all.dedup();
        all.len()
    }

    #[test]
    fn folds_of_a_face_that_ends_are_in_one_facet() {
        assert_eq!(count(&band(&[0.0, 0.5, -0.5, 0.3])), 1);
        assert_eq!(count(&band(&[0.0, 0.5, -0.5, 40.0, 0.5])), 2);
        // Steeper ones, and what is off by more, are not.
        assert_eq!(count(&band(&[0.0, 1.2])), 2);
    }

    #[test]
    fn a_curved_surface_has_a_facet_for_each_of_its_own() {
        assert_eq!(count(&band(&[0.8; 12])), 12);
        // But for what TetGen by itself takes for flat.
        assert!(count(&band(&[0.04; 60])) < 30);
    }
}
