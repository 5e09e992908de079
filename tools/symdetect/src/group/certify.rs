//! The best group that holds everywhere.

use crate::budget::SURVEY;
use crate::group::found::Found;
use crate::rotation::{Canonical, Fit, Query, Rotation, explain, golden, powers};
use crate::shape::Target;
use crate::tolerance::compare_along_axes;
use crate::verify::{Check, Depth};
use glam::DVec3;
use kit::point;
use std::iter;
use tmesh::{Frame, Group, Kind};

impl Query<'_> {
    /// The best of the rotations that holds everywhere, with all that holds beside it.
    pub fn certified(
        &self,
        mut candidates: Vec<Rotation>,
        log: &mut dyn FnMut(&str),
    ) -> Option<Found> {
        while let Some(best) = self.take_best(&mut candidates) {
            log(&format!(
                "order {} about {} by a quick test",
                best.order,
                point(best.frame.rotation.z_axis.to_array())
            ));
            let first = self.complete(best.clone());
            let mut before: Option<Found> = None;
            // Among half-turn axes the main one is that with the most operations beside it; of three alike, that across which the
            // body is widest.
            if best.order == 2 {
                for other in candidates.iter().filter(|c| c.order == 2 && c.distinct) {
                    let other = self.complete(other.clone());
                    let best = before.as_ref().unwrap_or(&first);
                    let is_wider = || {
                        other.group == best.group
                            && other.group == BOX
                            && other.radius > WIDER * best.radius
                    };
                    if rank(&other.group) > rank(&best.group) || is_wider() {
                        before = Some(other);
                    }
                }
            }
            // Where another one comes before the first, and does not hold everywhere, the first one may.
            for mut found in before.into_iter().chain([first.clone()]) {
                log(&format!("group {} by a quick test", found.group.symbol()));
                if self.certify(&mut found) {
                    log(&format!("group {} verified in full", found.group.symbol()));
                    return Some(found);
                }
            }
            let z = first.frame.rotation.z_axis;
            candidates.retain(|c| !self.same_axis(c.frame.rotation.z_axis, z));
            let mut search = self.search_about(z);
            search.depth = Depth::Full;
            let lower = search.find(first.frame.origin, z, false);
            candidates.extend(lower.filter(|r| r.order < first.group.order));
            log("some operation does not hold everywhere");
        }
        None
    }

    /// Verifies the whole group in full; mirrors and what turns the axis over are dropped where they do not hold.
    /// Returns whether the rotation holds.
    fn certify(&self, found: &mut Found) -> bool {
        let bound = self.limits.bound(found.radius);
        for kind in parts(found.group.kind) {
            let group = Group::new(*kind, found.group.order);
            let explained = || self.limits.facets.then(|| self.explained(found, group));
            let frames = [found.frame, found.rough].into_iter();
            for frame in frames.chain(iter::once_with(explained).flatten()) {
                let check = Check {
                    shape: self.shape,
                    frame: &frame,
                    bound,
                    depth: Depth::Full,
                };
                if let Ok(verified) = check.group(&group) {
                    (found.frame, found.group, found.verified) = (frame, group, verified);
                    if found.axisymmetric && !found.distinct {
                        found.group = Group::new(of_revolution(*kind), found.group.order);
                    }
                    return true;
                }
            }
        }
        false
    }

    /// The frame moved to where facets explain a group, if it is not far from there.
    fn explained(&self, found: &Found, group: Group) -> Frame {
        let mut operations = match found.axisymmetric && !found.distinct {
            true => golden(),
            false => powers(group.order, &Target::Any),
        };
        let generators = group.generators().into_iter();
        operations.extend(generators.map(|g| Canonical::new(g, Target::Any)));
        let fit = Fit {
            operations: &operations,
            samples: SURVEY,
            reach: 0.0,
            bound: self.limits.bound(found.radius),
        };
        explain(self.shape, found.frame, &fit)
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
                compare_along_axes(za, zb, [DVec3::Z, DVec3::X, DVec3::Y]) > 0.0
            };
            if better {
                best = i;
            }
        }
        (!candidates.is_empty()).then(|| candidates.swap_remove(best))
    }
}

/// Radius about one of three axes over that about another from which on it is the main one: below, they differ by less than the radii of one
/// axis in several drawings. Mirror planes through the axis are cut in any case, and one across it where that pays: a plate is not to be cut
/// into two that are half as thick for nothing. Of drawings of one plate, some have their smallest deviation about one axis and some about
/// another, which says nothing: the group has the same operations.
const WIDER: f64 = 1.05;

/// The group of a box: half turns about three axes, and mirror planes across all of them.
const BOX: Group = Group::new(Kind::Dh, 2);

/// How much there is beside the rotation: mirrors that contain the axis count most.
fn rank(group: &Group) -> u32 {
    2 * u32::from(group.has_vertical_mirrors()) + u32::from(group.turning_over().is_some())
}

/// The kind of a body of revolution that has the operations of another kind: every plane through its axis is a mirror.
fn of_revolution(kind: Kind) -> Kind {
    match kind {
        Kind::C | Kind::Cv => Kind::Cv,
        Kind::Ch | Kind::S | Kind::D | Kind::Dd | Kind::Dh => Kind::Dh,
    }
}

/// Kinds that may be left of one when some of its operations do not hold, the largest first.
fn parts(kind: Kind) -> &'static [Kind] {
    match kind {
        Kind::C => &[Kind::C],
        Kind::Cv => &[Kind::Cv, Kind::C],
        Kind::Ch => &[Kind::Ch, Kind::C],
        Kind::S => &[Kind::S, Kind::C],
        Kind::D => &[Kind::D, Kind::C],
        Kind::Dd => &[Kind::Dd, Kind::Cv, Kind::S, Kind::C],
        Kind::Dh => &[Kind::Dh, Kind::Cv, Kind::Ch, Kind::C],
    }
}
