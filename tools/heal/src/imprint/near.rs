//! What lies within a distance of each other.

use glam::DVec3;

/// Where a point lies on a triangle, or beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// At this corner.
    Corner(usize),
    /// On the edge that begins at this corner, and how far along: from 0 to 1.
    Edge(usize, f64),
    /// In the interior.
    Inside,
}

/// The part of a triangle that a point lies at, if one is within a distance: a corner before an edge, and that before
/// the interior.
pub fn spot(p: DVec3, t: &[DVec3; 3], within: f64) -> Option<Spot> {
    let corner = (0..3)
        .map(|i| (p.distance_squared(t[i]), i))
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    if corner.0 <= within * within {
        return Some(Spot::Corner(corner.1));
    }
    let mut edge: Option<(f64, usize, f64)> = None;
    for i in 0..3 {
        let (along, off) = beside(p, t[i], t[(i + 1) % 3]);
        if off <= within && edge.is_none_or(|e| off < e.0) {
            edge = Some((off, i, along));
        }
    }
    if let Some((_, i, along)) = edge {
        return Some(Spot::Edge(i, along));
    }
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
    if normal == DVec3::ZERO || (p - t[0]).dot(normal).abs() > within {
        return None;
    }
    is_over(p, t, normal).then_some(Spot::Inside)
}

/// Whether all of a triangle is farther than a distance from another one: over or under its plane, or beyond one of its
/// edges. False says nothing.
pub fn is_beside(p: &[DVec3; 3], t: &[DVec3; 3], within: f64) -> bool {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
    let beyond = |from: DVec3, out: DVec3| p.iter().all(|x| (x - from).dot(out) > within);
    let beyond_edge = |i: usize| {
        let out = (t[(i + 1) % 3] - t[i]).cross(normal).normalize_or_zero();
        beyond(t[i], out)
    };
    beyond(t[0], normal) || beyond(t[0], -normal) || (0..3).any(beyond_edge)
}

/// Whether a point lies over a triangle along its normal.
pub fn is_over(p: DVec3, t: &[DVec3; 3], normal: DVec3) -> bool {
    (0..3).all(|i| (t[(i + 1) % 3] - t[i]).cross(p - t[i]).dot(normal) > 0.0)
}

/// Where along a segment a point is nearest to it, from 0 to 1, and how far it is from there.
fn beside(p: DVec3, a: DVec3, b: DVec3) -> (f64, f64) {
    let along = b - a;
    let f = (p - a).dot(along) / along.length_squared();
    let f = if f.is_finite() {
        f.clamp(0.0, 1.0)
    } else {
        0.0
    };
    (f, p.distance(a + along * f))
}

/// Where two segments pass each other within a distance, farther than `clear` from the ends of both: the place along
/// either.
pub fn crossing(e: [DVec3; 2], f: [DVec3; 2], within: f64, clear: f64) -> Option<[f64; 2]> {
    let normal = (e[1] - e[0]).cross(f[1] - f[0]);
    crossing_along(normal, e, f, within, clear)
}

/// The same where one segment is over the other one along a direction. Two chords of one curved surface that are almost parallel are
/// nearest to each other far beside that.
pub fn crossing_along(
    normal: DVec3,
    e: [DVec3; 2],
    f: [DVec3; 2],
    within: f64,
    clear: f64,
) -> Option<[f64; 2]> {
    let (u, v, w) = (e[1] - e[0], f[1] - f[0], f[0] - e[0]);
    let size = u.cross(v).dot(normal);
    if size == 0.0 {
        return None;
    }
    let s = w.cross(v).dot(normal) / size;
    let t = w.cross(u).dot(normal) / size;
    if !(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) {
        return None;
    }
    let (p, q) = (e[0] + u * s, f[0] + v * t);
    let is_clear = |x: DVec3| e.iter().chain(&f).all(|y| x.distance(*y) > clear);
    (p.distance(q) <= within && is_clear(p) && is_clear(q)).then_some([s, t])
}

/// Where a segment passes through a triangle, farther than a distance from those of its edges that are on the border of a face and from
/// the ends of the segment: the place along the segment.
pub fn piercing(e: [DVec3; 2], t: &[DVec3; 3], border: [bool; 3], within: f64) -> Option<f64> {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
    let [g, h] = e.map(|p| (p - t[0]).dot(normal));
    // What ends in the plane crosses the border of the face, or ends in it.
    if g.signum() == h.signum() || g.abs().min(h.abs()) <= within {
        return None;
    }
    let s = g / (g - h);
    let p = e[0] + (e[1] - e[0]) * s;
    let clear_of = |i: usize| {
        let (a, b) = (t[i], t[(i + 1) % 3]);
        let above = (b - a).cross(p - a).dot(normal) > 0.0;
        let near = beside(p, a, b).1 <= within;
        if border[i] {
            above && !near
        } else {
            above || near
        }
    };
    let clear = e.iter().all(|x| x.distance(p) > within);
    (clear && (0..3).all(clear_of)).then_some(s)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chords of two curves on a cylinder that touch each other, seen from outside: across the axis, and rising a little.
    #[test]
    fn chords_that_are_almost_parallel_cross_where_one_is_over_the_other() {
        let on = |angle: f64, z: f64| DVec3::new(angle.cos(), angle.sin(), z);
        let level = [on(-0.1, 0.0), on(0.1, 0.0)];
        let rising = [on(-0.02, -2e-4), on(0.09, 9e-4)];
        let outwards = on(0.0, 0.0);
        let passed = |along: [f64; 2]| {
            let [p, q] = [(level, along[0]), (rising, along[1])].map(|([a, b], t)| a.lerp(b, t));
            (p - q).reject_from(outwards).length()
        };
        let over = crossing_along(outwards, level, rising, 0.1, 0.0).expect("they cross");
        assert!(passed(over) < 1e-15, "{over:?}");
        // Where the lines are nearest to each other is beyond the ends of both.
        assert_eq!(crossing(level, rising, 0.1, 0.0), None);
        assert!(
            crossing_along(outwards, level, rising, 1e-4, 0.0).is_none(),
            "too far apart"
        );
        let beyond = [on(0.11, -2e-4), on(0.2, 9e-4)];
        assert!(crossing_along(outwards, level, beyond, 0.1, 0.0).is_none());
        assert!(
            crossing_along(outwards, level, level, 0.1, 0.0).is_none(),
            "parallel"
        );
    }
}
