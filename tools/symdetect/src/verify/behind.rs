//! Whether deviations are explained by facets: comparison of the shapes behind them.

use crate::shape::{Motion, Sample, Shape, Target};
use crate::verify::deviation::Bound;
use crate::verify::operation::Operation;
use geom::tree::Nearest;
use glam::DVec3;

/// Cosine of the angle to a facet's normal up to which a point is above it rather than beyond its edge: half the largest
/// turn between facets of one face, a sixth of a turn.
const ABOVE: f64 = 0.866;

/// An image of a place above the facet that it should be on.
pub struct Apart {
    /// Height above the facet.
    pub facets: f64,
    /// Distance between what either facet may stand for; zero where that overlaps.
    pub gap: f64,
    /// Height of the shape behind the first facet above that behind the second.
    pub shapes: f64,
    /// How well that is known.
    pub slack: f64,
    /// How far other readings of the edges have either shape from what lies between it and its facet.
    pub doubt: f64,
}

impl Shape {
    /// The largest deviation that may be within a bound.
    pub fn most(&self, bound: Bound) -> f64 {
        match bound.facets {
            true => bound.limit + 2.0 * self.smooth().largest(),
            false => bound.limit,
        }
    }

    /// The nearest point of the surface to an image, if a bound may allow for its distance.
    pub fn near(
        &self,
        image: DVec3,
        triangle: u32,
        target: &Target,
        bound: Bound,
    ) -> Option<Nearest> {
        match bound.facets {
            true => self.nearest_behind((image, None), triangle, target, bound.limit),
            false => self.nearest(image, triangle, target, bound.limit),
        }
    }

    /// Whether the shapes that the facets stand for agree within a bound where the image of a sample is near a point
    /// of the surface.
    pub fn facets_explain(
        &self,
        sample: &Sample,
        operation: &Operation,
        hit: &Nearest,
        bound: Bound,
    ) -> bool {
        let (motion, limit) = (&operation.motion, bound.limit);
        let explained = |hit: &Nearest| {
            let apart = self.apart(sample, motion, hit);
            apart.is_some_and(|a| a.gap <= limit + a.slack)
        };
        if explained(hit) {
            return true;
        }
        // Near an edge, another face may be nearer than the one that the place is on.
        let image = motion.apply(sample.point);
        let normal = motion.linear * self.normals[sample.triangle as usize];
        let (triangle, target) = (sample.triangle, &operation.target);
        if !self.faces_like(hit.triangle, (normal, triangle)) {
            let alike = self.nearest_behind((image, Some(normal)), triangle, target, limit);
            if alike.is_some_and(|hit| explained(&hit)) {
                return true;
            }
        }
        hit.distance <= limit + self.edges_explain((sample.triangle, sample.point), hit)
    }

    /// How far, and in which direction, the image of a sample is from what facets explain: the least of what it is beyond a
    /// facet near it and beyond the sharp edges there. `None` if they do explain it, or if it is too far from all of them.
    pub fn unexplained(
        &self,
        sample: &Sample,
        operation: &Operation,
        bound: Bound,
    ) -> Option<(DVec3, f64)> {
        let (motion, limit) = (&operation.motion, bound.limit);
        let image = motion.apply(sample.point);
        let (triangle, target) = (sample.triangle, &operation.target);
        let hit = self.nearest_behind((image, None), triangle, target, limit)?;
        if self.facets_explain(sample, operation, &hit, Bound::plain(0.0)) {
            return None;
        }
        let normal = motion.linear * self.normals[triangle as usize];
        let alike = self.nearest_behind((image, Some(normal)), triangle, target, limit);
        let above = |hit: &Nearest| {
            let apart = self.apart(sample, motion, hit)?;
            let off = (apart.gap - apart.slack).copysign(apart.facets);
            Some((self.normals[hit.triangle as usize], off))
        };
        let beside = || {
            let off = hit.distance - self.edges_explain((triangle, sample.point), &hit);
            Some(((image - hit.point).try_normalize()?, off))
        };
        let all = [above(&hit), alike.and_then(|hit| above(&hit)), beside()];
        (all.into_iter().flatten()).min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    /// How far apart two drawings of a sharp edge may be that passes near a place and near a point of the surface: either
    /// is a polyline on a curve that bends as the narrower of the two drawings does.
    fn edges_explain(&self, place: (u32, DVec3), hit: &Nearest) -> f64 {
        let surface = (&self.vertices[..], &self.triangles[..]);
        let near = |place| self.smooth().edges_near(surface, place, hit.distance);
        let [here, there] = [near(place), near((hit.triangle, hit.point))];
        here.curvature.max(there.curvature) * (here.bow + there.bow)
    }

    /// How far apart facets, and the shapes behind them, are where the image of a sample is near a point of the
    /// surface; `None` where the image is not above the facet but beyond a sharp edge of it.
    pub fn apart(&self, sample: &Sample, motion: &Motion, hit: &Nearest) -> Option<Apart> {
        let [from, to] = [sample.triangle, hit.triangle].map(|t| self.normals[t as usize]);
        let mut facets = (motion.apply(sample.point) - hit.point).dot(to);
        if facets.abs() < ABOVE * hit.distance {
            // Above an edge of a smooth surface, but beyond one where it ends.
            let surface = (&self.vertices[..], &self.triangles[..]);
            if (self.smooth().sharp_edges()).pass(surface, (hit.triangle, hit.point)) {
                return None;
            }
            facets = hit.distance.copysign(facets);
        }
        let above = |t: u32, p| self.smooth().above(t, self.corners(t), p);
        let here = above(sample.triangle, sample.point);
        let there = above(hit.triangle, hit.point);
        // The other way around where the motion exchanges the sides of an interface.
        let side = (motion.linear * from).dot(to).signum();
        let [a, b] = here.range.map(|h| facets + side * h);
        let [low, high] = there.range;
        Some(Apart {
            facets,
            gap: (a.min(b) - high).max(low - a.max(b)).max(0.0),
            shapes: facets + side * here.shape - there.shape,
            slack: here.unknown_beside(&there),
            doubt: here.doubt() + there.doubt(),
        })
    }
}
