//! A mirror plane of a body without rotation symmetry.

use crate::budget::{FIT, QUICK, SCAN};
use crate::group::found::{Beside, Found};
use crate::group::turned::Turned;
use crate::rotation::{Canonical, OUTLIERS, Query, Rotation, principal};
use crate::shape::{Motion, Permutation, Target};
use crate::tolerance::SINGLE;
use crate::verify::{Check, Depth, Deviation, Verified};
use geom::tree::alignment;
use glam::{DMat3, DVec3};
use tmesh::{Frame, Group, Isometry, Kind};

impl Query<'_> {
    /// The best single mirror plane with a normal among `directions`, or that contains the axis given or the one that second moments tell: a
    /// mirror takes that to itself, and where features of two orders have nothing else in common, no moments tell its normal.
    pub fn mirror_only(&self, directions: &[DVec3]) -> Option<Found> {
        let shape = self.shape;
        let normals = match self.params.axis {
            None => {
                let principal = principal(shape, self.same_candidate());
                let odd = principal.odd();
                let across = odd.and_then(|axis| self.normal_across(axis, false));
                directions.iter().copied().chain(across).collect()
            }
            Some(axis) => vec![self.normal_across(axis, true)?],
        };
        let mut best: Option<(Beside, f64)> = None;
        for normal in normals {
            let Some((found, radius)) = self.mirror_plane(normal) else {
                continue;
            };
            // The origin was adjusted along the normal only: it must still be where it was.
            if !self.passes_centre(&found.frame, DVec3::ZERO, radius) {
                continue;
            }
            let value = |f: &Beside, r: f64| f.deviation.value.max(self.noise(r));
            if best
                .as_ref()
                .is_none_or(|(b, r)| value(&found, radius) < 0.5 * value(b, *r))
            {
                best = Some((found, radius));
            }
        }
        let (mirror, radius) = best?;
        let identity = Permutation::identity(shape.region_count());
        let mut found = Found {
            frame: mirror.frame,
            rough: mirror.frame,
            radius,
            group: Group::new(Kind::Cv, 1),
            verified: Verified {
                deviation: mirror.deviation,
                rotation: identity.clone(),
                mirror: mirror.permutation,
                turning: identity,
            },
            axisymmetric: false,
            distinct: true,
        };
        self.settle(&mut found);
        let check = Check {
            shape,
            frame: &found.frame,
            bound: self.limits.bound(radius),
            depth: Depth::Full,
        };
        match check.group(&found.group) {
            Ok(verified) => found.verified = verified,
            Err(_) => found.frame = mirror.frame,
        }
        Some(found)
    }

    /// The normal of the mirror plane that contains an axis, which may be adjusted unless `fixed`.
    fn normal_across(&self, axis: DVec3, fixed: bool) -> Option<DVec3> {
        let start = Frame::from_axis(self.centre, axis, axis.any_orthogonal_vector())?;
        let rotation = Rotation {
            frame: start,
            radius: self.shape.radius(&start),
            order: 1,
            permutation: Permutation::identity(self.shape.region_count()),
            deviation: Deviation::NONE,
            axisymmetric: false,
            distinct: true,
        };
        let turned = Turned {
            query: self,
            rotation: &rotation,
            operation: Isometry::MIRROR,
            fixed,
        };
        Some(turned.find()?.frame.rotation.y_axis)
    }

    /// Finds the mirror plane whose normal is near `normal`, and the radius about the axis in it. The
    /// frame's y direction is the plane's normal; its axis is that of the directions along faces, or of the coordinate
    /// axes, that lies best in the plane, turned into it.
    fn mirror_plane(&self, normal: DVec3) -> Option<(Beside, f64)> {
        let (shape, limits) = (self.shape, self.limits);
        let along = self.along_faces();
        let frame_of = |origin, normal| self.frame_of_plane(&along, origin, normal);
        let start = frame_of(self.centre, normal)?;
        let mirror = Isometry::MIRROR;
        let motion = |frame: &Frame| Motion::new(frame, mirror.matrix());
        let radius = shape.radius(&start);
        if !self.can_be_adjusted(motion(&start), radius) {
            return None;
        }
        let canonical = [Canonical::new(mirror, Target::Any)];
        let rough = self.adjusted(start, radius, &canonical, QUICK);
        // What a few equations bring no nearer than a candidate must be does not hold.
        let loose = limits.loosely(shape.radius(&rough));
        shape.verify_one(motion(&rough), loose, Depth::Quick).ok()?;
        let adjusted = self.adjusted(rough, radius, &canonical, FIT);
        let frame = frame_of(adjusted.origin, adjusted.rotation.y_axis)?;
        let radius = shape.radius(&frame);
        let bound = limits.bound(radius);
        let verified = shape.verify_one(motion(&frame), bound, Depth::Full);
        let (deviation, permutation) = verified.ok()?;
        let found = Beside {
            frame,
            deviation,
            permutation,
        };
        Some((found, radius))
    }

    /// Directions along faces, or of the coordinate axes, in the order in which an axis in a mirror plane is taken from them.
    pub fn along_faces(&self) -> [DVec3; 3] {
        let shape = self.shape;
        let faces = alignment(shape.triangles.len(), |t| shape.corners(t as u32));
        let to_world = faces.map_or(DMat3::IDENTITY, |rows| rows.transpose());
        [DVec3::Z, DVec3::X, DVec3::Y].map(|axis| to_world * axis)
    }

    /// The frame of a mirror plane, whose normal is its y direction: its axis is that of some directions that lies best in the plane, turned
    /// into it.
    pub fn frame_of_plane(
        &self,
        along: &[DVec3; 3],
        origin: DVec3,
        normal: DVec3,
    ) -> Option<Frame> {
        let hint = (self.params.axis).unwrap_or_else(|| in_plane_axis(normal, *along));
        let z = (hint - normal * hint.dot(normal)).try_normalize()?;
        Frame::from_axis(origin, z, normal.cross(z))
    }

    /// Whether a mirror holds or an adjustment may make it hold: it helps only where much of the surface is a little
    /// off, not where little of it is, and not where too much is far off.
    fn can_be_adjusted(&self, motion: Motion, radius: f64) -> bool {
        let (shape, limits) = (self.shape, self.limits);
        let samples = &shape.samples.mixed[..SCAN.min(shape.samples.mixed.len())];
        let loose = limits.loosely(radius);
        let (mut off, mut far) = (0, 0);
        for sample in samples {
            match shape.near(
                motion.apply(sample.point),
                sample.triangle,
                &Target::Any,
                loose,
            ) {
                Some(n) => off += usize::from(n.distance > 0.3 * limits.tolerance * radius),
                None => far += 1,
            }
        }
        if far as f64 > OUTLIERS * samples.len() as f64 {
            return false;
        }
        let first = shape.verify_one(motion, limits.bound(radius), Depth::Quick);
        first.is_ok() || 20 * (off + far) >= samples.len()
    }
}

/// The one of three axes that lies best in the plane with the given normal; earlier ones before later ones.
fn in_plane_axis(normal: DVec3, [first, second, third]: [DVec3; 3]) -> DVec3 {
    let mut best = first;
    for axis in [second, third] {
        if normal.dot(axis).abs() < normal.dot(best).abs() - SINGLE {
            best = axis;
        }
    }
    best
}
