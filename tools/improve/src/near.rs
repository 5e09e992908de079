//! Points of a curved shape, and the triangles of the surface that they are near to.

use crate::shape::{Curved, NO_PATCH, Point};
use geom::tree::closest_point;
use glam::DVec3;
use tmesh::Template;

/// The points that each triangle of a surface is near to, by its number. What is done to triangles keeps all of their points near to those that
/// are there then, so that no part of the shape is left out.
#[derive(Clone, Default)]
pub struct Near(Vec<Vec<Point>>);

impl Near {
    /// Gives the points of each facet that stands for a patch to its triangles. Such a facet has few, so that all are looked at for each point; what
    /// stands for none, may be of any size, and stays.
    pub fn new(template: &Template, of_triangle: &[u32], curved: &Curved<'_>) -> Self {
        let mut near = Self(vec![Vec::new(); template.triangles.len()]);
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); curved.points.len()];
        for (t, &facet) in (0..).zip(of_triangle) {
            if curved.patches[facet as usize] != NO_PATCH {
                members[facet as usize].push(t);
            }
        }
        for (points, members) in curved.points.iter().zip(members) {
            let corners = |t: &u32| {
                let ids = template.triangles[*t as usize].vertices;
                ids.map(|v| template.vertices[v as usize] * curved.scale)
            };
            let scaled = points.iter().map(|p| Point {
                at: p.at * curved.scale,
                reach: p.reach * curved.scale,
            });
            let triangles: Vec<_> = members.iter().map(|t| (*t, corners(t))).collect();
            near.give(scaled.collect(), &triangles);
        }
        near
    }

    /// The points of some triangles.
    pub fn of(&self, triangles: &[u32]) -> Vec<Point> {
        let known = triangles.iter().filter_map(|&t| self.0.get(t as usize));
        known.flatten().copied().collect()
    }

    /// Takes the points of some triangles away from them.
    pub fn take(&mut self, triangles: &[u32]) -> Vec<Point> {
        // One that is there twice, as both a vertex and its partner are corners of it, has its points once.
        let mut points = Vec::new();
        for &t in triangles {
            if let Some(own) = self.0.get_mut(t as usize) {
                points.append(own);
            }
        }
        points
    }

    /// Gives each point to the nearest of some triangles.
    pub fn give(&mut self, points: Vec<Point>, triangles: &[(u32, [DVec3; 3])]) {
        for point in points {
            let distance =
                |corners: &[DVec3; 3]| closest_point(point.at, corners).distance(point.at);
            let nearest = triangles.iter().map(|(t, corners)| (distance(corners), *t));
            let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, t)) = nearest {
                let least = t as usize + 1;
                if self.0.len() < least {
                    self.0.resize(least, Vec::new());
                }
                self.0[t as usize].push(point);
            }
        }
    }
}

/// Whether each point is as near to one of some triangles as it has to be.
pub fn are_near(points: &[Point], triangles: impl Iterator<Item = [DVec3; 3]> + Clone) -> bool {
    points.iter().all(|point| {
        let mut distances = triangles
            .clone()
            .map(|corners| closest_point(point.at, &corners).distance(point.at));
        distances.any(|distance| distance <= point.reach)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use std::sync::Arc;
    use tmesh::Triangle;

    /// Nothing is asked of it.
    struct Nothing;

    impl Shape for Nothing {
        fn nearest(&self, _: u32, _: DVec3) -> Option<(DVec3, DVec3)> {
            None
        }

        fn holds(&self, _: u32, _: [DVec3; 3]) -> bool {
            false
        }
    }

    /// A square of two triangles in one facet, and another one in a facet of its own.
    fn square() -> Template {
        let vertices = [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0]];
        let vertices = vertices.map(|[x, y]| DVec3::new(f64::from(x), f64::from(y), 0.0));
        let triangle = |vertices| Triangle {
            vertices,
            marker: 0,
            front: 0,
            back: 1,
        };
        Template {
            vertices: vertices.to_vec(),
            triangles: [[0, 1, 2], [0, 2, 3], [1, 4, 2]].map(triangle).to_vec(),
            ..Template::default()
        }
    }

    #[test]
    fn points_are_with_the_nearest_triangle_of_their_facet() {
        let point = |x: f64, y: f64| Point {
            at: DVec3::new(x, y, 0.1),
            reach: 0.2,
        };
        let points = [
            vec![point(0.8, 0.2), point(0.2, 0.8), point(1.9, 0.0)],
            vec![point(1.5, 0.2)],
        ];
        let template = square();
        let curved = Curved {
            shape: Arc::new(Nothing),
            patches: &[0, NO_PATCH],
            feature: 1.0,
            points: &points,
            scale: 4.0,
        };
        let mut near = Near::new(&template, &[0, 0, 1], &curved);
        let at = |near: &Near, t: u32| -> Vec<DVec3> {
            near.of(&[t]).iter().map(|p| p.at / 4.0).collect()
        };
        // Not with another facet's, though that is nearer, and none where there is no patch.
        assert_eq!(at(&near, 0), [points[0][0].at, points[0][2].at]);
        assert_eq!(at(&near, 1), [points[0][1].at]);
        assert_eq!(at(&near, 2), []);
        assert!(near.of(&[0, 1, 2]).iter().all(|p| p.reach == 0.8));
        // None is lost where triangles are divided, and new ones get theirs.
        let taken = near.take(&[0, 1]);
        assert_eq!((taken.len(), near.of(&[0, 1, 2, 9])), (3, Vec::new()));
        let far = [DVec3::X, DVec3::Y, DVec3::Z].map(|d| 100.0 * d);
        let corners = template.triangles[1]
            .vertices
            .map(|v| 4.0 * template.vertices[v as usize]);
        near.give(taken, &[(0, far), (9, corners)]);
        assert_eq!((near.of(&[0]).len(), near.of(&[9]).len()), (0, 3));
        // A triangle that is named twice has its points once.
        assert_eq!(near.take(&[9, 9]).len(), 3);
    }

    #[test]
    fn points_are_near_to_one_triangle_at_least() {
        let template = square();
        let corners = |t: usize| {
            template.triangles[t]
                .vertices
                .map(|v| template.vertices[v as usize])
        };
        let point = |x: f64, z: f64| Point {
            at: DVec3::new(x, 0.1, z),
            reach: 0.2,
        };
        let both = [corners(0), corners(2)];
        assert!(are_near(
            &[point(0.5, 0.19), point(1.5, -0.19)],
            both.into_iter()
        ));
        assert!(!are_near(
            &[point(0.5, 0.19), point(1.5, -0.21)],
            both.into_iter()
        ));
        assert!(!are_near(&[point(1.5, 0.0)], [corners(0)].into_iter()));
        assert!(are_near(&[], [corners(0)].into_iter()));
    }
}
