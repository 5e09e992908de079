//! The shape of uneven facets.
//!
//! The mesher takes a facet for flat, and puts points into triangles of its own between the vertices that are given. They are
//! put back onto the triangles that were given, from which they are off by no more than the facet is uneven.

use super::Facets;
use geom::measure::corners;
use geom::tree::Tree;
use glam::DVec3;
use std::collections::BTreeMap;
use tmesh::Template;

/// The triangles of uneven facets.
#[derive(Default)]
pub struct Relief {
    /// Of each facet, whether it is uneven.
    uneven: Vec<bool>,
    /// The triangles of each uneven facet: what is nearest among few of many is found after most others.
    trees: BTreeMap<usize, Tree>,
}

impl Relief {
    /// The shape of the facets of a template that are off their planes by more than `flat`, model units. n log n.
    pub fn new(template: &Template, facets: &Facets, flat: f64) -> Self {
        let is_uneven = |f: &super::Facet| f.deviation > flat && f.normal != DVec3::ZERO;
        let uneven: Vec<bool> = facets.facets.iter().map(is_uneven).collect();
        let mut of: BTreeMap<usize, Vec<[DVec3; 3]>> = BTreeMap::new();
        for (t, &facet) in template.triangles.iter().zip(&facets.of_triangle) {
            if uneven[facet as usize] {
                let triangles = of.entry(facet as usize).or_default();
                triangles.push(corners(&template.vertices, t));
            }
        }
        let tree = |(facet, of): (usize, Vec<_>)| (facet, Tree::new(of));
        Self {
            trees: of.into_iter().map(tree).collect(),
            uneven,
        }
    }

    /// Whether any facet is uneven.
    pub fn is_there(&self) -> bool {
        !self.trees.is_empty()
    }

    /// Of each facet, whether it is uneven.
    pub fn uneven(&self) -> &[bool] {
        &self.uneven
    }

    /// The point of an uneven facet that is nearest to `p`, model units; `None` for other facets.
    pub fn nearest(&self, facet: usize, p: DVec3) -> Option<DVec3> {
        Some(self.trees.get(&facet)?.nearest(p, f64::INFINITY)?.point)
    }

    /// The points that are on a single uneven facet, of triangles with their facets, and where each is on it; in their order. What
    /// is on several facets is on the edges between them.
    pub fn places(
        &self,
        points: &[DVec3],
        triangles: impl Iterator<Item = ([u32; 3], usize)>,
    ) -> Vec<(u32, DVec3)> {
        if !self.is_there() {
            return Vec::new();
        }
        let mut of: Vec<(u32, usize)> = triangles
            .flat_map(|(corners, facet)| corners.map(|v| (v, facet)))
            .collect();
        of.sort_unstable();
        of.dedup();
        let alone = of.chunk_by(|a, b| a.0 == b.0).filter_map(|of| match of {
            &[alone] => Some(alone),
            _ => None,
        });
        let place = |(v, facet)| Some((v, self.nearest(facet, points[v as usize])?));
        alone.filter_map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::facets::Flat;
    use geom::edges::Edges;
    use tmesh::{OUTSIDE, Triangle};

    /// A square whose middle is raised, with one side folded down.
    fn roof(height: f64) -> Template {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let mut vertices: Vec<DVec3> = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        vertices.extend([DVec3::new(0.5, 0.5, height), DVec3::new(0.5, -0.2, -1.0)]);
        let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 5, 1]];
        let triangle = |vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 1,
        };
        Template {
            vertices,
            triangles: triangles.map(triangle).to_vec(),
            ..Template::default()
        }
    }

    fn facets(template: &Template, folds: f64) -> Facets {
        let corners: Vec<_> = template.triangles.iter().map(|t| t.vertices).collect();
        let flat = Flat {
            walls: 1e-10,
            elsewhere: 1e-10,
            folds,
        };
        Facets::new(template, &Edges::new(&corners), (&[0; 5], &[]), flat)
    }

    #[test]
    fn shallow_folds_make_an_uneven_facet_that_points_are_put_back_onto() {
        // A slope of 0.046 degrees; the sides opposite to each other are 0.092 degrees apart.
        let template = roof(4e-4);
        let faces = facets(&template, 1e-3);
        assert_eq!(faces.facets.len(), 2);
        let relief = Relief::new(&template, &faces, 1e-10);
        let roof = faces.of_triangle[0] as usize;
        assert_eq!(relief.uneven().iter().filter(|u| **u).count(), 1);
        assert_eq!(relief.nearest(1 - roof, DVec3::ZERO), None);
        let points = [DVec3::new(0.5, 0.25, 0.0), DVec3::X, DVec3::Y, DVec3::Z];
        // The second one is on both facets, and the fourth one on the even one.
        let triangles = [([0, 1, 2], roof), ([1, 3, 3], 1 - roof)];
        let places = relief.places(&points, triangles.into_iter());
        assert_eq!(places.iter().map(|p| p.0).collect::<Vec<_>>(), [0, 2]);
        assert!((places[0].1 - DVec3::new(0.5, 0.25, 2e-4)).length() < 1e-6);
    }

    #[test]
    fn folds_that_are_steeper_or_higher_are_kept() {
        let count = |height: f64, folds: f64| facets(&roof(height), folds).facets.len();
        assert_eq!(count(4e-4, 1e-4), 5);
        assert_eq!(count(4e-4, 0.0), 5);
        assert_eq!(count(1e-2, 1e-1), 5);
        assert_eq!(count(0.0, 0.0), 2);
    }
}
