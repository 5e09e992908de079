//! Points put back onto planes that meet.

use geom::eigen;
use geom::flat::FACE_FOLD_COSINE;
use glam::DVec3;

/// Puts a point onto `count` planes at once. `onto` moves a point onto the plane with that number.
///
/// What all projections say together is solved for the shortest way to where the planes meet, whatever the angle between
/// them; planes at the angle of folds in one face count as one. What rounding leaves, projections onto one plane after the
/// other take away: rounds end when they do not halve it any more.
///
/// # Errors
/// That of the first projection that has one.
pub fn settled<E>(
    point: DVec3,
    count: usize,
    mut onto: impl FnMut(usize, DVec3) -> Result<DVec3, E>,
) -> Result<DVec3, E> {
    let mut point = match count > 1 {
        true => point + way(point, count, &mut onto)?,
        false => point,
    };
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

/// The shortest way that projections onto planes lead to all of them.
fn way<E>(
    point: DVec3,
    count: usize,
    mut onto: impl FnMut(usize, DVec3) -> Result<DVec3, E>,
) -> Result<DVec3, E> {
    let mut normals = [[0.0; 3]; 3];
    let mut offsets = DVec3::ZERO;
    for plane in 0..count {
        let off = onto(plane, point)? - point;
        let normal = off.normalize_or_zero();
        for (row, x) in normals.iter_mut().zip(normal.to_array()) {
            for (sum, y) in row.iter_mut().zip(normal.to_array()) {
                *sum += x * y;
            }
        }
        offsets += off;
    }
    let solution = eigen::symmetric(normals);
    let directions = solution.values.iter().zip(solution.vectors);
    let told = directions.filter(|(value, _)| **value > 1.0 - FACE_FOLD_COSINE);
    Ok(told
        .map(|(value, along)| {
            let along = DVec3::from_array(along);
            along * (offsets.dot(along) / value)
        })
        .sum())
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
    fn planes_at_a_small_angle_meet_on_a_line() {
        let normals = [DVec3::Z, DVec3::new(libm::sin(0.05), 0.0, libm::cos(0.05))];
        let onto = |i: usize, p: DVec3| Ok::<_, ()>(p - normals[i] * p.dot(normals[i]));
        let p = settled(DVec3::new(3e-7, 2.0, 1e-7), 2, onto).unwrap();
        assert!((p - DVec3::Y * 2.0).length() < 1e-20, "{p}");
    }

    #[test]
    fn planes_that_are_nearly_one_do_not_keep_it_going() {
        let normals = [DVec3::X, DVec3::new(1.0, 1e-9, 0.0)];
        let onto = |i: usize, p: DVec3| Ok::<_, ()>(p - normals[i] * p.dot(normals[i]));
        let p = settled(DVec3::ONE, 2, onto).unwrap();
        assert!((p - DVec3::new(0.0, 1.0, 1.0)).length() < 1e-8);
    }
}
