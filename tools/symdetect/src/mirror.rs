//! Operations beside the rotations: mirrors that contain the axis, half turns across it, the mirror
//! across it, and rotary reflections.

use crate::order::{Limits, Rotation, powers};
use crate::permutation::Permutation;
use crate::refine::{Canonical, refine};
use crate::shape::{Motion, Shape, Target};
use crate::verify::{Depth, Deviation, turn_matrix};
use glam::{DMat3, DVec3};
use kit::in_parallel;
use std::f64::consts::PI;
use tmesh::{Frame, Isometry};

/// `y -> -y`: the mirror that contains the frame's axis and its x direction.
pub const VERTICAL: DMat3 = DMat3::from_cols(DVec3::X, DVec3::NEG_Y, DVec3::Z);
/// `z -> -z`: the mirror across the axis.
pub const HORIZONTAL: DMat3 = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::NEG_Z);
/// Half turn about the frame's x direction.
pub const HALF_TURN: DMat3 = DMat3::from_cols(DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z);

/// Samples that score a candidate angle.
const SCORED: usize = 64;
/// Share of them that may be off.
const OUTLIERS: f64 = 0.15;
/// Deviation up to which coordinates in double precision are exactly symmetric, in the units of the shape.
pub const EXACT: f64 = 1e-11;
/// Candidate angles looked at closely.
const CLOSE: usize = 6;

/// Difference up to which parts of a step of the rotation are the same.
const CLOSE_PARTS: f64 = 1e-6;

/// An operation found beside the rotations.
pub struct Found {
    /// Frame in which the operation has its standard matrix.
    pub frame: Frame,
    /// Largest deviation, in the units of the shape.
    pub deviation: Deviation,
    /// What it does to regions.
    pub permutation: Permutation,
}

/// Finds the operation `kind` (a reflection [`VERTICAL`] or a [`HALF_TURN`]) turned by some angle about
/// the axis: in steps over one period, then adjusted. Returns the frame whose x direction lies in the
/// mirror or on the axis of the half turn; that with the smallest deviation if there are several.
pub fn find_turned(
    shape: &Shape,
    rotation: &Rotation,
    kind: DMat3,
    fixed: bool,
    limits: Limits,
) -> Option<Found> {
    let Rotation {
        frame,
        radius,
        order,
        ..
    } = rotation;
    let loose = limits.loose * radius;
    if kind == VERTICAL
        && let Some(exact) = mirror_of_faces(shape, rotation, limits)
    {
        return Some(exact);
    }
    let period = PI / f64::from(*order);
    // An angle off by half a step moves an image by one step times the radius.
    let steps = ((2.0 * period / limits.loose).ceil() as usize).max(32);
    let samples = &shape.samples.mixed[..SCORED.min(shape.samples.mixed.len())];
    let allowed = (OUTLIERS * samples.len() as f64) as usize;
    let score = |angle: f64| {
        let turn = turn_matrix(angle / PI);
        let motion = Motion::new(frame, turn * kind);
        let (mut sum, mut missed) = (0.0, 0);
        for s in samples {
            match shape.nearest(motion.apply(s.point), 0, &Target::Any, loose) {
                Some(n) => sum += n.distance,
                None => {
                    sum += loose;
                    missed += 1;
                    if missed > allowed {
                        return f64::INFINITY;
                    }
                }
            }
        }
        sum
    };
    let angles: Vec<f64> = (0..steps)
        .map(|i| period * i as f64 / steps as f64)
        .collect();
    let scores = in_parallel(&angles, shape.threads, |&angle| score(angle));
    let mut candidates: Vec<usize> = (0..steps)
        .filter(|&i| {
            let s = scores[i];
            s.is_finite() && s <= scores[(i + 1) % steps] && s <= scores[(i + steps - 1) % steps]
        })
        .collect();
    candidates.sort_by(|&i, &j| scores[i].total_cmp(&scores[j]).then(i.cmp(&j)));
    candidates.truncate(CLOSE);

    let bound = limits.bound(*radius);
    let mut best: Option<Found> = None;
    for i in candidates {
        let (s, c) = libm::sincos(angles[i]);
        let x = frame.rotation * DVec3::new(c, s, 0.0);
        let Some(turned) = Frame::from_axis(frame.origin, frame.rotation.z_axis, x) else {
            continue;
        };
        let adjusted = if fixed {
            turn_only(shape, turned, kind, loose)
        } else {
            let mut operations = vec![canonical(kind)];
            if rotation.distinct {
                operations.extend(powers(*order, &Target::Any));
            }
            // Where the rotations are exact, few samples tell the angle.
            let exact = rotation.deviation.value <= EXACT;
            refine(
                shape,
                turned,
                &operations,
                if exact { 600 } else { 2_000 },
                loose,
            )
        };
        let motion = Motion::new(&adjusted, kind);
        if let Ok((deviation, permutation)) = shape.verify_one(motion, bound, Depth::Quick) {
            let better = best
                .as_ref()
                .is_none_or(|b| deviation.value < 0.5 * b.deviation.value);
            if better {
                best = Some(Found {
                    frame: adjusted,
                    deviation,
                    permutation,
                });
            }
            // No other angle can be better than the rotations themselves.
            if deviation.value <= shape.rounding().max(rotation.deviation.value) {
                break;
            }
        }
    }
    best
}

/// The mirror that contains the axis of a rotation which takes faces to faces, if it does so too: it takes the
/// corner that is farthest from the axis to one that is as far, on the same height.
fn mirror_of_faces(shape: &Shape, rotation: &Rotation, limits: Limits) -> Option<Found> {
    let frame = &rotation.frame;
    let faces = rotation.deviation.everywhere.then(|| shape.faces())??;
    let place = |p: DVec3| {
        let p = frame.to_canonical(p);
        (libm::hypot(p.x, p.y), p.z)
    };
    let within = 2.0 * shape.same_corner();
    let corners = faces.farthest(place, within);
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
    parts.dedup_by(|a, b| *a - *b < CLOSE_PARTS);
    let bound = limits.bound(rotation.radius);
    parts.truncate(CLOSE);
    parts.into_iter().find_map(|part| {
        let (s, c) = libm::sincos(angles[0] + 0.5 * part * step);
        let x = frame.rotation * DVec3::new(c, s, 0.0);
        let frame = Frame::from_axis(frame.origin, frame.rotation.z_axis, x)?;
        let motion = Motion::new(&frame, VERTICAL);
        let (deviation, permutation) = shape.verify_one(motion, bound, Depth::Quick).ok()?;
        deviation.everywhere.then_some(Found {
            frame,
            deviation,
            permutation,
        })
    })
}

fn canonical(matrix: DMat3) -> Canonical {
    Canonical {
        matrix,
        target: Target::Any,
    }
}

/// Adjusts the angle about the axis and leaves axis and centre where they are.
fn turn_only(shape: &Shape, frame: Frame, kind: DMat3, loose: f64) -> Frame {
    let adjusted = refine(shape, frame, &[canonical(kind)], 2_000, loose);
    Frame::from_axis(
        frame.origin,
        frame.rotation.z_axis,
        adjusted.rotation.x_axis,
    )
    .unwrap_or(frame)
}

/// Verifies `R(turn) * H`: the mirror across the axis (`turn` 0) or the rotary reflection by
/// `turn = 1 / (2 n)`. The centre is adjusted along the axis, never across it.
pub fn find_flip(
    shape: &Shape,
    rotation: &Rotation,
    turn: Isometry,
    limits: Limits,
) -> Option<Found> {
    let frame = &rotation.frame;
    let matrix = turn.matrix() * HORIZONTAL;
    let bound = limits.bound(rotation.radius);
    let verify = |frame: Frame| {
        let motion = Motion::new(&frame, matrix);
        let (deviation, permutation) = shape.verify_one(motion, bound, Depth::Quick).ok()?;
        Some(Found {
            frame,
            deviation,
            permutation,
        })
    };
    let as_is = verify(*frame);
    let enough = shape.rounding().max(rotation.deviation.value);
    if as_is.as_ref().is_some_and(|f| f.deviation.value <= enough) {
        return as_is;
    }
    let loose = limits.loose * rotation.radius;
    let adjusted = refine(shape, *frame, &[canonical(matrix)], 2_000, loose);
    let axis = frame.rotation.z_axis;
    let slid = verify(Frame {
        origin: frame.origin + axis * axis.dot(adjusted.origin - frame.origin),
        ..*frame
    });
    match (as_is, slid) {
        (Some(a), Some(s)) if a.deviation.value <= s.deviation.value => Some(a),
        (a, s) => s.or(a),
    }
}

/// Finds the mirror plane whose normal is near `normal`, of a body without rotation symmetry. The
/// frame's y direction is the plane's normal; its axis is the coordinate axis that lies best in the
/// plane, turned into it.
pub fn find_mirror_plane(
    shape: &Shape,
    centre: DVec3,
    normal: DVec3,
    axis: Option<DVec3>,
    limits: Limits,
    depth: Depth,
) -> Option<(Found, f64)> {
    let frame_of = |origin: DVec3, normal: DVec3| {
        let hint = axis.unwrap_or_else(|| in_plane_axis(normal));
        let z = (hint - normal * hint.dot(normal)).try_normalize()?;
        Frame::from_axis(origin, z, normal.cross(z))
    };
    let start = frame_of(centre, normal)?;
    let radius = shape.radius(&start);
    // An adjustment only helps where much of the surface is a little off.
    let motion = Motion::new(&start, VERTICAL);
    let samples = &shape.samples.mixed[..200.min(shape.samples.mixed.len())];
    let reach = limits.loose * radius;
    let (mut off, mut far) = (0, 0);
    for sample in samples {
        match shape.nearest(motion.apply(sample.point), 0, &Target::Any, reach) {
            Some(n) => off += usize::from(n.distance > 0.3 * limits.tolerance * radius),
            None => far += 1,
        }
    }
    if far as f64 > OUTLIERS * samples.len() as f64 {
        return None;
    }
    let first = shape.verify_one(motion, limits.bound(radius), Depth::Quick);
    if first.is_err() && 20 * (off + far) < samples.len() {
        return None;
    }
    let adjusted = refine(shape, start, &[canonical(VERTICAL)], 4_000, reach);
    let frame = frame_of(adjusted.origin, adjusted.rotation.y_axis)?;
    let radius = shape.radius(&frame);
    let motion = Motion::new(&frame, VERTICAL);
    let bound = limits.bound(radius);
    let (deviation, permutation) = shape.verify_one(motion, bound, depth).ok()?;
    let found = Found {
        frame,
        deviation,
        permutation,
    };
    Some((found, radius))
}

/// The coordinate axis that lies best in the plane with the given normal; z before x before y.
fn in_plane_axis(normal: DVec3) -> DVec3 {
    let mut best = DVec3::Z;
    for axis in [DVec3::X, DVec3::Y] {
        if normal.dot(axis).abs() < normal.dot(best).abs() - 1e-6 {
            best = axis;
        }
    }
    best
}
