//! Angles at which a wedge may begin.

use glam::DVec3;

/// Parts of the wedge's opening of which each has an angle to try: the place that harms least is told from its
/// neighbours to a sixteenth of the opening, which is less than two of the elements that fit between the sides.
pub const PLACES: usize = 16;

/// Angles for the first side of a wedge whose sides may be anywhere, radians, best first: the middle of the largest
/// gap between the angles of the vertices modulo the wedge's `opening`, so that the sides cut edges cleanly
/// between vertices, the smallest such angle when several gaps are equal; then the same about a
/// part of the opening further on each. `near` and `detail`, radians: within the first of a side, vertices are put on it; sides
/// that pass them farther off, but by no more than the second, leave strips that are too narrow to be told apart.
pub fn clear_angles(
    vertices: &[DVec3],
    opening: f64,
    axis_tolerance: f64,
    [near, detail]: [f64; 2],
) -> Vec<f64> {
    // Angles that differ by less are equal, and so are gaps: rounding does not choose.
    let equal = f64::EPSILON.sqrt() * opening;
    let mut angles: Vec<f64> = vertices
        .iter()
        .filter(|p| p.x.hypot(p.y) > axis_tolerance)
        .map(|p| libm::atan2(p.y, p.x).rem_euclid(opening))
        .collect();
    angles.sort_unstable_by(f64::total_cmp);
    let (Some(first), Some(last)) = (angles.first(), angles.last()) else {
        return vec![0.0];
    };
    let wrap = (last - opening, *first);
    let gaps = || std::iter::once(wrap).chain(angles.windows(2).map(|w| (w[0], w[1])));
    let largest = |gaps: &mut dyn Iterator<Item = (f64, f64)>| {
        gaps.reduce(|best, gap| match gap.1 - gap.0 > best.1 - best.0 + equal {
            true => gap,
            false => best,
        })
    };
    let middle = |gap: (f64, f64)| (0.5 * (gap.0 + gap.1)).rem_euclid(opening);
    let widest = largest(&mut gaps());
    let best = widest.map_or(0.0, middle);
    let part = opening / PLACES as f64;
    let others = (1..PLACES).filter_map(|k| {
        let around = best + part * k as f64;
        let off = |gap: (f64, f64)| (middle(gap) - around + 0.5 * opening).rem_euclid(opening);
        let is_near = |gap: &(f64, f64)| (off(*gap) - 0.5 * opening).abs() <= 0.5 * part;
        let is_open = |gap: &(f64, f64)| {
            let width = gap.1 - gap.0;
            width > equal && !(2.0 * near < width && width <= 2.0 * detail)
        };
        largest(&mut gaps().filter(is_open).filter(is_near)).map(middle)
    });
    std::iter::once(best).chain(others).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clear_angle_avoids_vertices() {
        let at = |degrees: f64| {
            let a = degrees.to_radians();
            DVec3::new(a.cos(), a.sin(), 0.0)
        };
        let vertices = [at(0.0), at(10.0), at(90.0), at(100.0), at(200.0)];
        // Modulo 90: 0, 10, 0, 10, 20; the largest gap is 20 to 90.
        let angles = clear_angles(&vertices, std::f64::consts::FRAC_PI_2, 1e-9, [0.0; 2]);
        assert!((angles[0].to_degrees() - 55.0).abs() < 1e-9, "{angles:?}");
        // Further on, one for each part with a gap: between 0 and 10, and between 10 and 20.
        let others: Vec<f64> = angles[1..].iter().map(|a| a.to_degrees().round()).collect();
        assert_eq!(others, [5.0, 15.0]);
        let wide = clear_angles(&vertices, std::f64::consts::FRAC_PI_2, 1e-9, [0.05, 0.1]);
        assert_eq!(wide, angles[..1]);
        let on_sides = clear_angles(&vertices, std::f64::consts::FRAC_PI_2, 1e-9, [0.1, 0.1]);
        assert_eq!(on_sides, angles);
    }
}
