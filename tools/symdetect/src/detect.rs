//! From a surface to its symmetry.

use crate::candidates::{self, distinct};
use crate::error::{At, Closest, Error, short};
use crate::group::{Flip, Group, Verified};
use crate::mirror::{
    Found as MirrorFound, HALF_TURN, HORIZONTAL, VERTICAL, find_flip, find_mirror_plane,
    find_turned,
};
use crate::order::{FACETS, Limits, Rotation, deviation_measured, find_rotation, powers};
use crate::permutation::Permutation;
use crate::refine::{Canonical, refine};
use crate::shape::{Motion, Shape, Target};
use crate::verify::{Bound, Depth, Deviation, Operation};
use crate::{Params, placement};
use glam::{DMat3, DVec3};
use std::ops::RangeInclusive;
use tmesh::{Axis, Document, Frame, Isometry, OtherAxis, RejectedOrder, Symmetry};

/// Other axes listed at most.
const MOST_OTHER_AXES: usize = 64;
/// Rejected orders listed at most.
const MOST_REJECTED: usize = 16;
/// Deviation, relative to the radius, beyond which a rejected order is not measured exactly.
const FAR_OFF: f64 = 0.05;
/// How far from the direction given, in radians, an adjusted axis may be.
const OVERRIDE_ANGLE: f64 = 0.02;

/// What was found, and remarks for the user.
pub struct Detection {
    /// The symmetry, in world coordinates.
    pub symmetry: Symmetry,
    /// Remarks, a sentence each.
    pub notes: Vec<String>,
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

struct Job<'a> {
    shape: &'a Shape,
    params: &'a Params,
    limits: Limits,
    centre: DVec3,
}

/// A frame, the group in it, and how well it holds.
struct Found {
    frame: Frame,
    /// The frame before it was adjusted to all operations and rounded.
    rough: Frame,
    radius: f64,
    group: Group,
    verified: Verified,
    axisymmetric: bool,
    distinct: bool,
}

impl Job<'_> {
    fn orders(&self) -> RangeInclusive<u32> {
        match self.params.order {
            Some(n) => n..=n,
            None => 2..=self.params.max_order,
        }
    }

    fn run(mut self, log: &mut dyn FnMut(&str)) -> Result<Detection, Error> {
        let (directions, mut rotations) = if self.params.order == Some(1) {
            (self.directions(log), Vec::new())
        } else {
            self.rotations(log)
        };
        if self.params.order != Some(1) && self.facets_may_hide(&directions, &rotations) {
            self.limits.facets = true;
            let best = |all: &[Rotation]| all.iter().map(Rotation::rank).max();
            let (_, wider) = self.rotations(log);
            if best(&wider) > best(&rotations) {
                log("facets of smooth surfaces allowed for");
                rotations = wider;
            } else {
                self.limits.facets = false;
            }
        }
        let mut candidates = rotations.clone();
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

    /// Whether a higher order would hold with a few times the tolerance, and differences between facets may
    /// be the reason why it does not hold with the tolerance itself.
    fn facets_may_hide(&self, directions: &[DVec3], rotations: &[Rotation]) -> bool {
        let best = rotations.iter().max_by_key(|r| r.rank());
        // Where the facets share the symmetry they cannot hide more of it.
        let shared = |b: &Rotation| {
            let small = 0.1 * self.limits.tolerance * b.radius;
            b.deviation.value <= small.max(10.0 * self.noise(b.radius))
        };
        if best.is_some_and(|b| b.axisymmetric || shared(b)) {
            return false;
        }
        let radius = best.map_or(1.0, |b| b.radius);
        if self.shape.largest_chord() < 0.1 * self.limits.tolerance * radius {
            return false;
        }
        let limits = Limits::new((1.0 + FACETS) * self.limits.tolerance);
        directions.iter().take(12).any(|&d| {
            let (shape, orders) = (self.shape, self.orders());
            find_rotation(shape, self.centre, d, false, orders, limits, Depth::Quick)
                .is_some_and(|r| best.is_none_or(|b| r.rank() > b.rank()))
        })
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
            if !principal.isotropic && found.iter().any(|r| r.distinct && r.order > 2) {
                break;
            }
        }
        log(&format!(
            "principal directions tried, {} have a rotation",
            found.len()
        ));
        let distinct_orders = found.iter().filter(|r| r.distinct).map(|r| r.order);
        let highest = distinct_orders.max().unwrap_or(1);
        if principal.isotropic || (principal.degenerate && highest < 3) {
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
    fn passes_centre(&self, frame: &Frame, free: DVec3, radius: f64) -> bool {
        let off = frame.origin - self.centre;
        let off = (off - free * off.dot(free)).length();
        self.params.center.is_none() || off <= 4.0 * self.limits.tolerance * radius
    }

    /// Deviation that the input's precision explains, in the units of the shape.
    fn noise(&self, radius: f64) -> f64 {
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

    /// Mirrors and flips beside a rotation, all adjusted together.
    fn complete(&self, rotation: Rotation) -> Found {
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

    /// Verifies the whole group in full; mirrors and flips that do not hold are dropped. Returns
    /// whether the rotation holds.
    fn certify(&self, found: &mut Found) -> bool {
        let bound = self.limits.bound(found.radius);
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
        for (i, group) in parts.iter().enumerate() {
            if parts[..i].contains(group) {
                continue;
            }
            for frame in [found.frame, found.rough] {
                if let Ok(verified) = group.verify(self.shape, &frame, bound, Depth::Full) {
                    (found.frame, found.group, found.verified) = (frame, *group, verified);
                    return true;
                }
            }
        }
        false
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
    fn mirror_only(&self, directions: &[DVec3]) -> Option<Found> {
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

    /// The operation that comes nearest to being a symmetry.
    fn closest(&self, directions: &[DVec3]) -> Option<Closest> {
        let shape = self.shape;
        let mut best: Option<(f64, Frame, u32)> = None;
        let samples = &shape.samples.mixed;
        let target = shape.target_in_place();
        let mirror = |frame: &Frame, count: usize| {
            let operation = Operation {
                motion: Motion::new(frame, HORIZONTAL),
                target: target.clone(),
            };
            let open = Bound::plain(f64::MAX);
            shape
                .worst(count.min(samples.len()), open, |i| {
                    (&samples[i], &operation)
                })
                .unwrap_or_else(|beyond| beyond)
        };
        for &d in directions.iter().take(16) {
            let Some(frame) = Frame::from_axis(self.centre, d, d.any_orthogonal_vector()) else {
                continue;
            };
            let radius = shape.radius(&frame).max(1e-12);
            for n in 1..=self.params.max_order.min(16) {
                let deviation = match n {
                    1 => mirror(&frame, 300),
                    n => deviation_measured(shape, &frame, n, 300, 0.2 * radius),
                };
                let residual = deviation.value / radius;
                if best.as_ref().is_none_or(|b| residual < b.0) {
                    best = Some((residual, frame, n));
                }
            }
        }
        let (_, frame, order) = best?;
        let matrices = match order {
            1 => vec![Canonical {
                matrix: HORIZONTAL,
                target: target.clone(),
            }],
            n => powers(n, &target),
        };
        let radius = shape.radius(&frame).max(1e-12);
        let measure = |frame: &Frame| match order {
            1 => mirror(frame, 3_000),
            n => deviation_measured(shape, frame, n, 3_000, f64::MAX),
        };
        let adjusted = refine(shape, frame, &matrices, 4_000, self.limits.loose * radius);
        let (as_is, better) = (measure(&frame), measure(&adjusted));
        let (frame, deviation) = if better.value < as_is.value {
            (adjusted, better)
        } else {
            (frame, as_is)
        };
        Some(Closest {
            order,
            residual: deviation.value / radius,
            direction: At(frame.rotation.z_axis),
            place: At(shape.to_world(deviation.at)),
        })
    }

    /// Why an order asked for does not hold.
    fn order_fails(&self, order: u32, directions: &[DVec3]) -> Error {
        let shape = self.shape;
        let measured = directions.iter().take(24).filter_map(|&d| {
            let frame = Frame::from_axis(self.centre, d, d.any_orthogonal_vector())?;
            let radius = shape.radius(&frame).max(1e-12);
            let deviation = deviation_measured(shape, &frame, order, 3_000, f64::MAX);
            Some((deviation.value / radius, deviation.at, frame))
        });
        let best = measured.min_by(|a, b| a.0.total_cmp(&b.0));
        let (residual, at, frame) = best.unwrap_or((1.0, DVec3::ZERO, Frame::IDENTITY));
        Error::OrderFails {
            order,
            tolerance: self.params.tolerance,
            residual,
            axis: At(frame.rotation.z_axis),
            centre: At(shape.to_world(frame.origin)),
            place: At(shape.to_world(at)),
        }
    }

    fn asymmetric(&self, closest: Option<Closest>, reason: String) -> Detection {
        let direction = self.params.axis.unwrap_or(DVec3::Z);
        let frame = Frame::from_axis(self.centre, direction, direction.any_orthogonal_vector())
            .unwrap_or(Frame::IDENTITY);
        let radius = self.shape.radius(&frame);
        let group = Group {
            order: 1,
            mirror: false,
            flip: Flip::None,
        };
        let x = placement::reference(&frame, &group);
        let rejected = closest
            .filter(|c| c.order > 1)
            .map(|c| RejectedOrder {
                order: c.order,
                residual: c.residual,
            })
            .into_iter()
            .collect();
        Detection {
            symmetry: Symmetry {
                group: group.symbol(),
                order: 1,
                mirror: false,
                horizontal_mirror: false,
                axis: Axis {
                    point: self.shape.to_world(self.centre).to_array(),
                    direction: frame.rotation.z_axis.to_array(),
                },
                mirror_direction: x.to_array(),
                residual: 0.0,
                tolerance: self.params.tolerance,
                axisymmetric: false,
                radius: radius * self.shape.scale,
                other_axes: Vec::new(),
                rejected,
                rotation_regions: Vec::new(),
                mirror_regions: Vec::new(),
                horizontal_regions: Vec::new(),
                promise: None,
            },
            notes: Vec::new(),
            asymmetric: Some(reason),
        }
    }

    fn report(&self, found: Found, rotations: &[Rotation], log: &mut dyn FnMut(&str)) -> Detection {
        let shape = self.shape;
        let (frame, group) = (&found.frame, found.group);
        let residual = found.verified.deviation.value / found.radius;
        let other_axes = self.other_axes(&found, rotations);
        let rejected = if group.order > 1 {
            self.rejected(&found)
        } else {
            Vec::new()
        };
        log(&format!("{} orders rejected are listed", rejected.len()));
        let mut notes = Vec::new();
        if residual > self.params.tolerance {
            notes.push(format!(
                "beyond the tolerance of {:e} only as far as the facets of smooth surfaces explain",
                self.params.tolerance
            ));
        }
        if found.axisymmetric && !found.distinct {
            notes.push(format!(
                "a body of revolution whose facets have no common order; order {} stands for any",
                group.order
            ));
        } else if found.axisymmetric {
            notes.push(format!(
                "a body of revolution with {} facets around the axis",
                group.order
            ));
        }
        if let Some(name) = self.polyhedral(&found, &other_axes) {
            notes.push(format!(
                "the whole point group is {name}, with {} axes; {} is the part about the main axis",
                other_axes.len() + 1,
                group.symbol()
            ));
        }
        let regions = &shape.regions;
        let centre = shape.to_world(frame.origin);
        let symmetry = Symmetry {
            group: group.symbol(),
            order: group.order,
            mirror: group.mirror,
            horizontal_mirror: group.flip == Flip::Horizontal,
            axis: Axis {
                point: centre.to_array(),
                direction: frame.rotation.z_axis.to_array(),
            },
            mirror_direction: frame.rotation.x_axis.to_array(),
            residual,
            tolerance: self.params.tolerance,
            axisymmetric: found.axisymmetric,
            radius: found.radius * shape.scale,
            other_axes,
            rejected,
            rotation_regions: found.verified.rotation.pairs(regions),
            mirror_regions: found.verified.mirror.pairs(regions),
            horizontal_regions: if group.flip == Flip::Horizontal {
                found.verified.flip.pairs(regions)
            } else {
                Vec::new()
            },
            promise: None,
        };
        if !symmetry.rotation_regions.is_empty() {
            notes.push(format!(
                "the rotation maps {} regions onto other ones",
                symmetry.rotation_regions.len()
            ));
        }
        notes.insert(
            0,
            format!(
                "{} about {} through {}, residual {:.1e} of the radius {}",
                symmetry.group,
                At(frame.rotation.z_axis),
                At(centre),
                residual,
                short(symmetry.radius)
            ),
        );
        Detection {
            symmetry,
            notes,
            asymmetric: None,
        }
    }

    /// Further axes: half turns across the main one, and those of a polyhedral group.
    fn other_axes(&self, found: &Found, rotations: &[Rotation]) -> Vec<OtherAxis> {
        let z = found.frame.rotation.z_axis;
        let mut axes: Vec<OtherAxis> = Vec::new();
        let add = |axes: &mut Vec<OtherAxis>, d: DVec3, order: u32, residual: f64| {
            let new = axes
                .iter()
                .all(|a| DVec3::from_array(a.direction).cross(d).length() > 2e-3);
            if new && d.cross(z).length() > 2e-3 && axes.len() < MOST_OTHER_AXES {
                let d = placement::forward(d);
                axes.push(OtherAxis {
                    direction: d.to_array(),
                    order,
                    residual,
                });
            }
        };
        let mut others: Vec<&Rotation> = rotations.iter().filter(|r| r.distinct).collect();
        others.sort_by_key(|r| std::cmp::Reverse(r.order));
        for r in others {
            let residual = r.deviation.value / found.radius;
            add(&mut axes, r.frame.rotation.z_axis, r.order, residual);
        }
        let half_turns = match (found.group.flip, found.group.mirror) {
            (Flip::Horizontal, true) | (Flip::HalfTurn, _) => Some(0),
            (Flip::Rotary, true) => Some(1),
            _ => None,
        };
        if let Some(phase) = half_turns {
            let n = found.group.order;
            let residual = found.verified.deviation.value / found.radius;
            for k in 0..n {
                // Half turns lie along the mirrors, or between them.
                let turn = Isometry::rotation(i64::from(2 * k + phase), 4 * n);
                let d = found.frame.rotation * turn.apply(DVec3::X);
                add(&mut axes, d, 2, residual);
            }
        }
        axes
    }

    /// Name of the polyhedral group, if axes of order three or more point in several directions.
    fn polyhedral(&self, found: &Found, axes: &[OtherAxis]) -> Option<String> {
        let high: Vec<u32> = axes.iter().map(|a| a.order).filter(|&n| n >= 3).collect();
        if high.is_empty() || found.group.order < 3 || found.axisymmetric {
            return None;
        }
        let highest = high.iter().copied().max()?.max(found.group.order);
        let letter = match highest {
            3 => "T",
            4 => "O",
            5 => "I",
            _ => return None,
        };
        let bound = self.limits.bound(found.radius);
        let inversion = Motion::new(&found.frame, -DMat3::IDENTITY);
        let suffix = if self
            .shape
            .verify_one(inversion, bound, Depth::Quick)
            .is_ok()
        {
            "h"
        } else if found.group.mirror && letter == "T" {
            "d"
        } else {
            ""
        };
        Some(format!("{letter}{suffix}"))
    }

    /// Orders about the main axis that do not hold: small multiples of the one found, and the ones
    /// that come nearest to holding.
    fn rejected(&self, found: &Found) -> Vec<RejectedOrder> {
        let n = found.group.order;
        let most = self.params.max_order.max(n).min((4 * n).max(48)).min(768);
        let most_off = FAR_OFF * found.radius;
        let multiple = |m: u32| m == 2 * n || m == 3 * n;
        let measured: Vec<RejectedOrder> = (2..=most)
            .filter(|m| !n.is_multiple_of(*m))
            // Of a body of revolution all others are alike.
            .filter(|m| !found.axisymmetric || multiple(*m))
            .map(|m| RejectedOrder {
                order: m,
                residual: deviation_measured(self.shape, &found.frame, m, 200, most_off).value
                    / found.radius,
            })
            .filter(|r| r.residual > self.params.tolerance)
            .collect();
        let mut nearest = measured.clone();
        nearest.sort_by(|a, b| {
            a.residual
                .total_cmp(&b.residual)
                .then(a.order.cmp(&b.order))
        });
        let mut kept: Vec<RejectedOrder> = (measured.iter())
            .filter(|r| multiple(r.order))
            .cloned()
            .collect();
        for r in nearest {
            if kept.len() < MOST_REJECTED && kept.iter().all(|k| k.order != r.order) {
                kept.push(r);
            }
        }
        kept.sort_by_key(|r| r.order);
        kept
    }
}

/// The first frame with its x direction turned to that of the second.
fn turned_to(frame: &Frame, other: &Frame) -> Frame {
    Frame::from_axis(frame.origin, frame.rotation.z_axis, other.rotation.x_axis).unwrap_or(*frame)
}
