//! How far orders are off that do not hold.

use crate::budget::{GLANCE, LISTED, REPORTED};
use crate::group::Found;
use crate::report::detection::OrderResidual;
use crate::rotation::Query;
use crate::threads;
use tmesh::{Frame, RejectedOrder};

/// Rejected orders listed at most.
const MOST_REJECTED: usize = 16;
/// Highest order that may be listed, whatever the group: a few multiples of all orders but the very high ones, whose
/// multiples are told by their facets anyway.
const HIGHEST_REJECTED: u32 = 768;
/// Lowest end of the orders that may be listed, and of those plotted, whatever the group.
const FEWEST_ORDERS: u32 = 24;
/// Orders plotted at most: as many as can be told apart in a plot.
const MOST_PLOTTED: u32 = 300;
/// Deviation, relative to the radius, beyond which a rejected order is not measured exactly at first.
const FAR_OFF: f64 = 0.05;

impl Query<'_> {
    /// Residuals of the orders up to twice the one that holds, and at least some.
    pub fn profile(&self, frame: &Frame, holds: u32) -> Vec<OrderResidual> {
        if !self.params.profile {
            return Vec::new();
        }
        let radius = self.shape.radius(frame).max(f64::MIN_POSITIVE);
        let most = (2 * holds).clamp(FEWEST_ORDERS, MOST_PLOTTED);
        let measure = |order| OrderResidual {
            order,
            residual: (self.shape)
                .deviation_measured(frame, order, REPORTED, radius)
                .value
                .min(radius)
                / radius,
            holds: holds.is_multiple_of(order),
        };
        (2..=most).map(measure).collect()
    }

    /// Orders about the main axis that do not hold: small multiples of the one found, and the ones
    /// that come nearest to holding.
    pub fn rejected(&self, found: &Found) -> Vec<RejectedOrder> {
        let n = found.group.order;
        let multiple = |m: u32| m == 2 * n || m == 3 * n;
        let tolerance = self.params.tolerance;
        let measure = |order: u32, count: usize, most: f64| RejectedOrder {
            order,
            residual: (self.shape)
                .deviation_measured(&found.frame, order, count, most)
                .value
                / found.radius,
        };
        let most_off = FAR_OFF * found.radius;
        // A few tests tell which ones are worth more.
        let orders = self.worth_listing(found, multiple);
        let mut measured = threads::map(&orders, |&m| {
            let rough = measure(m, GLANCE, most_off);
            match rough.residual > tolerance {
                true => rough,
                false => measure(m, LISTED, most_off),
            }
        });
        nearest_first(&mut measured, tolerance);
        let mut place = 0;
        measured.retain(|r| {
            place += 1;
            multiple(r.order) || place <= MOST_REJECTED + MOST_REJECTED / 4
        });
        measured = threads::map(&measured, |r| measure(r.order, LISTED, most_off));
        nearest_first(&mut measured, tolerance);
        let (mut kept, others): (Vec<_>, Vec<_>) =
            measured.into_iter().partition(|r| multiple(r.order));
        let left = MOST_REJECTED.saturating_sub(kept.len());
        kept.extend(others.into_iter().take(left));
        // So far only those near to holding are exact.
        kept = threads::map(&kept, |r| match r.residual > FAR_OFF {
            true => measure(r.order, LISTED, 1.0),
            false => r.clone(),
        });
        kept.sort_by_key(|r| r.order);
        kept
    }

    /// Orders that may be listed as rejected.
    fn worth_listing(&self, found: &Found, multiple: impl Fn(u32) -> bool) -> Vec<u32> {
        let n = found.group.order;
        let most = (4 * n).clamp(2 * FEWEST_ORDERS, HIGHEST_REJECTED);
        let most = most.min(self.params.max_order.max(n));
        (2..=most)
            .filter(|m| !n.is_multiple_of(*m))
            // Of a body of revolution all others are alike.
            .filter(|m| !found.axisymmetric || multiple(*m))
            .collect()
    }
}

/// Drops orders that hold by the few tests made, and sorts.
fn nearest_first(list: &mut Vec<RejectedOrder>, tolerance: f64) {
    list.retain(|r| r.residual > tolerance);
    list.sort_by(|a, b| {
        let by_residual = a.residual.total_cmp(&b.residual);
        by_residual.then(a.order.cmp(&b.order))
    });
}
