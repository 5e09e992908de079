//! What to say of a body in which the symmetry asked for does not hold.

use crate::detect::{Detection, Job};
use crate::error::{At, Closest, Error};
use crate::group::{Flip, Group};
use crate::mirror::HORIZONTAL;
use crate::order::{deviation_measured, powers};
use crate::placement;
use crate::refine::{Canonical, refine};
use crate::shape::Motion;
use crate::verify::{Bound, Depth, Deviation, Operation};
use glam::DVec3;
use tmesh::{Axis, Frame, RejectedOrder, Search, Symmetry};

impl Job<'_> {
    /// The operation that comes nearest to being a symmetry.
    pub(crate) fn closest(&self, directions: &[DVec3]) -> Option<Closest> {
        let shape = self.shape;
        let mut best: Option<(f64, Frame, u32)> = None;
        let samples = &shape.samples.mixed;
        let target = shape.target_in_place();
        let mirror = |frame: &Frame, count: usize| {
            let operation = Operation {
                motion: Motion::new(frame, HORIZONTAL),
                target: target.clone(),
            };
            let open = Bound::plain(f64::MAX);
            shape
                .worst(count.min(samples.len()), open, |i| {
                    (&samples[i], &operation)
                })
                .unwrap_or_else(|beyond| beyond)
        };
        for &d in directions.iter().take(16) {
            let Some(frame) = Frame::from_axis(self.centre, d, d.any_orthogonal_vector()) else {
                continue;
            };
            let radius = shape.radius(&frame).max(1e-12);
            for n in 1..=self.params.max_order.min(16) {
                let deviation = match n {
                    1 => mirror(&frame, 300),
                    n => deviation_measured(shape, &frame, n, 300, 0.2 * radius),
                };
                let residual = deviation.value / radius;
                if best.as_ref().is_none_or(|b| residual < b.0) {
                    best = Some((residual, frame, n));
                }
            }
        }
        let (_, frame, order) = best?;
        let matrices = match order {
            1 => vec![Canonical {
                matrix: HORIZONTAL,
                target: target.clone(),
            }],
            n => powers(n, &target),
        };
        let radius = shape.radius(&frame).max(1e-12);
        let measure = |frame: &Frame| match order {
            1 => mirror(frame, 3_000),
            n => deviation_measured(shape, frame, n, 3_000, f64::MAX),
        };
        let adjusted = refine(shape, frame, &matrices, 4_000, self.limits.loose * radius);
        let (as_is, better) = (measure(&frame), measure(&adjusted));
        let (frame, deviation) = if better.value < as_is.value {
            (adjusted, better)
        } else {
            (frame, as_is)
        };
        let deviation = match order {
            _ if deviation.value > self.params.tolerance * radius => deviation,
            1 => mirror(&frame, samples.len()),
            n => self.beyond(&frame, n, deviation),
        };
        Some(Closest {
            order,
            residual: deviation.value / radius,
            direction: At(frame.rotation.z_axis),
            place: At(shape.to_world(deviation.at)),
        })
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
    pub(crate) fn order_fails(&self, order: u32, directions: &[DVec3]) -> Error {
        let shape = self.shape;
        let measured = directions.iter().take(24).filter_map(|&d| {
            let frame = Frame::from_axis(self.centre, d, d.any_orthogonal_vector())?;
            let radius = shape.radius(&frame).max(1e-12);
            let deviation = deviation_measured(shape, &frame, order, 3_000, f64::MAX);
            Some((deviation.value / radius, deviation, frame))
        });
        let best = measured.min_by(|a, b| a.0.total_cmp(&b.0));
        let (mut residual, mut deviation, frame) =
            best.unwrap_or((1.0, Deviation::NONE, Frame::IDENTITY));
        if residual <= self.params.tolerance {
            deviation = self.beyond(&frame, order, deviation);
            residual = deviation.value / shape.radius(&frame).max(1e-12);
        }
        Error::OrderFails {
            order,
            tolerance: self.params.tolerance,
            residual,
            axis: At(frame.rotation.z_axis),
            centre: At(shape.to_world(frame.origin)),
            place: At(shape.to_world(deviation.at)),
        }
    }

    pub(crate) fn asymmetric(&self, closest: Option<Closest>, reason: String) -> Detection {
        let direction = self.params.axis.unwrap_or(DVec3::Z);
        let frame = Frame::from_axis(self.centre, direction, direction.any_orthogonal_vector())
            .unwrap_or(Frame::IDENTITY);
        let radius = self.shape.radius(&frame);
        let group = Group {
            order: 1,
            mirror: false,
            flip: Flip::None,
        };
        let x = placement::reference(&frame, &group);
        let rejected = closest
            .filter(|c| c.order > 1)
            .map(|c| RejectedOrder {
                order: c.order,
                residual: c.residual,
            })
            .into_iter()
            .collect();
        Detection {
            symmetry: Symmetry {
                group: group.named(),
                axis: Axis {
                    point: self.shape.to_world(self.centre).to_array(),
                    direction: frame.rotation.z_axis.to_array(),
                },
                reference: x.to_array(),
                residual: 0.0,
                tolerance: self.params.tolerance,
                axisymmetric: false,
                radius: radius * self.shape.scale,
                regions: Vec::new(),
            },
            search: Search {
                other_axes: Vec::new(),
                rejected,
            },
            notes: Vec::new(),
            profile: self.profile(&frame, 1),
            asymmetric: Some(reason),
        }
    }
}
