//! From a surface to its symmetry.

use crate::Params;
use crate::candidates::{self, distinct};
use crate::complete::Found;
use crate::error::{At, Error};
use crate::order::{COARSE, FACETS, Limits, Rotation, find_rotation, may_hold};
use crate::shape::Shape;
use crate::summary::OrderResidual;
use crate::verify::Depth;
use glam::DVec3;
use std::ops::RangeInclusive;
use tmesh::{Document, Frame, Search, Symmetry};

/// How far from the direction given, in radians, an adjusted axis may be.
const OVERRIDE_ANGLE: f64 = 0.02;

/// What was found, and remarks for the user.
pub struct Detection {
    /// The symmetry, in world coordinates.
    pub symmetry: Symmetry,
    /// What else the search came across.
    pub search: Search,
    /// Remarks, a sentence each.
    pub notes: Vec<String>,
    /// Residuals of all orders up to some, if [`Params::profile`] asked for them.
    pub profile: Vec<OrderResidual>,
    /// Why the body counts as asymmetric, when [`Params::allow_asymmetric`] let it pass.
    pub asymmetric: Option<String>,
}

/// Finds the symmetry of a body's surface. `log` hears of progress.
pub fn detect(
    document: &Document,
    params: &Params,
    log: &mut dyn FnMut(&str),
) -> Result<Detection, Error> {
    if !document.is_plain() {
        return Err(Error::NotPlain {
            templates: document.templates.len(),
            instances: document.instances.len(),
        });
    }
    let template = &document.templates[0];
    if template.triangles.is_empty() {
        return Err(Error::NoSurface);
    }
    let precision = document.source.as_ref().map(|s| s.precision);
    let shape = Shape::new(template, precision, params.threads).ok_or(Error::NoExtent {
        triangles: template.triangles.len(),
    })?;
    log(&format!(
        "surface prepared: {} kinds of interface, {} test points",
        shape.classes.len(),
        shape.samples.mixed.len()
    ));
    let job = Job {
        shape: &shape,
        params,
        limits: Limits::new(params.tolerance),
        centre: params.center.map_or(DVec3::ZERO, |c| shape.of_world(c)),
    };
    job.run(log)
}

pub(crate) struct Job<'a> {
    pub shape: &'a Shape,
    pub params: &'a Params,
    pub limits: Limits,
    pub centre: DVec3,
}

impl Job<'_> {
    pub(crate) fn orders(&self) -> RangeInclusive<u32> {
        match self.params.order {
            Some(n) => n..=n,
            None => 2..=self.params.max_order,
        }
    }

    fn run(mut self, log: &mut dyn FnMut(&str)) -> Result<Detection, Error> {
        let (directions, rotations) = if self.params.order == Some(1) {
            (self.directions(log), Vec::new())
        } else {
            self.rotations(log)
        };
        if self.params.order != Some(1) && self.facets_may_hide(&directions, &rotations) {
            self.limits.facets = true;
            let best = |all: &[Rotation]| all.iter().map(Rotation::rank).max();
            let wider = match self.main(&rotations) {
                Some(main) => self.beside(main, self.limits).into_iter().collect(),
                None => self.rotations(log).1,
            };
            if best(&wider) > best(&rotations) {
                log("facets of smooth surfaces allowed for");
                if let Some(found) = self.certified(wider.clone(), log) {
                    return Ok(self.report(found, &wider, log));
                }
            }
            self.limits.facets = false;
        }
        if let Some(found) = self.certified(rotations.clone(), log) {
            return Ok(self.report(found, &rotations, log));
        }
        if let Some(n) = self.params.order.filter(|&n| n > 1) {
            return Err(self.order_fails(n, &directions));
        }
        for facets in [false, true] {
            self.limits.facets = facets;
            if let Some(found) = self.mirror_only(&directions) {
                log("a single mirror plane");
                return Ok(self.report(found, &[], log));
            }
        }
        let closest = self.closest(&directions);
        let error = Error::Asymmetric {
            closest,
            tolerance: self.params.tolerance,
        };
        if self.params.allow_asymmetric {
            Ok(self.asymmetric(closest, error.to_string()))
        } else {
            Err(error)
        }
    }

    /// The best of the rotations that holds everywhere, with all that holds beside it.
    fn certified(&self, mut candidates: Vec<Rotation>, log: &mut dyn FnMut(&str)) -> Option<Found> {
        while let Some(best) = self.take_best(&mut candidates) {
            log(&format!(
                "order {} about {} by a quick test",
                best.order,
                At(best.frame.rotation.z_axis)
            ));
            let mut found = self.complete(best.clone());
            // Among half-turn axes the main one is that with the most operations beside it.
            if best.order == 2 {
                for other in candidates.iter().filter(|c| c.order == 2 && c.distinct) {
                    let other = self.complete(other.clone());
                    if other.group.rank() > found.group.rank() {
                        found = other;
                    }
                }
            }
            log(&format!("group {} by a quick test", found.group.symbol()));
            if !self.certify(&mut found) {
                let z = found.frame.rotation.z_axis;
                let (s, o, l) = (self.shape, self.orders(), self.limits);
                candidates.retain(|c| c.frame.rotation.z_axis.cross(z).length() > 2e-3);
                let lower = find_rotation(s, found.frame.origin, z, false, o, l, Depth::Full)
                    .filter(|r| r.order < found.group.order);
                candidates.extend(lower);
                log("some operation does not hold everywhere");
                continue;
            }
            log(&format!("group {} verified in full", found.group.symbol()));
            return Some(found);
        }
        None
    }

    /// Whether a higher order would hold with a few times the tolerance, and differences between facets may
    /// be the reason why it does not hold with the tolerance itself.
    fn facets_may_hide(&self, directions: &[DVec3], rotations: &[Rotation]) -> bool {
        let best = rotations.iter().max_by_key(|r| r.rank());
        if best.is_some_and(|b| b.axisymmetric) {
            return false;
        }
        let radius = best.map_or(1.0, |b| b.radius);
        if self.shape.facets().largest() < COARSE * self.limits.tolerance * radius {
            return false;
        }
        let limits = Limits::new((1.0 + FACETS) * self.limits.tolerance);
        let orders = match best {
            Some(b) if self.params.order.is_none() => b.order + 1..=self.params.max_order,
            _ => self.orders(),
        };
        if let Some(main) = self.main(rotations) {
            return self
                .beside(main, limits)
                .is_some_and(|r| r.rank() > main.rank());
        }
        directions.iter().take(12).any(|&d| {
            let (shape, orders) = (self.shape, orders.clone());
            find_rotation(shape, self.centre, d, false, orders, limits, Depth::Quick)
                .is_some_and(|r| best.is_none_or(|b| r.rank() > b.rank()))
        })
    }

    /// The rotation about the one axis of order above two: there is one unless the body is isotropic.
    fn main<'r>(&self, rotations: &'r [Rotation]) -> Option<&'r Rotation> {
        let best = rotations.iter().max_by_key(|r| r.rank());
        let main = best.filter(|b| b.distinct && b.order > 2);
        main.filter(|_| !candidates::principal(self.shape).isotropic)
    }

    /// The highest order within other limits about the axis of a rotation. What holds by the rotation itself holds
    /// together with it, so that only multiples of its order are possible.
    fn beside(&self, main: &Rotation, limits: Limits) -> Option<Rotation> {
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
        let more = self
            .orders()
            .filter(|&n| n > main.order && n.is_multiple_of(main.order));
        if exact && !may_hold(shape, &main.frame, more, limits) {
            return None;
        }
        let (frame, orders) = (&main.frame, self.orders());
        let z = frame.rotation.z_axis;
        find_rotation(shape, frame.origin, z, exact, orders, limits, Depth::Quick)
    }

    fn directions(&self, log: &mut dyn FnMut(&str)) -> Vec<DVec3> {
        if let Some(axis) = self.params.axis {
            return vec![axis];
        }
        let principal = candidates::principal(self.shape);
        let mut all = principal.directions;
        if principal.degenerate {
            all.extend(candidates::higher(self.shape));
            log(&format!("{} candidate directions", all.len()));
        }
        distinct(all)
    }

    /// Candidate directions, and the rotations found about them by a quick test.
    fn rotations(&self, log: &mut dyn FnMut(&str)) -> (Vec<DVec3>, Vec<Rotation>) {
        if let Some(axis) = self.params.axis {
            return (vec![axis], self.about(axis).into_iter().collect());
        }
        let find = |d: DVec3| {
            let (s, l) = (self.shape, self.limits);
            find_rotation(s, self.centre, d, false, self.orders(), l, Depth::Quick)
        };
        let principal = candidates::principal(self.shape);
        let mut directions = principal.directions;
        let mut found: Vec<Rotation> = Vec::new();
        for d in &directions {
            found.extend(find(*d));
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
            directions = distinct(directions);
            // Near-isotropic bodies of revolution have curves of critical points; a few will do.
            directions.truncate(tried + 60);
            found.extend(directions[tried..].iter().filter_map(|d| find(*d)));
            log(&format!(
                "{} further directions tried, {} have a rotation in all",
                directions.len() - tried,
                found.len()
            ));
        }
        found.retain(|r| self.passes_centre(&r.frame, r.frame.rotation.z_axis, r.radius));
        let mut kept: Vec<Rotation> = Vec::new();
        for r in found {
            let z = r.frame.rotation.z_axis;
            let same = |k: &Rotation| k.frame.rotation.z_axis.cross(z).length() < 2e-3;
            match kept.iter_mut().find(|k| same(k)) {
                Some(k) if r.order > k.order => *k = r,
                Some(_) => {}
                None => kept.push(r),
            }
        }
        (directions, kept)
    }

    /// The rotation about an axis the user gave: as given if that is as good as an adjusted one.
    fn about(&self, axis: DVec3) -> Option<Rotation> {
        let (shape, limits) = (self.shape, self.limits);
        let find = |fixed| {
            find_rotation(
                shape,
                self.centre,
                axis,
                fixed,
                self.orders(),
                limits,
                Depth::Quick,
            )
        };
        let given = find(true);
        if given
            .as_ref()
            .is_some_and(|g| g.deviation.value <= self.noise(g.radius))
        {
            return given;
        }
        let adjusted = find(false).filter(|a| {
            let z = a.frame.rotation.z_axis;
            z.cross(axis).length() <= OVERRIDE_ANGLE && self.passes_centre(&a.frame, z, a.radius)
        });
        match (given, adjusted) {
            (Some(g), Some(a)) if g.order > a.order => Some(g),
            (g, a) => a.or(g),
        }
    }

    /// Whether the line along `free` (or, with `free` zero, the point) through the frame's origin
    /// passes the centre that the user gave; an adjustment may move it by a few tolerances.
    pub(crate) fn passes_centre(&self, frame: &Frame, free: DVec3, radius: f64) -> bool {
        let off = frame.origin - self.centre;
        let off = (off - free * off.dot(free)).length();
        self.params.center.is_none() || off <= 4.0 * self.limits.tolerance * radius
    }

    /// Deviation that the input's precision explains, in the units of the shape.
    pub(crate) fn noise(&self, radius: f64) -> f64 {
        (1e-6 * radius).max(8.0 * self.shape.precision)
    }

    /// Removes and returns the best rotation: highest order, then clearly smaller deviation, then the
    /// axis nearest to z, x, y.
    fn take_best(&self, candidates: &mut Vec<Rotation>) -> Option<Rotation> {
        let mut best = 0;
        for i in 1..candidates.len() {
            let (a, b) = (&candidates[i], &candidates[best]);
            let residual = |r: &Rotation| r.deviation.value.max(self.noise(r.radius)) / r.radius;
            let better = if a.rank() != b.rank() {
                a.rank() > b.rank()
            } else if residual(a) < 0.5 * residual(b) || residual(b) < 0.5 * residual(a) {
                residual(a) < residual(b)
            } else {
                let (za, zb) = (a.frame.rotation.z_axis.abs(), b.frame.rotation.z_axis.abs());
                [DVec3::Z, DVec3::X, DVec3::Y]
                    .iter()
                    .map(|e| za.dot(*e) - zb.dot(*e))
                    .find(|d| d.abs() > 1e-6)
                    .is_some_and(|d| d > 0.0)
            };
            if better {
                best = i;
            }
        }
        (!candidates.is_empty()).then(|| candidates.swap_remove(best))
    }
}
