//! The highest order about an axis that is left as it is.

use crate::allowance::is_of_facets;
use crate::allowance::model::{LOW, UNEXPLAINED};
use crate::rotation::facet_count::SEPARATION;
use crate::rotation::find::{OrderSearch, Rotation};
use crate::shape::{Permutation, Target};
use crate::verify::{Bound, Deviation};
use glam::DVec3;
use tmesh::Frame;

/// Places remembered where orders failed: several for each of the features that distinguish a part from a body of
/// revolution. Trying more of them takes longer than what it saves.
const OBSTACLES: usize = 32;

/// Orders with more divisors than any lower one (highly composite numbers, A002182 of the OEIS), for bodies of
/// revolution without a facet count.
const COMPOSITE: [u32; 14] = [2, 4, 6, 12, 24, 36, 48, 60, 120, 180, 240, 360, 720, 840];

/// Why an order does not hold.
enum Failure {
    /// Something is off by more than the bound.
    Off(Deviation),
    /// Facets explain each place, but not all of them together.
    NotOfFacets,
}

impl OrderSearch<'_> {
    /// The highest order that holds with the frame as it is.
    pub fn in_frame(&self, frame: &Frame) -> Option<Rotation> {
        let radius = self.shape.radius(frame);
        let limit = self.limits.bound(radius).limit;
        let full_range = self.orders.end() > self.orders.start();
        let revolution = (self.shape).deviation_from_revolution(frame, SEPARATION * limit);
        let found = revolution.filter(|_| full_range);
        let found = found.and_then(|d| self.of_revolution(frame, radius, d));
        let axisymmetric = revolution.is_some_and(|d| d.value <= limit);
        found.or_else(|| self.of_scan(frame, radius, axisymmetric))
    }

    /// Deviation and regions under an order. What deviates beyond the limit must look like facets.
    fn verify(
        &self,
        frame: &Frame,
        n: u32,
        bound: Bound,
    ) -> Result<(Deviation, Permutation), Failure> {
        let found = (self.shape)
            .verify_rotation(frame, n, bound, self.depth)
            .map_err(Failure::Off)?;
        let value = found.0.value;
        if value > bound.limit && !is_of_facets(self.shape, frame, n, value, bound.limit) {
            return Err(Failure::NotOfFacets);
        }
        Ok(found)
    }

    /// The order of what is nearly a body of revolution: its facet count, or many if it has none.
    fn of_revolution(&self, frame: &Frame, radius: f64, off: Deviation) -> Option<Rotation> {
        let bound = self.limits.bound(radius);
        let axisymmetric = off.value <= bound.limit;
        let rotation = Rotation {
            frame: *frame,
            radius,
            order: 1,
            permutation: Permutation::identity(self.shape.region_count()),
            deviation: off,
            axisymmetric,
            distinct: false,
        };
        if let Some(order) = self.facet_count(frame, bound.limit)
            && let Ok((deviation, permutation)) = self.verify(frame, order, bound)
        {
            // The sagitta of the facets: a polygon of that many sides deviates just so much, and hardly more where
            // the axis is a little off.
            let sagitta = radius * (1.0 - libm::cos(std::f64::consts::PI / f64::from(order)));
            return Some(Rotation {
                order,
                permutation,
                deviation,
                axisymmetric: axisymmetric || off.value <= 1.05 * sagitta,
                distinct: true,
                ..rotation
            });
        }
        let order = (COMPOSITE.iter().rev())
            .find(|&n| self.orders.contains(n) && self.limits.admit(*n))
            .copied()
            .unwrap_or(self.limits.multiples_of.max(*self.orders.start()));
        axisymmetric.then_some(Rotation { order, ..rotation })
    }

    /// The highest of the orders that pass a scan which holds.
    fn of_scan(&self, frame: &Frame, radius: f64, axisymmetric: bool) -> Option<Rotation> {
        let bound = self.limits.bound(radius);
        // Near a body of revolution many orders fail at the same few places.
        let mut obstacles: Vec<DVec3> = Vec::new();
        let mut unexplained = 0;
        for order in self.scan(frame, bound.most(), 0.0).into_iter().rev() {
            let bound = match unexplained >= UNEXPLAINED && order > LOW {
                true => Bound::plain(bound.limit),
                false => bound,
            };
            if (obstacles.iter()).any(|p| self.stumbles(frame, order, *p, bound.most())) {
                continue;
            }
            match self.verify(frame, order, bound) {
                Ok((deviation, permutation)) => {
                    return Some(Rotation {
                        frame: *frame,
                        radius,
                        order,
                        permutation,
                        deviation,
                        axisymmetric,
                        distinct: true,
                    });
                }
                Err(Failure::NotOfFacets) => unexplained += 1,
                Err(Failure::Off(deviation)) if obstacles.len() < OBSTACLES => {
                    // Either end may be the place that has no counterpart.
                    let image = deviation.image;
                    let near = (self.shape).nearest(image, 0, &Target::Any, f64::INFINITY);
                    obstacles.push(deviation.at);
                    obstacles.extend(near.map(|n| n.point));
                }
                Err(Failure::Off(_)) => {}
            }
        }
        None
    }
}
