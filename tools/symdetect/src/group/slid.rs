//! Operations that turn the axis over wherever it is slid to: the mirror across it, rotary reflections.

use crate::budget::FIT;
use crate::group::found::Beside;
use crate::rotation::{Canonical, Query, Rotation};
use crate::shape::{Motion, Target};
use crate::verify::Depth;
use tmesh::{Frame, Isometry};

/// Verifies an operation that needs no particular direction across the axis. The centre is adjusted along the axis,
/// never across it, so that all that holds about the axis keeps holding.
pub fn find_slid(query: &Query<'_>, rotation: &Rotation, operation: Isometry) -> Option<Beside> {
    let (shape, frame) = (query.shape, &rotation.frame);
    let bound = query.limits.bound(rotation.radius);
    let verify = |frame: Frame| {
        let motion = Motion::new(&frame, operation.matrix());
        let (deviation, permutation) = shape.verify_one(motion, bound, Depth::Quick).ok()?;
        Some(Beside {
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
    let canonical = Canonical::new(operation, Target::Any);
    let adjusted = query.adjusted(*frame, rotation.radius, &[canonical], FIT / 2);
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
