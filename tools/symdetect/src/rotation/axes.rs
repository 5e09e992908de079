//! The rotations about all axes that a body can have.

use crate::rotation::candidates::{self, distinct};
use crate::rotation::find::{OrderSearch, Rotation};
use crate::rotation::limits::OUTLIERS;
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
        let principal = candidates::principal(self.shape, self.same_candidate());
        let mut all = principal.directions;
        if principal.degenerate {
            all.extend(self.shape.critical_directions());
            log(&format!("{} candidate directions", all.len()));
        }
        distinct(all, self.same_candidate())
    }

    /// Candidate directions, and the rotations found about them by a quick test.
    pub fn rotations(&self, log: &mut dyn FnMut(&str)) -> (Vec<DVec3>, Vec<Rotation>) {
        if let Some(axis) = self.params.axis {
            return (vec![axis], self.about(axis).into_iter().collect());
        }
        let find = |d: &DVec3| self.possible_about(*d)?.find_near(self.centres(), *d);
        let principal = candidates::principal(self.shape, self.same_candidate());
        let mut directions = principal.directions;
        // No other axis than one of an order above two can have such an order.
        let main = (self.drawn).filter(|d| d.group.order > 2 && !principal.isotropic);
        if let Some(main) = main {
            directions = vec![main.axis];
        }
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
        let has_high = main.is_some() || found.iter().any(Rotation::is_high);
        if principal.isotropic || (principal.degenerate && !has_high) {
            let tried = directions.len();
            directions.extend(self.shape.critical_directions());
            directions = distinct(directions, self.same_candidate());
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

    /// Sine of the angle up to which two directions are one candidate: it is adjusted, from as far off.
    pub fn same_candidate(&self) -> f64 {
        self.parallel.max(self.limits.loose)
    }

    /// A search for the orders about a direction that second moments do not rule out, if any.
    fn possible_about(&self, direction: DVec3) -> Option<OrderSearch<'_>> {
        let mut search = self.search_about(direction);
        // What is off about a candidate shifts second moments by about its share.
        if !self.shape.moments.allow_high_order(direction, OUTLIERS) {
            let (lowest, highest) = search.orders.into_inner();
            search.orders = lowest..=highest.min(2);
        }
        (!search.orders.is_empty()).then_some(search)
    }

    /// The rotation about an axis the user gave: as given if that is as good as an adjusted one.
    fn about(&self, axis: DVec3) -> Option<Rotation> {
        let search = self.search_about(axis);
        let given = search.find(self.centre, axis, true);
        let good = |g: &Rotation| g.deviation.value <= self.noise(g.radius);
        if given.as_ref().is_some_and(good) {
            return given;
        }
        let adjusted = search.find_near(self.centres(), axis).filter(|a| {
            // What was given was rounded for typing, but no coarser than a candidate may be.
            let z = a.frame.rotation.z_axis;
            z.cross(axis).length() <= self.limits.loose && self.passes_centre(&a.frame, z, a.radius)
        });
        match (given, adjusted) {
            (Some(g), Some(a)) if g.order > a.order => Some(g),
            (g, a) => a.or(g),
        }
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
