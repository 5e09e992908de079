//! The rotations about all axes that a body can have.

use crate::allowance::model::COARSE;
use crate::rotation::candidates::{self, distinct};
use crate::rotation::find::Rotation;
use crate::rotation::limits::Limits;
use crate::rotation::query::Query;
use crate::shape::DirectionalMoment;
use glam::DVec3;

/// Candidate directions that are tried again with more tolerance, where no rotation was found at all.
pub const FIRST_DIRECTIONS: usize = 16;

impl Query<'_> {
    /// Candidate directions.
    pub fn directions(&self, log: &mut dyn FnMut(&str)) -> Vec<DVec3> {
        if let Some(axis) = self.params.axis {
            return vec![axis];
        }
        let principal = candidates::principal(self.shape, self.parallel);
        let mut all = principal.directions;
        if principal.degenerate {
            all.extend(candidates::higher(self.shape));
            log(&format!("{} candidate directions", all.len()));
        }
        distinct(all, self.parallel)
    }

    /// Candidate directions, and the rotations found about them by a quick test.
    pub fn rotations(&self, log: &mut dyn FnMut(&str)) -> (Vec<DVec3>, Vec<Rotation>) {
        if let Some(axis) = self.params.axis {
            return (vec![axis], self.about(axis).into_iter().collect());
        }
        let search = self.search(self.orders(), self.limits);
        let find = |d: &DVec3| search.find(self.centre, *d, false);
        let principal = candidates::principal(self.shape, self.parallel);
        let mut directions = principal.directions;
        let mut found: Vec<Rotation> = Vec::new();
        for d in &directions {
            found.extend(find(d));
            // No other axis can have an order above two.
            if !principal.isotropic && found.iter().any(Rotation::is_high) {
                break;
            }
        }
        log(&format!(
            "principal directions tried, {} have a rotation",
            found.len()
        ));
        let has_high = found.iter().any(Rotation::is_high);
        if principal.isotropic || (principal.degenerate && !has_high) {
            let tried = directions.len();
            directions.extend(candidates::higher(self.shape));
            directions = distinct(directions, self.parallel);
            directions.truncate(tried + DirectionalMoment::MOST_DIRECTIONS);
            found.extend(directions[tried..].iter().filter_map(find));
            log(&format!(
                "{} further directions tried, {} have a rotation in all",
                directions.len() - tried,
                found.len()
            ));
        }
        found.retain(|r| self.passes_centre(&r.frame, r.frame.rotation.z_axis, r.radius));
        let found = self.highest_of_each_axis(found);
        (directions, found)
    }

    /// The rotation about an axis the user gave: as given if that is as good as an adjusted one.
    fn about(&self, axis: DVec3) -> Option<Rotation> {
        let search = self.search(self.orders(), self.limits);
        let given = search.find(self.centre, axis, true);
        let good = |g: &Rotation| g.deviation.value <= self.noise(g.radius);
        if given.as_ref().is_some_and(good) {
            return given;
        }
        let adjusted = search.find(self.centre, axis, false).filter(|a| {
            // What was given was rounded for typing, but no coarser than a candidate may be.
            let z = a.frame.rotation.z_axis;
            z.cross(axis).length() <= self.limits.loose && self.passes_centre(&a.frame, z, a.radius)
        });
        match (given, adjusted) {
            (Some(g), Some(a)) if g.order > a.order => Some(g),
            (g, a) => a.or(g),
        }
    }

    /// Whether a higher order would hold with a few times the tolerance, and differences between facets may
    /// be the reason why it does not hold with the tolerance itself.
    pub fn facets_may_hide(&self, directions: &[DVec3], rotations: &[Rotation]) -> bool {
        let best = rotations.iter().max_by_key(|r| r.rank());
        if best.is_some_and(|b| b.axisymmetric) {
            return false;
        }
        let radius = best.map_or(1.0, |b| b.radius);
        if self.shape.facets().largest() < COARSE * self.limits.tolerance * radius {
            return false;
        }
        let limits = self.limits.widened();
        if let Some(main) = self.main(rotations) {
            return self
                .beside(main, limits)
                .is_some_and(|r| r.rank() > main.rank());
        }
        let orders = match best {
            Some(b) if self.params.order.is_none() => b.order + 1..=self.params.max_order,
            _ => self.orders(),
        };
        let search = self.search(orders, limits);
        directions.iter().take(FIRST_DIRECTIONS).any(|&d| {
            let found = search.find(self.centre, d, false);
            found.is_some_and(|r| best.is_none_or(|b| r.rank() > b.rank()))
        })
    }

    /// The rotation about the one axis of order above two: there is one unless the body is isotropic.
    pub fn main<'r>(&self, rotations: &'r [Rotation]) -> Option<&'r Rotation> {
        let best = rotations.iter().max_by_key(|r| r.rank());
        let main = best.filter(|b| b.distinct && b.order > 2);
        main.filter(|_| !candidates::principal(self.shape, self.parallel).isotropic)
    }

    /// The highest order within other limits about the axis of a rotation. What holds by the rotation itself holds
    /// together with it, so that only multiples of its order are possible.
    pub fn beside(&self, main: &Rotation, limits: Limits) -> Option<Rotation> {
        let shape = self.shape;
        let limits = Limits {
            multiples_of: main.order,
            ..limits
        };
        // Where all orders hold within these limits, the facets have told theirs.
        let most = limits.bound(main.radius).most();
        if shape.deviation_from_revolution(&main.frame, most).is_some() {
            return None;
        }
        // Where it is exact, there is nothing to adjust.
        let exact = main.deviation.value <= shape.rounding();
        let orders = self.orders();
        let higher = *orders.start().max(&(main.order + 1))..=*orders.end();
        if exact && !self.search(higher, limits).may_hold(&main.frame) {
            return None;
        }
        let (origin, z) = (main.frame.origin, main.frame.rotation.z_axis);
        self.search(orders, limits).find(origin, z, exact)
    }

    /// The rotation of the highest order about each axis.
    fn highest_of_each_axis(&self, found: Vec<Rotation>) -> Vec<Rotation> {
        let mut kept: Vec<Rotation> = Vec::new();
        for r in found {
            let z = r.frame.rotation.z_axis;
            let same = |k: &Rotation| self.same_axis(k.frame.rotation.z_axis, z);
            match kept.iter_mut().find(|k| same(k)) {
                Some(k) if r.order > k.order => *k = r,
                Some(_) => {}
                None => kept.push(r),
            }
        }
        kept
    }
}
