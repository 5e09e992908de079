//! Points of a curved shape, and the triangles of the surface that they are near to.

use crate::shape::{Curved, Point};
use geom::tree::closest_point;
use glam::DVec3;
use tmesh::Template;

/// The points that each triangle of a surface is near to, by its number. What is done to triangles keeps all of their points near to those that
/// are there then, so that no part of the shape is left out.
#[derive(Clone, Default)]
pub struct Near(Vec<Vec<Point>>);

impl Near {
    /// Gives the points of each facet to its triangles. A facet has few, so that all are looked at for each point.
    pub fn new(template: &Template, of_triangle: &[u32], curved: &Curved<'_>) -> Self {
        let mut near = Self(vec![Vec::new(); template.triangles.len()]);
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); curved.points.len()];
        for (t, &facet) in (0..).zip(of_triangle) {
            if !curved.points[facet as usize].is_empty() {
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
        let points = self.of(triangles);
        for &t in triangles {
            if let Some(points) = self.0.get_mut(t as usize) {
                points.clear();
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
