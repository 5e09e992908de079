//! Mirrors and what turns the axis over beside a rotation.

use crate::budget::SURVEY;
use crate::group::found::Found;
use crate::group::placement;
use crate::group::slid::find_slid;
use crate::group::turned::Turned;
use crate::rotation::{Canonical, Fit, Query, Rotation, powers, refine};
use crate::shape::{Permutation, Target};
use crate::tolerance::{EXACT, SINGLE};
use crate::verify::{Bound, Check, Depth, Verified};
use tmesh::{Frame, Group, Isometry, Kind};

/// Growth of the deviation that is taken for a rounder frame: less than the last digit of any residual in a message.
const ROUNDER: f64 = 1.02;

impl Query<'_> {
    /// Mirrors and what turns the axis over beside a rotation, all adjusted together.
    pub fn complete(&self, rotation: Rotation) -> Found {
        let radius = rotation.radius;
        let fixed = self.params.axis.is_some() && rotation.deviation.value <= self.noise(radius);
        let rotation = self.directed(rotation);
        let (rotation, group, verified) = self.extended(rotation, fixed);
        let mut found = Found {
            frame: rotation.frame,
            rough: rotation.frame,
            radius,
            group,
            verified,
            axisymmetric: rotation.axisymmetric,
            distinct: rotation.distinct,
        };
        if !fixed {
            self.polish(&mut found);
        }
        self.settle(&mut found);
        found
    }

    /// The group about the axis of a rotation, in the frame that it holds in.
    fn extended(&self, mut rotation: Rotation, fixed: bool) -> (Rotation, Group, Verified) {
        let identity = Permutation::identity(self.shape.region_count());
        let order = rotation.order;
        let mut group = Group::new(Kind::C, order);
        let mut verified = Verified {
            deviation: rotation.deviation,
            rotation: rotation.permutation.clone(),
            mirror: identity.clone(),
            turning: identity,
        };
        let with_turned = |rotation: &Rotation, operation, kind| {
            let turned = Turned {
                query: self,
                rotation,
                operation,
                fixed,
            };
            self.holds_as_whole(rotation, turned.find()?.frame, Group::new(kind, order))
        };
        if let Some(found) = with_turned(&rotation, Isometry::MIRROR, Kind::Cv) {
            (rotation.frame, group, verified) = found;
        }
        let mirrors = group.has_vertical_mirrors();
        let slid = [
            (if mirrors { Kind::Dh } else { Kind::Ch }, Isometry::FLIP),
            (
                if mirrors { Kind::Dd } else { Kind::S },
                Isometry::new(1, 2 * order, false, true),
            ),
        ];
        for (kind, operation) in slid {
            // The frame only slides along the axis, so that all else keeps holding.
            if let Some(found) = find_slid(self, &rotation, operation) {
                rotation.frame = found.frame;
                verified.deviation = verified.deviation.max(found.deviation);
                verified.turning = found.permutation;
                return (rotation, Group::new(kind, order), verified);
            }
        }
        if !mirrors
            && let Some(found) = with_turned(&rotation, Isometry::new(0, 1, true, true), Kind::D)
        {
            (rotation.frame, group, verified) = found;
        }
        (rotation, group, verified)
    }

    /// The group if the whole of it holds, in the frame found for one of its operations or in that of the rotation
    /// turned to it.
    fn holds_as_whole(
        &self,
        rotation: &Rotation,
        found: Frame,
        group: Group,
    ) -> Option<(Frame, Group, Verified)> {
        let old = &rotation.frame;
        let turned = Frame::from_axis(old.origin, old.rotation.z_axis, found.rotation.x_axis);
        [found, turned.unwrap_or(*old)].iter().find_map(|frame| {
            let check = Check {
                shape: self.shape,
                frame,
                bound: self.limits.bound(rotation.radius),
                depth: Depth::Quick,
            };
            Some((*frame, group, check.group(&group).ok()?))
        })
    }

    /// Points the axis along its largest component, or as the user pointed it.
    fn directed(&self, mut rotation: Rotation) -> Rotation {
        let z = rotation.frame.rotation.z_axis;
        let wanted = match self.params.axis {
            Some(axis) => axis.dot(z) > 0.0,
            None => placement::points_forward(z),
        };
        if !wanted {
            let x = rotation.frame.rotation.x_axis;
            rotation.frame =
                Frame::from_axis(rotation.frame.origin, -z, x).unwrap_or(rotation.frame);
            // The step now turns the other way.
            let powers = rotation.permutation.powers(rotation.order);
            rotation.permutation = powers[powers.len() - 1].clone();
        }
        rotation
    }

    /// Adjusts the frame to all operations at once.
    fn polish(&self, found: &mut Found) {
        let shape = self.shape;
        if found.verified.deviation.value <= EXACT {
            return;
        }
        let n = found.group.order;
        let in_place = |p: &Permutation| {
            if p.is_identity() {
                shape.target(p)
            } else {
                Target::Any
            }
        };
        let mut operations = Vec::new();
        if n > 1 && found.distinct {
            operations.extend(powers(n, &in_place(&found.verified.rotation)));
        }
        if found.group.has_vertical_mirrors() {
            let target = in_place(&found.verified.mirror);
            // Two mirrors about across each other.
            let mirrors = [0, n / 4].map(|k| Isometry::reflection(i64::from(k), n));
            operations.extend(mirrors.map(|m| Canonical::new(m, target.clone())));
        }
        if let Some(operation) = found.group.turning_over() {
            let target = in_place(&found.verified.turning);
            operations.push(Canonical::new(operation, target));
        }
        if operations.is_empty() {
            return;
        }
        let deviation = found.verified.deviation.value;
        let reach = self.limits.reach(deviation, found.radius);
        let samples = shape.samples.mixed.len().min(SURVEY);
        let fit = Fit {
            operations: &operations,
            samples,
            reach,
            bound: self.limits.needed(deviation, found.radius),
        };
        let frame = refine(shape, found.frame, &fit);
        self.adopt(found, frame, 1.0);
    }

    /// Takes a frame if the group holds in it with at most `factor` times the deviation.
    fn adopt(&self, found: &mut Found, frame: Frame, factor: f64) {
        let limit = (found.verified.deviation.value * factor).max(self.shape.precision);
        let bound = self.limits.bound(found.radius);
        let check = Check {
            shape: self.shape,
            frame: &frame,
            bound: Bound {
                limit: limit.min(bound.limit),
                ..self
                    .limits
                    .needed(found.verified.deviation.value, found.radius)
            },
            depth: Depth::Quick,
        };
        if let Ok(verified) = check.group(&found.group) {
            found.frame = frame;
            found.verified = verified;
        }
    }

    /// Chooses among the equivalent frames, and takes exact coordinate directions and round
    /// coordinates where the shape agrees with them.
    pub fn settle(&self, found: &mut Found) {
        let given = self.params.axis.is_some() || self.params.center.is_some();
        if !given {
            // An axis is no better known than operations about it hold.
            let angle = (found.verified.deviation.value / found.radius).max(SINGLE);
            let frame = placement::rounded(self.shape, &found.frame, angle);
            self.adopt(found, frame, ROUNDER);
        }
        let x = placement::reference(&found.frame, found.group);
        // What it does to regions is for the full verification to say.
        if let Some(frame) = Frame::from_axis(found.frame.origin, found.frame.rotation.z_axis, x) {
            found.frame = frame;
        }
    }
}
