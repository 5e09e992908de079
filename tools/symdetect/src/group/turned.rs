//! Mirrors that contain the axis, and half turns about axes across it.

use crate::budget::{FIT, NEXT_BEST, QUICK, SCAN};
use crate::group::found::Beside;
use crate::rotation::{Canonical, OUTLIERS, Query, Rotation, powers};
use crate::shape::{Motion, Target};
use crate::threads;
use crate::tolerance::{EXACT, SINGLE};
use crate::verify::{Depth, turn_matrix};
use glam::DVec3;
use std::f64::consts::PI;
use tmesh::{Frame, Isometry};

/// Angles tried at least over one period, however loose the limits.
const FEWEST_ANGLES: usize = 32;

/// An operation to be turned about the axis of a rotation until it holds.
pub struct Turned<'a> {
    /// The body and the limits.
    pub query: &'a Query<'a>,
    /// The rotation beside which it holds.
    pub rotation: &'a Rotation,
    /// The mirror y -> -y or the half turn about x.
    pub operation: Isometry,
    /// Whether axis and centre stay where they are.
    pub fixed: bool,
}

impl Turned<'_> {
    /// The operation at some angle about the axis: in steps over one period, then adjusted. The frame's x direction
    /// lies in the mirror or on the axis of the half turn; that with the smallest deviation if there are several.
    pub fn find(&self) -> Option<Beside> {
        if self.operation.reverses_orientation()
            && let Some(exact) = self.mirror_of_faces()
        {
            return Some(exact);
        }
        if self.query.limits.facets
            && let Some(exact) = (self.in_corners().into_iter()).find_map(|f| self.near(f))
        {
            return Some(exact);
        }
        let (shape, rotation) = (self.query.shape, self.rotation);
        let mut best: Option<Beside> = None;
        for angle in self.candidates() {
            let Some(found) = self.turned_to(angle).and_then(|f| self.near(f)) else {
                continue;
            };
            let deviation = found.deviation.value;
            let best_yet = best.as_ref().map_or(f64::INFINITY, |b| b.deviation.value);
            if deviation < 0.5 * best_yet {
                best = Some(found);
            }
            // No other angle can be better than the rotations themselves.
            if deviation <= shape.rounding().max(rotation.deviation.value) {
                break;
            }
        }
        best
    }

    /// The operation in a frame that has been adjusted to it, if it holds there.
    fn near(&self, frame: Frame) -> Option<Beside> {
        let frame = self.adjusted(frame);
        let motion = Motion::new(&frame, self.operation.matrix());
        let bound = self.query.limits.bound(self.rotation.radius);
        let verified = (self.query.shape).verify_one(motion, bound, Depth::Quick);
        let (deviation, permutation) = verified.ok()?;
        Some(Beside {
            frame,
            deviation,
            permutation,
        })
    }

    /// Frames in which the corner of the shape that is farthest from the axis goes to one: faces that are drawn coarsely are
    /// nearest to their images at some other angle, and have another centre of mass.
    fn in_corners(&self) -> Vec<Frame> {
        let (shape, rotation) = (self.query.shape, self.rotation);
        let near = self.query.limits.loosely(rotation.radius).limit;
        let places = shape.smooth().corners().points().iter().map(|p| {
            let p = rotation.frame.to_canonical(*p);
            (libm::hypot(p.x, p.y), libm::atan2(p.y, p.x), p.z)
        });
        let farthest = (places.clone()).reduce(|a, b| if b.0 > a.0 { b } else { a });
        let Some((radius, angle, height)) = farthest else {
            return Vec::new();
        };
        // What turns the axis over exchanges the lowest and the highest of them.
        let heights = places.clone().map(|p| p.2);
        let range = heights.fold([height; 2], |r, z| [r[0].min(z), r[1].max(z)]);
        let shift = match self.operation.flipped() && !self.fixed {
            true => 0.5 * (range[0] + range[1]),
            false => 0.0,
        };
        let image = self.operation.apply(DVec3::Z * (height - shift)).z + shift;
        let period = PI / f64::from(rotation.order);
        let mut angles: Vec<f64> = places
            .filter(|(r, _, z)| radius - r <= near && (z - image).abs() <= near)
            .map(|(_, a, _)| (0.5 * (a + angle)).rem_euclid(period))
            .collect();
        angles.sort_unstable_by(f64::total_cmp);
        angles.dedup_by(|a, b| *a - *b < near / rotation.radius);
        angles.truncate(NEXT_BEST);
        let shift = rotation.frame.rotation.z_axis * shift;
        let shifted = |frame: Frame| Frame {
            origin: frame.origin + shift,
            ..frame
        };
        let frames = angles.into_iter().filter_map(|a| self.turned_to(a));
        frames.map(shifted).collect()
    }

    /// The rotation's frame turned about its axis.
    fn turned_to(&self, angle: f64) -> Option<Frame> {
        let frame = &self.rotation.frame;
        let (s, c) = libm::sincos(angle);
        let x = frame.rotation * DVec3::new(c, s, 0.0);
        Frame::from_axis(frame.origin, frame.rotation.z_axis, x)
    }

    /// Angles at which few samples are off, the best first.
    fn candidates(&self) -> Vec<f64> {
        let loose = self.query.limits.loose;
        let period = PI / f64::from(self.rotation.order);
        // An angle off by half a step moves an image by one step times the radius.
        let steps = ((2.0 * period / loose).ceil() as usize).max(FEWEST_ANGLES);
        let angles: Vec<f64> = (0..steps)
            .map(|i| period * i as f64 / steps as f64)
            .collect();
        let limits = &self.query.limits;
        let (shape, rotation) = (self.query.shape, self.rotation);
        let telling = shape.telling_samples(&rotation.frame, limits.loosely(rotation.radius));
        let sum = |&angle: &f64| self.score(angle, &telling).map_or(f64::INFINITY, |s| s.1);
        let scores = threads::map(&angles, sum);
        let mut candidates: Vec<usize> = (0..steps)
            .filter(|&i| {
                let s = scores[i];
                let least = s <= scores[(i + 1) % steps] && s <= scores[(i + steps - 1) % steps];
                s.is_finite() && least
            })
            .collect();
        candidates.sort_by(|&i, &j| scores[i].total_cmp(&scores[j]).then(i.cmp(&j)));
        if candidates.len() > NEXT_BEST {
            // Where something is there at equal steps all around, and something else is not, few samples are of that, and
            // all of those are off.
            candidates.truncate(SCAN);
            let more: Vec<usize> = (0..QUICK.min(shape.samples.mixed.len())).collect();
            let again = threads::map(&candidates, |&i| self.score(angles[i], &more));
            let mut ranked: Vec<((usize, f64), usize)> = (again.into_iter().zip(candidates))
                .filter_map(|(score, i)| Some((score?, i)))
                .collect();
            ranked.sort_by(|(a, i), (b, j)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(i.cmp(j)));
            candidates = ranked.into_iter().map(|c| c.1).collect();
            candidates.truncate(NEXT_BEST);
        }
        candidates.into_iter().map(|i| angles[i]).collect()
    }

    /// How many of some samples are off, and the sum of the deviations of all; `None` where too many are off.
    fn score(&self, angle: f64, places: &[usize]) -> Option<(usize, f64)> {
        let shape = self.query.shape;
        let loose = self.query.limits.loosely(self.rotation.radius);
        let samples = places.iter().map(|&i| &shape.samples.mixed[i]);
        let allowed = (OUTLIERS * places.len() as f64) as usize;
        let turned = turn_matrix(angle / PI) * self.operation.matrix();
        let motion = Motion::new(&self.rotation.frame, turned);
        let (mut sum, mut missed) = (0.0, 0);
        for s in samples {
            match shape.near(motion.apply(s.point), s.triangle, &Target::Any, loose) {
                Some(n) => sum += n.distance,
                None => {
                    sum += shape.most(loose);
                    missed += 1;
                    if missed > allowed {
                        return None;
                    }
                }
            }
        }
        Some((missed, sum))
    }

    /// The frame adjusted to the operation: together with the rotation, or, where axis and centre are fixed, the angle
    /// alone.
    fn adjusted(&self, frame: Frame) -> Frame {
        let (query, rotation) = (self.query, self.rotation);
        let mut operations = vec![Canonical::new(self.operation, Target::Any)];
        if self.fixed {
            let adjusted = query.adjusted(frame, rotation.radius, &operations, FIT / 2);
            let (z, x) = (frame.rotation.z_axis, adjusted.rotation.x_axis);
            return Frame::from_axis(frame.origin, z, x).unwrap_or(frame);
        }
        if rotation.distinct {
            operations.extend(powers(rotation.order, &Target::Any));
        }
        // Where the rotations are exact, few samples tell the angle.
        let exact = rotation.deviation.value <= EXACT;
        let equations = if exact { FIT / 8 } else { FIT / 2 };
        query.adjusted(frame, rotation.radius, &operations, equations)
    }

    /// The mirror that contains the axis of a rotation which takes faces to faces, if it does so too: it takes the
    /// corner that is farthest from the axis to one that is as far, on the same height.
    fn mirror_of_faces(&self) -> Option<Beside> {
        let (shape, rotation) = (self.query.shape, self.rotation);
        let frame = &rotation.frame;
        let faces = rotation.deviation.everywhere.then(|| shape.faces())??;
        let place = |p: DVec3| {
            let p = frame.to_canonical(p);
            (libm::hypot(p.x, p.y), p.z)
        };
        let corners = faces.farthest(place, 2.0 * shape.same_corner());
        // Angles from the first of them, as parts of a step of the rotation: others are equivalent.
        let angles: Vec<f64> = (corners.iter())
            .map(|p| frame.to_canonical(*p))
            .map(|p| libm::atan2(p.y, p.x))
            .collect();
        let step = 2.0 * PI / f64::from(rotation.order);
        let mut parts: Vec<f64> = (angles.iter())
            .map(|a| ((a - angles[0]) / step).rem_euclid(1.0))
            .collect();
        parts.sort_unstable_by(f64::total_cmp);
        parts.dedup_by(|a, b| *a - *b < SINGLE);
        parts.truncate(NEXT_BEST);
        let bound = self.query.limits.bound(rotation.radius);
        parts.into_iter().find_map(|part| {
            let frame = self.turned_to(angles[0] + 0.5 * part * step)?;
            let motion = Motion::new(&frame, self.operation.matrix());
            let (deviation, permutation) = shape.verify_one(motion, bound, Depth::Quick).ok()?;
            deviation.everywhere.then_some(Beside {
                frame,
                deviation,
                permutation,
            })
        })
    }
}
