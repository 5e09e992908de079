//! What to say of a body in which the symmetry asked for does not hold.

use crate::budget::{FIT, QUICK, REPORTED};
use crate::error::{Closest, Error};
use crate::group::reference;
use crate::nearly::Nearly;
use crate::report::detection::Detection;
use crate::report::deviations::Deviations;
use crate::rotation::{Canonical, FIRST_DIRECTIONS, LOOSE_RANGE, Query, powers};
use crate::verify::{Bound, Depth, Deviation, Operation};
use geom::tree::alignment;
use glam::DVec3;
use tmesh::{Axis, Frame, Group, Isometry, RejectedOrder, Search, Symmetry};

/// Orders tried for the one nearest to holding, of a body in which none holds.
const ORDERS: u32 = 16;

impl Query<'_> {
    /// The operation that comes nearest to being a symmetry.
    pub fn closest(&self, directions: &[DVec3]) -> Option<Closest> {
        let shape = self.shape;
        // A mirror plane is told by the radius about the axis that would be found in it.
        let along = self.along_faces();
        let radius_of = |frame: &Frame, order: u32| match order {
            1 => self
                .frame_of_plane(&along, frame.origin, frame.rotation.z_axis)
                .map_or_else(
                    || self.radius_about(frame),
                    |within| self.radius_about(&within),
                ),
            _ => self.radius_about(frame),
        };
        let mut best: Option<(f64, Frame, u32)> = None;
        for &d in directions.iter().take(FIRST_DIRECTIONS) {
            let Some(frame) = self.frame_along(d) else {
                continue;
            };
            for n in 1..=self.params.max_order.min(ORDERS) {
                let radius = radius_of(&frame, n);
                let most = if n == 1 {
                    f64::MAX
                } else {
                    LOOSE_RANGE[1] * radius
                };
                let residual = self.off(&frame, n, REPORTED / 2, most).value / radius;
                if best.as_ref().is_none_or(|b| residual < b.0) {
                    best = Some((residual, frame, n));
                }
            }
        }
        let (_, frame, order) = best?;
        let target = shape.target_in_place();
        let canonical = match order {
            1 => vec![Canonical::new(Isometry::FLIP, target)],
            n => powers(n, &target),
        };
        let radius = radius_of(&frame, order);
        let measure = |frame: &Frame| self.off(frame, order, 2 * QUICK, f64::MAX);
        let adjusted = self.adjusted(frame, radius, &canonical, FIT);
        let (as_is, better) = (measure(&frame), measure(&adjusted));
        let (frame, deviation) = if better.value < as_is.value {
            (adjusted, better)
        } else {
            (frame, as_is)
        };
        let deviation = match order {
            _ if deviation.value > self.params.tolerance * radius => deviation,
            1 => self.off(&frame, 1, usize::MAX, f64::MAX),
            n => self.beyond(&frame, n, deviation),
        };
        Some(Closest {
            order,
            residual: deviation.value / radius,
            direction: frame.rotation.z_axis,
            place: shape.to_world(deviation.at),
        })
    }

    /// How far the body is off under an order, or for 1 under the mirror across the axis, at some samples.
    fn off(&self, frame: &Frame, order: u32, count: usize, most: f64) -> Deviation {
        let shape = self.shape;
        if order > 1 {
            let tolerance = self.params.tolerance * shape.radius(frame);
            return shape.deviation_measured(frame, order, count, (tolerance, most));
        }
        let samples = &shape.samples.mixed;
        let operation = Operation::new(frame, Isometry::FLIP, shape.target_in_place());
        let count = count.min(samples.len());
        shape
            .worst(count, Bound::plain(most), |i| (&samples[i], &operation))
            .unwrap_or_else(|beyond| beyond)
    }

    /// Where an order fails that a few samples have pass: the first place beyond the tolerance that a
    /// full verification finds.
    fn beyond(&self, frame: &Frame, order: u32, measured: Deviation) -> Deviation {
        let bound = Bound::plain(self.params.tolerance * self.shape.radius(frame));
        match self.shape.verify_rotation(frame, order, bound, Depth::Full) {
            Ok(_) => measured,
            Err(beyond) => measured.max(beyond),
        }
    }

    /// Why an order asked for does not hold.
    pub fn order_fails(&self, order: u32, directions: &[DVec3]) -> Error {
        let shape = self.shape;
        let directions = directions.iter().take(FIRST_DIRECTIONS);
        let measured = directions.filter_map(|&d| {
            let frame = self.frame_along(d)?;
            let radius = self.radius_about(&frame);
            let within = (self.params.tolerance * radius, f64::MAX);
            let deviation = shape.deviation_measured(&frame, order, 2 * QUICK, within);
            let residual = deviation.value / radius;
            Some((residual, deviation, frame))
        });
        let best = measured.min_by(|a, b| a.0.total_cmp(&b.0));
        let (mut residual, mut deviation, frame) =
            best.unwrap_or((1.0, Deviation::NONE, Frame::IDENTITY));
        if residual <= self.params.tolerance {
            deviation = self.beyond(&frame, order, deviation);
            residual = deviation.value / self.radius_about(&frame);
        }
        Error::OrderFails {
            order,
            tolerance: self.params.tolerance,
            residual,
            axis: frame.rotation.z_axis,
            centre: shape.to_world(frame.origin),
            place: shape.to_world(deviation.at),
        }
    }

    /// The body passed on without symmetry.
    pub fn asymmetric(
        &self,
        closest: Option<Closest>,
        nearly: Option<Nearly>,
        reason: String,
    ) -> Detection {
        let frame = self.frame_along_faces();
        let rejected = closest.filter(|c| c.order > 1).map(|c| RejectedOrder {
            order: c.order,
            residual: c.residual,
        });
        Detection {
            deviations: Deviations::default(),
            symmetry: Symmetry {
                group: Group::TRIVIAL,
                axis: Axis {
                    point: self.shape.to_world(self.centre).to_array(),
                    direction: frame.rotation.z_axis.to_array(),
                },
                reference: frame.rotation.x_axis.to_array(),
                residual: 0.0,
                tolerance: self.params.tolerance,
                axisymmetric: false,
                radius: self.shape.radius(&frame) * self.shape.scale,
                regions: Vec::new(),
            },
            search: Search {
                other_axes: Vec::new(),
                rejected: rejected.into_iter().collect(),
            },
            axes: 0,
            notes: Vec::new(),
            profile: self.profile(&frame, 1),
            nearly,
            asymmetric: Some(reason),
        }
    }

    /// A frame along the axis asked for. Where none is, any frame serves, and it lies along the faces: a mesher gets
    /// slivers between faces in planes that rounding has bent, and planes across coordinate axes have exact coordinates.
    fn frame_along_faces(&self) -> Frame {
        let shape = self.shape;
        let along = |z: DVec3, x: DVec3| Frame::from_axis(self.centre, z, x);
        let faces = match self.params.axis {
            Some(_) => None,
            None => alignment(shape.triangles.len(), |t| shape.corners(t as u32)),
        };
        let faces = faces.and_then(|rows| along(rows.row(2), rows.row(0)));
        faces.unwrap_or_else(|| {
            let direction = self.params.axis.unwrap_or(DVec3::Z);
            let frame = self.frame_along(direction).unwrap_or(Frame::IDENTITY);
            let x = reference(&frame, Group::TRIVIAL);
            along(frame.rotation.z_axis, x).unwrap_or(frame)
        })
    }

    /// A frame with its axis along a direction through the centre.
    fn frame_along(&self, direction: DVec3) -> Option<Frame> {
        Frame::from_axis(self.centre, direction, direction.any_orthogonal_vector())
    }

    /// The radius about the axis of a frame, never zero.
    fn radius_about(&self, frame: &Frame) -> f64 {
        self.shape.radius(frame).max(f64::MIN_POSITIVE)
    }
}
