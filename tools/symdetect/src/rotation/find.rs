//! The highest rotation order about one axis.

use crate::budget::{FIT, NEXT_BEST, QUICK};
use crate::rotation::limits::{Limits, OUTLIERS};
use crate::rotation::refine::{Canonical, Fit, refine};
use crate::shape::{Permutation, Shape, Target};
use crate::verify::{Depth, Deviation, golden_turns, some_powers};
use glam::DVec3;
use std::ops::RangeInclusive;
use tmesh::Frame;

/// A rotation symmetry found.
#[derive(Clone, Debug)]
pub struct Rotation {
    /// Axis z, centre at the origin.
    pub frame: Frame,
    /// Largest distance of the surface from the axis.
    pub radius: f64,
    /// Order.
    pub order: u32,
    /// Regions under one step.
    pub permutation: Permutation,
    /// Largest deviation, in the units of the shape.
    pub deviation: Deviation,
    /// Whether all orders hold.
    pub axisymmetric: bool,
    /// Whether the order stands out; false for a body of revolution without a facet count.
    pub distinct: bool,
}

impl Rotation {
    /// High orders come before low ones; a body of revolution whose order does not stand out comes
    /// between two and three: besides it there can only be half turns, unless the body is a ball.
    pub fn rank(&self) -> u32 {
        if self.distinct { 2 * self.order } else { 5 }
    }

    /// Whether no axis across this one can have an order above two, unless the body is isotropic.
    pub fn is_high(&self) -> bool {
        self.order > 2 && (self.distinct || self.axisymmetric)
    }

    /// Whether this is the better find. `noise` is the deviation that is not worth a distinction.
    fn beats(&self, other: &Self, noise: f64) -> bool {
        // Where all orders hold in one frame, those that hold in another one are no more.
        if self.axisymmetric != other.axisymmetric {
            return self.axisymmetric;
        }
        if self.rank() != other.rank() {
            return self.rank() > other.rank();
        }
        self.deviation.value.max(noise) < other.deviation.value.max(noise)
    }
}

/// Rotations by golden turns that an axis is adjusted to where no order is to be preferred.
const GOLDEN: usize = 12;
/// A search for the highest order about an axis.
pub struct OrderSearch<'a> {
    /// The body.
    pub shape: &'a Shape,
    /// Orders looked for.
    pub orders: RangeInclusive<u32>,
    /// A number that they are multiples of.
    pub multiples: u32,
    /// Tolerances.
    pub limits: Limits,
    /// How thoroughly they are verified.
    pub depth: Depth,
}

impl OrderSearch<'_> {
    /// Finds the highest order about an axis near `direction` through a point near `centre`.
    ///
    /// The axis and centre are adjusted to the shape unless `fixed`. Near a body of revolution, where
    /// many orders hold within the tolerance, the facet count is told by its deviation.
    pub fn find(&self, centre: DVec3, direction: DVec3, fixed: bool) -> Option<Rotation> {
        let shape = self.shape;
        let start = Frame::from_axis(centre, direction, direction.any_orthogonal_vector())?;
        let radius = shape.radius(&start);
        if radius <= 0.0 {
            return None;
        }
        let as_is = self.in_frame(&start);
        let exact = |r: &Rotation| r.distinct && r.deviation.value <= shape.rounding();
        if fixed || as_is.as_ref().is_some_and(exact) {
            return as_is;
        }
        let found = self.adjusted(start, radius, as_is)?;
        let polished = self.polished(&found, radius);
        self.better(Some(found), polished)
    }

    /// What is found about an axis near `direction` through a point near the first of some centres where anything is.
    pub fn find_near(
        &self,
        mut centres: impl Iterator<Item = DVec3>,
        direction: DVec3,
    ) -> Option<Rotation> {
        centres.find_map(|centre| self.find(centre, direction, false))
    }

    /// The same search for orders up to one.
    pub fn up_to(&self, highest: u32) -> Self {
        let (lowest, most) = (*self.orders.start(), *self.orders.end());
        Self {
            orders: lowest..=most.min(highest),
            ..*self
        }
    }

    fn better(&self, one: Option<Rotation>, other: Option<Rotation>) -> Option<Rotation> {
        match (one, other) {
            (Some(a), Some(b)) if b.beats(&a, 0.5 * self.shape.precision) => Some(b),
            (a, b) => a.or(b),
        }
    }

    /// The best of what holds in the frame as it is and what holds after an adjustment to the orders that a scan
    /// leaves possible.
    fn adjusted(&self, start: Frame, radius: f64, mut as_is: Option<Rotation>) -> Option<Rotation> {
        let shape = self.shape;
        let bound = self.limits.loosely(radius);
        let in_frame_for = |operations: &[Canonical]| {
            self.in_frame(&self.fitted(start, radius, (operations, FIT)))
        };
        if self.orders.end() > self.orders.start() {
            if shape.deviation_from_revolution(&start, bound).is_some() {
                return self.better(as_is, in_frame_for(&golden()));
            }
            // About a rough axis, much of a round body that is drawn coarsely is off, and the order of its facets is one of
            // many that are off by no more.
            if shape.off_revolution(&start, bound) <= 2.0 * OUTLIERS {
                let frame = self.fitted(start, radius, (&golden(), FIT));
                let found = self.in_frame(&frame);
                let bound = self.limits.bound(shape.radius(&frame));
                as_is = self.better(as_is, found);
                if shape.deviation_from_revolution(&frame, bound).is_some() {
                    return as_is;
                }
            }
        }
        let target = shape.target_in_place();
        let told = self.up_to(shape.highest_told(&start, radius, bound));
        let candidates = told.scan(&start, bound, OUTLIERS, self.multiples);
        let mut found = (candidates.into_iter().take(NEXT_BEST)).map(|n| {
            // What a few equations bring no nearer than a candidate must be does not hold.
            let operations = powers(n, &target);
            let rough = self.fitted(start, radius, (&operations, QUICK));
            let loose = self.limits.loosely(shape.radius(&rough));
            let may_hold = shape
                .verify_rotation(&rough, n, loose, Depth::Quick)
                .is_ok();
            let frame = may_hold.then(|| self.fitted(rough, radius, (&operations, FIT)))?;
            self.in_frame(&frame)
        });
        let found = found.find_map(|found| found);
        self.better(as_is, found)
    }

    /// A candidate's frame adjusted to operations, from up to so many equations.
    fn fitted(
        &self,
        start: Frame,
        radius: f64,
        (operations, samples): (&[Canonical], usize),
    ) -> Frame {
        let fit = Fit {
            operations,
            samples,
            reach: self.limits.loosely(radius).limit,
            bound: self.limits.bound(radius),
        };
        refine(self.shape, start, &fit)
    }

    /// What holds after an adjustment to the order found.
    fn polished(&self, found: &Rotation, radius: f64) -> Option<Rotation> {
        let shape = self.shape;
        let operations = match found.distinct {
            false => golden(),
            true if found.permutation.is_identity() => {
                powers(found.order, &shape.target_in_place())
            }
            true => powers(found.order, &Target::Any),
        };
        let fit = Fit {
            operations: &operations,
            samples: 3 * FIT,
            reach: self.limits.reach(found.deviation.value, radius),
            bound: self.limits.needed(found.deviation.value, radius),
        };
        self.in_frame(&refine(shape, found.frame, &fit))
    }
}

/// A handful of powers of the rotation by a turn over `n`, for an adjustment.
pub fn powers(n: u32, target: &Target) -> Vec<Canonical> {
    let canonical = |power| Canonical::new(power, target.clone());
    some_powers(n).into_iter().map(canonical).collect()
}

/// A dozen rotations spread over the whole turn, for an adjustment where no order is to be preferred.
pub fn golden() -> Vec<Canonical> {
    let canonical = |matrix| Canonical {
        matrix,
        target: Target::Any,
    };
    golden_turns(GOLDEN).map(canonical).collect()
}
