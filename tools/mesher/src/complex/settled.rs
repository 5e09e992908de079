//! Points put back onto planes that meet.

use glam::DVec3;

/// Puts a point onto `count` planes at once. `onto` moves a point onto the plane with that number.
///
/// A single projection meets a single plane, and leaves others that it crosses by less each time: planes at an angle of
/// 45 degrees and more, as nearly all are, have what is left halved by each round. Rounds end when they do not halve it
/// any more, which at last rounding sees to.
///
/// # Errors
/// That of the first projection that has one.
pub fn settled<E>(
    point: DVec3,
    count: usize,
    mut onto: impl FnMut(usize, DVec3) -> Result<DVec3, E>,
) -> Result<DVec3, E> {
    let mut point = point;
    let mut last = f64::INFINITY;
    loop {
        let before = point;
        for plane in 0..count {
            point = onto(plane, point)?;
        }
        let moved = point.distance(before);
        // False for NaN, too.
        let goes_on = count > 1 && moved > 0.0 && moved < 0.5 * last;
        if !goes_on {
            return Ok(point);
        }
        last = moved;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_ends_on_all_planes_that_meet() {
        let across = DVec3::new(0.6, 0.0, 0.8);
        let normals = [DVec3::X, DVec3::Y, across];
        let onto = |i: usize, p: DVec3| Ok::<_, ()>(p - normals[i] * p.dot(normals[i]));
        let p = settled(DVec3::new(1e-9, 2e-9, -3e-9), 3, onto).unwrap();
        assert!(normals.iter().all(|n| p.dot(*n).abs() < 1e-24), "{p}");
        // One plane is met at once, none at all moves nothing.
        assert_eq!(
            settled(DVec3::ONE, 1, onto).unwrap(),
            DVec3::new(0.0, 1.0, 1.0)
        );
        assert_eq!(settled(DVec3::ONE, 0, onto).unwrap(), DVec3::ONE);
    }

    #[test]
    fn planes_that_are_nearly_one_do_not_keep_it_going() {
        let normals = [DVec3::X, DVec3::new(1.0, 1e-9, 0.0)];
        let onto = |i: usize, p: DVec3| Ok::<_, ()>(p - normals[i] * p.dot(normals[i]));
        let p = settled(DVec3::ONE, 2, onto).unwrap();
        assert!((p - DVec3::new(0.0, 1.0, 1.0)).length() < 1e-8);
    }
}
