//! Makes the points of a wall exactly coplanar for the mesher.
//!
//! Points at the angle of a wall, `(r cos, r sin, z)`, are on its plane up to rounding only. TetGen decides
//! with exact arithmetic whether points are coplanar, and on thin layers the answer "not quite" ends in
//! failed assertions. So the mesher gets the wall at a slope that is a ratio of two small whole numbers,
//! and on it multiples of that direction by numbers with few digits: then all products are exact. The shift
//! is below 1e-10 of the radius (1e-9 for a few orders above 180), and is taken back afterwards.

use geom::predicate::orientation;
use glam::DVec3;

/// Moves the listed points into one plane through the z axis, exactly, near the angle with the given
/// cosine and sine. Returns the largest distance moved; nothing moves when the points are exact
/// already.
pub fn flatten(points: &mut [[f64; 3]], listed: &[usize], cos: f64, sin: f64) -> f64 {
    // The smaller part over the larger one.
    let steep = sin.abs() > cos.abs();
    let (large, small) = if steep { (sin, cos) } else { (cos, sin) };
    let ((numerator, denominator), bits) = direction(small.abs() / large.abs());
    let (q, p) = (
        (denominator as f64).copysign(large),
        (numerator as f64).copysign(small),
    );
    let (x, y) = if steep { (p, q) } else { (q, p) };
    let direction = DVec3::new(x, y, 0.0);
    let on_plane = |p: &[f64; 3]| {
        let p = DVec3::new(p[0], p[1], 0.0);
        orientation(DVec3::ZERO, direction, DVec3::Z, p) == 0.0
    };
    let length = direction.length();
    if listed.iter().all(|&i| on_plane(&points[i])) {
        return 0.0;
    }
    let multiple = |p: &[f64; 3]| (p[0] * x + p[1] * y) / (length * length);
    let largest = listed
        .iter()
        .fold(0.0_f64, |m, &i| m.max(multiple(&points[i]).abs()));
    if largest == 0.0 {
        return 0.0;
    }
    // A power of two that leaves the multiples the bits that the direction does not take.
    let unit = libm::scalbn(1.0, libm::ilogb(largest) + 1) * grain(bits);
    let mut moved = 0.0_f64;
    for &i in listed {
        let point = &mut points[i];
        let k = (multiple(point) / unit).round();
        let to = [k * x * unit + 0.0, k * y * unit + 0.0];
        moved = moved.max((to[0] - point[0]).hypot(to[1] - point[1]));
        [point[0], point[1]] = to;
    }
    moved
}

/// What is left of one for multiples of a direction of whole numbers with so many bits, if the products are to be exact: a
/// coordinate has the digits of both.
fn grain(bits: u32) -> f64 {
    libm::scalbn(1.0, bits as i32 - f64::MANTISSA_DIGITS as i32)
}

/// A fraction near `x`, in [0, 1], and the bits of its denominator: with fewer the direction is off by more, with more the
/// multiples get coarser, so that the number of bits for which both errors come to the least is taken.
fn direction(x: f64) -> ((i64, i64), u32) {
    let mut best = ((0, 1), 0);
    let mut least = f64::INFINITY;
    for bits in 0..f64::MANTISSA_DIGITS {
        let (p, q) = ratio(x, 1 << bits);
        let off = (p as f64 / q as f64 - x).abs() + 0.5 * grain(bits);
        if off < least {
            (best, least) = (((p, q), bits), off);
        }
    }
    best
}

/// The fraction nearest to `x` (in [0, 1]) with a denominator up to `limit`, by continued fractions.
fn ratio(x: f64, limit: i64) -> (i64, i64) {
    let (mut p0, mut q0, mut p1, mut q1) = (0_i64, 1_i64, 1_i64, 0_i64);
    let mut rest = x;
    loop {
        let whole = rest.floor();
        // Once `rest` is rounding only, `whole` is too large, or infinite.
        if whole * q1 as f64 + q0 as f64 > limit as f64 {
            break;
        }
        let a = whole as i64;
        (p0, q0, p1, q1) = (p1, q1, a * p1 + p0, a * q1 + q0);
        rest = 1.0 / (rest - whole);
    }
    let k = (limit - q0) / q1;
    let between = (p0 + k * p1, q0 + k * q1);
    let error = |(p, q): (i64, i64)| (p as f64 / q as f64 - x).abs();
    if error(between) < error((p1, q1)) {
        between
    } else {
        (p1, q1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::Isometry;

    #[test]
    fn ratios_are_the_best_ones() {
        assert_eq!(ratio(0.5, 1000), (1, 2));
        assert_eq!(ratio(0.0, 1000), (0, 1));
        assert_eq!(ratio(1.0, 1000), (1, 1));
        assert_eq!(ratio(std::f64::consts::PI - 3.0, 113), (16, 113));
        assert_eq!(ratio(std::f64::consts::PI - 3.0, 100), (14, 99));
    }

    #[test]
    fn points_of_every_wall_become_coplanar() {
        for parts in 2..400_u32 {
            for k in [1, 2, 3] {
                let (cos, sin) = Isometry::rotation(k, parts).cos_sin();
                let mut points: Vec<[f64; 3]> = (1..20)
                    .map(|i| {
                        let r = 1.0 / f64::from(i) - 0.2;
                        [r * cos, r * sin, f64::from(i)]
                    })
                    .collect();
                let before = points.clone();
                let listed: Vec<usize> = (0..points.len()).filter(|i| i % 5 != 4).collect();
                let moved = flatten(&mut points, &listed, cos, sin);
                assert!(
                    moved < 1e-9 && (moved < 1.2e-10 || parts == 372),
                    "{k}/{parts}: {moved}"
                );
                for (i, p) in points.iter().enumerate() {
                    if !listed.contains(&i) {
                        assert_eq!(*p, before[i]);
                    }
                }
                let at = |i: usize| DVec3::from_array(points[listed[i]]);
                for i in 2..listed.len() {
                    // Exactly on one plane through the axis.
                    let turn = orientation(DVec3::ZERO, at(0), DVec3::Z, at(i));
                    assert_eq!(turn, 0.0, "{k}/{parts}");
                }
            }
        }
    }
}
