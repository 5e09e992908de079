//! What is asked of a body.

use crate::params::Params;
use crate::rotation::find::OrderSearch;
use crate::rotation::limits::Limits;
use crate::rotation::refine::{Canonical, Fit, refine};
use crate::shape::Shape;
use crate::tolerance::{ROUNDINGS, SINGLE};
use crate::verify::Depth;
use geom::tolerance::{Extent, Tolerance};
use glam::DVec3;
use std::ops::RangeInclusive;
use tmesh::{Frame, Group};

/// A body and what is wanted of it.
pub struct Query<'a> {
    /// The body.
    pub shape: &'a Shape,
    /// The options.
    pub params: &'a Params,
    /// The tolerances at present.
    pub limits: Limits,
    /// The centre, given or that of mass, in the coordinates of the shape.
    pub centre: DVec3,
    /// Sine of the angle up to which two directions are the same axis.
    pub parallel: f64,
    /// The group of the drawing, where that of the shape behind it is looked for.
    pub drawn: Option<Drawn>,
}

/// A group about an axis that is known already.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// Unit direction of the axis.
    pub axis: DVec3,
    /// The group.
    pub group: Group,
}

impl<'a> Query<'a> {
    /// Of the options.
    pub fn new(shape: &'a Shape, params: &'a Params) -> Self {
        // The shape fills the unit ball.
        let extent = Extent {
            radius: 1.0,
            height: 1.0,
        };
        Self {
            shape,
            params,
            parallel: Tolerance::new(extent, shape.precision, params.tolerance).parallel(),
            limits: Limits::new(params.tolerance, params.facets),
            centre: params.center.map_or(DVec3::ZERO, |c| shape.of_world(c)),
            drawn: None,
        }
    }

    /// Points that axes may pass near: the centre and, where that is farther off than a candidate may be but no farther than
    /// facets may shift it, that of the corners.
    pub fn centres(&self) -> impl Iterator<Item = DVec3> {
        let smooth = || self.shape.smooth();
        let looked_at = self.limits.facets && self.params.center.is_none();
        let other = looked_at.then(|| smooth().corners().centre()).flatten();
        // An image is displaced by twice that.
        let near = 0.5 * self.limits.loose;
        let shift = |c: DVec3| c.distance(self.centre);
        let other = other.filter(|c| (near..smooth().mean()).contains(&shift(*c)));
        [self.centre].into_iter().chain(other)
    }

    /// Whether two unit vectors are, either way round, the direction of the same axis.
    pub fn same_axis(&self, a: DVec3, b: DVec3) -> bool {
        a.cross(b).length() < self.parallel
    }

    /// Orders asked for.
    pub fn orders(&self) -> RangeInclusive<u32> {
        match self.params.order {
            Some(n) => n..=n,
            None => 2..=self.params.max_order,
        }
    }

    /// A search for the orders asked for about one axis, by quick tests. What is behind the facets of a drawing has the
    /// rotation of the drawing.
    pub fn search_about(&self, axis: DVec3) -> OrderSearch<'a> {
        let drawn = (self.drawn).filter(|d| self.same_axis(d.axis, axis));
        OrderSearch {
            multiples: drawn.map_or(1, |d| d.group.order),
            ..self.search(self.orders())
        }
    }

    /// A search for orders about one axis, by quick tests.
    pub fn search(&self, orders: RangeInclusive<u32>) -> OrderSearch<'a> {
        OrderSearch {
            shape: self.shape,
            orders,
            multiples: 1,
            limits: self.limits,
            depth: Depth::Quick,
        }
    }

    /// Whether the line along `free` (or, with `free` zero, the point) through the frame's origin
    /// passes the centre that the user gave; an adjustment may move it by as much as it adjusts.
    pub fn passes_centre(&self, frame: &Frame, free: DVec3, radius: f64) -> bool {
        let off = frame.origin - self.centre;
        let off = (off - free * off.dot(free)).length();
        self.params.center.is_none() || off <= 0.5 * self.limits.loose * radius
    }

    /// A candidate's frame adjusted to operations, from up to so many equations.
    pub fn adjusted(
        &self,
        start: Frame,
        radius: f64,
        operations: &[Canonical],
        samples: usize,
    ) -> Frame {
        let fit = Fit {
            operations,
            samples,
            reach: self.limits.loosely(radius).limit,
            bound: self.limits.bound(radius),
        };
        refine(self.shape, start, &fit)
    }

    /// Deviation that the input's precision explains, in the units of the shape; never less than that of single
    /// precision, which the input may have had before.
    pub fn noise(&self, radius: f64) -> f64 {
        (SINGLE * radius).max(ROUNDINGS * self.shape.precision)
    }
}
