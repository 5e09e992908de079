//! The highest order about an axis that is left as it is.

use crate::rotation::facet_count::least_common_multiple;
use crate::rotation::find::{OrderSearch, Rotation};
use crate::shape::{Permutation, Sample, Target};
use crate::verify::Deviation;
use tmesh::Frame;

/// Places remembered where orders failed: several for each of the features that distinguish a part from a body of
/// revolution. Trying more of them takes longer than what it saves.
const OBSTACLES: usize = 32;

/// Orders with more divisors than any lower one (highly composite numbers, A002182 of the OEIS), for bodies of
/// revolution without a facet count.
const COMPOSITE: [u32; 14] = [2, 4, 6, 12, 24, 36, 48, 60, 120, 180, 240, 360, 720, 840];

impl OrderSearch<'_> {
    /// The highest order that holds with the frame as it is.
    pub fn in_frame(&self, frame: &Frame) -> Option<Rotation> {
        let radius = self.shape.radius(frame);
        let bound = self.limits.bound(radius);
        let full_range = self.orders.end() > self.orders.start();
        let revolution = full_range.then(|| self.shape.deviation_from_revolution(frame, bound));
        match revolution.flatten() {
            Some(off) => Some(self.of_revolution(frame, radius, off)),
            None => self.of_scan(frame, radius),
        }
    }

    /// The order of a body of revolution: its facet count, or many if it has none.
    fn of_revolution(&self, frame: &Frame, radius: f64, off: Deviation) -> Rotation {
        let bound = self.limits.bound(radius);
        let rotation = Rotation {
            frame: *frame,
            radius,
            order: 1,
            permutation: Permutation::identity(self.shape.region_count()),
            deviation: off,
            axisymmetric: true,
            distinct: false,
        };
        if let Some(order) = self.facet_count(frame, bound.limit)
            && self.may_number(frame, order, off.value)
            && let Ok((deviation, permutation)) =
                self.shape.verify_rotation(frame, order, bound, self.depth)
        {
            return Rotation {
                order,
                permutation,
                deviation,
                distinct: true,
                ..rotation
            };
        }
        let order = (COMPOSITE.iter().rev()).find(|n| self.orders.contains(n));
        Rotation {
            order: *order.unwrap_or(self.orders.start()),
            ..rotation
        }
    }

    /// The highest of the orders that pass a scan which holds. Where another one above half of it holds as well, and the
    /// rotations that they make together are not told from any rotation, all do.
    ///
    /// Where corners tell the order of the drawing at once, others are its multiples.
    fn of_scan(&self, frame: &Frame, radius: f64) -> Option<Rotation> {
        let bound = self.limits.bound(radius);
        let distinct = |order, (deviation, permutation)| Rotation {
            frame: *frame,
            radius,
            order,
            permutation,
            deviation,
            axisymmetric: false,
            distinct: true,
        };
        let corners = self.order_of_corners(frame);
        let own = corners
            .filter(|n| self.orders.contains(n))
            .and_then(|order| {
                let verified = self.shape.verify_rotation(frame, order, bound, self.depth);
                Some(distinct(order, verified.ok()?))
            });
        let multiples = match &own {
            Some(own) if own.order.is_multiple_of(self.multiples) => own.order,
            _ => self.multiples,
        };
        let mut highest: Option<Rotation> = None;
        // Others are not told from any rotation, under which the body has been found to differ.
        let highest_told = self.shape.highest_told(frame, radius, bound);
        let told = self.up_to(highest_told);
        // Near a body of revolution many orders fail at the same few places.
        let mut obstacles: Vec<Sample> = Vec::new();
        for order in told.scan(frame, bound, 0.0, multiples) {
            if highest.as_ref().is_some_and(|h| 2 * order <= h.order) {
                break;
            }
            if (obstacles.iter()).any(|sample| self.stumbles(frame, order, sample, bound)) {
                continue;
            }
            if own.as_ref().is_some_and(|own| own.order == order) {
                break;
            }
            match self.shape.verify_rotation(frame, order, bound, self.depth) {
                Ok((deviation, permutation)) => match &highest {
                    None => highest = Some(distinct(order, (deviation, permutation))),
                    Some(h) if least_common_multiple(h.order, order) > u64::from(highest_told) => {
                        return Some(self.of_revolution(frame, radius, deviation));
                    }
                    Some(_) => {}
                },
                Err(deviation) if obstacles.len() < OBSTACLES => {
                    // Either end may be the place that has no counterpart.
                    let place = |point| {
                        let near = self.shape.nearest(point, 0, &Target::Any, f64::INFINITY);
                        near.map(|n| Sample {
                            point: n.point,
                            triangle: n.triangle,
                        })
                    };
                    let ends = [deviation.at, deviation.image];
                    obstacles.extend(ends.into_iter().filter_map(place));
                }
                Err(_) => {}
            }
        }
        highest.or(own)
    }
}
