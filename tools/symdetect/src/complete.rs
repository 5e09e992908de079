//! Mirrors and flips beside a rotation, the frame adjusted to all of them, and the whole verified.

use crate::detect::Job;
use crate::group::{Flip, Group, Verified};
use crate::mirror::{
    EXACT, Found as MirrorFound, HALF_TURN, VERTICAL, find_flip, find_mirror_plane, find_turned,
};
use crate::order::{COARSE, Limits, Rotation, is_of_facets, powers};
use crate::permutation::Permutation;
use crate::placement;
use crate::refine::{Canonical, refine};
use crate::shape::{Motion, Target};
use crate::verify::{Bound, Depth, Deviation, Operation};
use glam::DVec3;
use tmesh::{Frame, Isometry};

/// A frame, the group in it, and how well it holds.
pub(crate) struct Found {
    pub frame: Frame,
    /// The frame before it was adjusted to all operations and rounded.
    pub rough: Frame,
    pub radius: f64,
    pub group: Group,
    pub verified: Verified,
    pub axisymmetric: bool,
    pub distinct: bool,
}

impl Job<'_> {
    /// Mirrors and flips beside a rotation, all adjusted together.
    pub(crate) fn complete(&self, rotation: Rotation) -> Found {
        let (shape, limits) = (self.shape, self.limits);
        let radius = rotation.radius;
        let bound = limits.bound(radius);
        let fixed = self.params.axis.is_some() && rotation.deviation.value <= self.noise(radius);
        let mut rotation = self.directed(rotation);
        let mut group = Group {
            order: rotation.order,
            mirror: false,
            flip: Flip::None,
        };
        let mut state = Verified {
            deviation: rotation.deviation,
            rotation: rotation.permutation.clone(),
            mirror: Permutation::identity(shape.regions.len()),
            flip: Permutation::identity(shape.regions.len()),
        };
        // Extends the group if the whole of it holds in one of the frames.
        let extend = |group: &mut Group,
                      rotation: &mut Rotation,
                      state: &mut Verified,
                      wider: Group,
                      found: Frame| {
            for frame in [found, turned_to(&rotation.frame, &found)] {
                if let Ok(v) = wider.verify(shape, &frame, bound, Depth::Quick) {
                    (*group, rotation.frame, *state) = (wider, frame, v);
                    return;
                }
            }
        };
        if let Some(found) = find_turned(shape, &rotation, VERTICAL, fixed, limits) {
            let wider = Group {
                mirror: true,
                ..group
            };
            extend(&mut group, &mut rotation, &mut state, wider, found.frame);
        }
        for (flip, turn) in [
            (Flip::Horizontal, Isometry::IDENTITY),
            (Flip::Rotary, Isometry::rotation(1, 2 * group.order)),
        ] {
            // The frame only slides along the axis, so that all else keeps holding.
            if let Some(found) = find_flip(shape, &rotation, turn, limits) {
                group.flip = flip;
                rotation.frame = found.frame;
                state.deviation = state.deviation.max(found.deviation);
                state.flip = found.permutation;
                break;
            }
        }
        if !group.mirror
            && group.flip == Flip::None
            && let Some(found) = find_turned(shape, &rotation, HALF_TURN, fixed, limits)
        {
            let wider = Group {
                flip: Flip::HalfTurn,
                ..group
            };
            extend(&mut group, &mut rotation, &mut state, wider, found.frame);
        }
        let mut found = Found {
            frame: rotation.frame,
            rough: rotation.frame,
            radius,
            group,
            verified: state,
            axisymmetric: rotation.axisymmetric,
            distinct: rotation.distinct,
        };
        if !fixed {
            self.polish(&mut found);
        }
        self.settle(&mut found);
        found
    }

    /// Verifies the whole group in full, and where a place that the quick test passed over is beyond
    /// the tolerance, with allowance for facets; mirrors and flips that do not hold are dropped.
    /// Returns whether the rotation holds.
    pub(crate) fn certify(&self, found: &mut Found) -> bool {
        let bound = self.limits.bound(found.radius);
        let mut bounds = vec![bound];
        if !self.limits.facets && self.shape.facets().largest() >= COARSE * bound.limit {
            let limits = Limits {
                facets: true,
                ..self.limits
            };
            bounds.push(limits.bound(found.radius));
        }
        let whole = found.group;
        let parts = [
            whole,
            Group {
                flip: Flip::None,
                ..whole
            },
            Group {
                mirror: false,
                ..whole
            },
            Group {
                mirror: false,
                flip: Flip::None,
                ..whole
            },
        ];
        // What holds without the allowance is not widened by it.
        for bound in bounds {
            for (i, group) in parts.iter().enumerate() {
                if parts[..i].contains(group) {
                    continue;
                }
                for frame in [found.frame, found.rough] {
                    if let Ok(verified) = group.verify(self.shape, &frame, bound, Depth::Full)
                        && self.is_of_facets(group, &frame, &verified, bound.limit)
                    {
                        (found.frame, found.group, found.verified) = (frame, *group, verified);
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Whether what a group deviates by beyond the limit, if anything, looks like differences between
    /// facets.
    fn is_of_facets(&self, group: &Group, frame: &Frame, found: &Verified, limit: f64) -> bool {
        let value = found.deviation.value;
        let shape = self.shape;
        if value <= limit {
            return true;
        }
        let mirror = group.mirror.then_some((VERTICAL, &found.mirror));
        let flip = group.flip_matrix().map(|m| (m, &found.flip));
        (group.order < 2 || is_of_facets(shape, frame, group.order, value, limit))
            && mirror.into_iter().chain(flip).all(|(matrix, regions)| {
                let operation = Operation {
                    motion: Motion::new(frame, matrix),
                    target: shape.target(regions),
                };
                !shape.displaces(frame, &operation, limit)
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
        if found.group.mirror {
            let target = in_place(&found.verified.mirror);
            let step = Isometry::rotation(i64::from(n / 4), n).matrix();
            operations.extend([VERTICAL, step * VERTICAL].map(|matrix| Canonical {
                matrix,
                target: target.clone(),
            }));
        }
        if let Some(matrix) = found.group.flip_matrix() {
            operations.push(Canonical {
                matrix,
                target: in_place(&found.verified.flip),
            });
        }
        if operations.is_empty() {
            return;
        }
        let limit = self.limits.tolerance * found.radius;
        let reach = (4.0 * found.verified.deviation.value).clamp(1e-5 * found.radius, 4.0 * limit);
        let samples = (8 * shape.triangles.len()).clamp(2_000, 30_000);
        let frame = refine(shape, found.frame, &operations, samples, reach);
        self.adopt(found, frame, 1.0);
    }

    /// Takes a frame if the group holds in it with at most `factor` times the deviation.
    fn adopt(&self, found: &mut Found, frame: Frame, factor: f64) {
        let limit = (found.verified.deviation.value * factor).max(self.shape.precision);
        let bound = self.limits.bound(found.radius);
        let bound = if limit < bound.limit {
            Bound::plain(limit)
        } else {
            bound
        };
        if let Ok(verified) = found.group.verify(self.shape, &frame, bound, Depth::Quick) {
            found.frame = frame;
            found.verified = verified;
        }
    }

    /// Chooses among the equivalent frames, and takes exact coordinate directions and round
    /// coordinates where the shape agrees with them.
    fn settle(&self, found: &mut Found) {
        let given = self.params.axis.is_some() || self.params.center.is_some();
        if !given {
            let frame = placement::rounded(self.shape, &found.frame);
            self.adopt(found, frame, 1.02);
        }
        let x = placement::reference(&found.frame, &found.group);
        // What it does to regions is for the full verification to say.
        if let Some(frame) = Frame::from_axis(found.frame.origin, found.frame.rotation.z_axis, x) {
            found.frame = frame;
        }
    }

    /// The best single mirror plane with a normal among `directions`.
    pub(crate) fn mirror_only(&self, directions: &[DVec3]) -> Option<Found> {
        let (shape, limits) = (self.shape, self.limits);
        let axis = self.params.axis;
        let normals: Vec<DVec3> = match axis {
            None => directions.to_vec(),
            Some(axis) => {
                // Planes that contain the axis given.
                let start = Frame::from_axis(self.centre, axis, axis.any_orthogonal_vector())?;
                let rotation = Rotation {
                    frame: start,
                    radius: shape.radius(&start),
                    order: 1,
                    permutation: Permutation::identity(shape.regions.len()),
                    deviation: Deviation::NONE,
                    axisymmetric: false,
                    distinct: true,
                };
                let found = find_turned(shape, &rotation, VERTICAL, true, limits)?;
                vec![found.frame.rotation.y_axis]
            }
        };
        let mut best: Option<(MirrorFound, f64)> = None;
        for normal in normals {
            let Some((found, radius)) =
                find_mirror_plane(shape, self.centre, normal, axis, limits, Depth::Full)
            else {
                continue;
            };
            // The origin was adjusted along the normal only: it must still be where it was.
            if !self.passes_centre(&found.frame, DVec3::ZERO, radius) {
                continue;
            }
            let value = |f: &MirrorFound, r: f64| f.deviation.value.max(self.noise(r));
            if best
                .as_ref()
                .is_none_or(|(b, r)| value(&found, radius) < 0.5 * value(b, *r))
            {
                best = Some((found, radius));
            }
        }
        let (mirror, radius) = best?;
        let identity = Permutation::identity(shape.regions.len());
        let mut found = Found {
            frame: mirror.frame,
            rough: mirror.frame,
            radius,
            group: Group {
                order: 1,
                mirror: true,
                flip: Flip::None,
            },
            verified: Verified {
                deviation: mirror.deviation,
                rotation: identity.clone(),
                mirror: mirror.permutation,
                flip: identity,
            },
            axisymmetric: false,
            distinct: true,
        };
        self.settle(&mut found);
        let bound = limits.bound(radius);
        match found.group.verify(shape, &found.frame, bound, Depth::Full) {
            Ok(verified) => found.verified = verified,
            Err(_) => found.frame = mirror.frame,
        }
        Some(found)
    }
}

/// The first frame with its x direction turned to that of the second.
fn turned_to(frame: &Frame, other: &Frame) -> Frame {
    Frame::from_axis(frame.origin, frame.rotation.z_axis, other.rotation.x_axis).unwrap_or(*frame)
}
