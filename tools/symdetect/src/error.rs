//! Why no symmetry could be reported.

use crate::nearly::Nearly;
use glam::DVec3;
use thiserror::Error;

/// Why detection failed.
#[derive(Debug, Error)]
pub enum Error {
    /// Nothing to look at.
    #[error("the document has no surface triangles; did the previous stage fail?")]
    NoSurface,
    /// Extent zero.
    #[error("the surface has no extent: all its {triangles} triangles lie in one point")]
    NoExtent {
        /// Number of triangles.
        triangles: usize,
    },
    /// Cut already.
    #[error(
        "the document holds {templates} templates placed {instances} times: it was cut already, and symdetect wants the whole surface"
    )]
    NotPlain {
        /// Templates.
        templates: usize,
        /// Instances.
        instances: usize,
    },
    /// No rotation, no mirror.
    #[error("{}", asymmetric(.closest, .nearly, *.tolerance))]
    Asymmetric {
        /// The least bad operation.
        closest: Option<Closest>,
        /// A rotation that nearly holds.
        nearly: Option<Box<Nearly>>,
        /// Tolerance, relative to the radius.
        tolerance: f64,
    },
    /// `--order` does not hold.
    #[error(
        "order {order} does not hold within {tolerance:e} of the radius: about the axis {} through {} the surface is off by {residual:.2e} of the radius at {}; raise --tolerance, or leave --order away to have the order found",
        at(axis),
        at(centre),
        at(place)
    )]
    OrderFails {
        /// The order asked for.
        order: u32,
        /// Tolerance, relative to the radius.
        tolerance: f64,
        /// Deviation, relative to the radius.
        residual: f64,
        /// Direction of the axis.
        axis: DVec3,
        /// A point on it.
        centre: DVec3,
        /// Where the deviation was found.
        place: DVec3,
    },
}

/// The least bad operation of an asymmetric body.
#[derive(Clone, Copy, Debug)]
pub struct Closest {
    /// Order of the rotation; 1 for a mirror.
    pub order: u32,
    /// Deviation, relative to the radius.
    pub residual: f64,
    /// Direction of the axis, or normal of the mirror plane.
    pub direction: DVec3,
    /// Where the deviation was found.
    pub place: DVec3,
}

fn at(p: &DVec3) -> String {
    kit::point(p.to_array())
}

fn asymmetric(closest: &Option<Closest>, nearly: &Option<Box<Nearly>>, tolerance: f64) -> String {
    let mut text = format!("no symmetry within {tolerance:e} of the radius");
    if let Some(nearly) = nearly {
        text += &format!(": {nearly}");
    } else if let Some(c) = closest {
        let what = if c.order > 1 {
            format!("order {} about the axis {}", c.order, at(&c.direction))
        } else {
            format!("a mirror plane with normal {}", at(&c.direction))
        };
        text += &format!(
            ": closest is {what}, off by {:.2e} of the radius at {}",
            c.residual,
            at(&c.place)
        );
    }
    text + "; raise --tolerance, or pass the body on as it is with --allow-asymmetric"
}
