//! How far orders are off that do not hold.

use crate::budget::{FULL, GLANCE, LISTED, REPORTED, SCAN};
use crate::group::Found;
use crate::report::detection::OrderResidual;
use crate::rotation::Query;
use crate::threads;
use tmesh::{Frame, RejectedOrder};

/// Orders plotted at most: all of them together take no more tests than a full verification. In a plot, no more could
/// be told apart.
const MOST_PLOTTED: usize = FULL / REPORTED;

/// Rejected orders listed at most: a quarter of other lists, because each entry has to be measured, and tests whose
/// images are far off the surface take longest.
const MOST_REJECTED: usize = LISTED / 4;

impl Query<'_> {
    /// Residuals of the orders up to twice the one that holds, and at least some.
    pub fn profile(&self, frame: &Frame, holds: u32) -> Vec<OrderResidual> {
        if !self.params.profile {
            return Vec::new();
        }
        let radius = self.shape.radius(frame).max(f64::MIN_POSITIVE);
        let most = (2 * holds).clamp(LISTED as u32, MOST_PLOTTED as u32);
        let measure = |order| OrderResidual {
            order,
            residual: self.residual(frame, radius, order, REPORTED),
            holds: holds.is_multiple_of(order),
        };
        (2..=most).map(measure).collect()
    }

    /// Deviation under an order, relative to the radius; at most 1.
    fn residual(&self, frame: &Frame, radius: f64, order: u32, tests: usize) -> f64 {
        let within = (self.params.tolerance * radius, radius);
        let measured = (self.shape).deviation_measured(frame, order, tests, within);
        measured.value.min(radius) / radius
    }

    /// Orders about the main axis that do not hold: small multiples of the one found, and the ones
    /// that come nearest to holding.
    pub fn rejected(&self, found: &Found) -> Vec<RejectedOrder> {
        let n = found.group.order;
        let multiple = |m: u32| m == 2 * n || m == 3 * n;
        let measure = |order: u32, tests: usize| RejectedOrder {
            order,
            residual: self.residual(&found.frame, found.radius, order, tests),
        };
        // A few tests tell which ones are worth more.
        let orders = self.worth_listing(found, multiple);
        let mut ranked = threads::map(&orders, |&m| measure(m, GLANCE));
        ranked.sort_by(|a, b| {
            let first = multiple(b.order).cmp(&multiple(a.order));
            let nearest = a.residual.total_cmp(&b.residual);
            first.then(nearest).then(a.order.cmp(&b.order))
        });
        ranked.truncate(MOST_REJECTED);
        let mut kept = threads::map(&ranked, |r| measure(r.order, SCAN));
        // As far as the tests can tell, these hold as well.
        kept.retain(|r| r.residual > self.params.tolerance);
        kept.sort_by_key(|r| r.order);
        kept
    }

    /// Orders that may be listed as rejected: up to a few multiples of the one found, and at least some.
    fn worth_listing(&self, found: &Found, multiple: impl Fn(u32) -> bool) -> Vec<u32> {
        let n = found.group.order;
        let most = (4 * n).max(LISTED as u32);
        let most = most.min(self.params.max_order.max(n));
        (2..=most)
            .filter(|m| !n.is_multiple_of(*m))
            // Of a body of revolution all others are alike.
            .filter(|m| !found.axisymmetric || multiple(*m))
            .collect()
    }
}
