//! Where circles about the axis pass through a body.

use glam::{DVec2, DVec3};
use tmesh::{OUTSIDE, Triangle};

/// A place where a circle meets the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Meeting {
    /// Angle, as a share of the opening, from 0 to below 1.
    at: f64,
    /// Whether there is material right after it, in the direction of increasing angles.
    enters: bool,
}

/// Circles at all of some distances from the axis and heights.
pub struct Circles {
    /// Distances from the axis, increasing, model units.
    pub radii: Vec<f64>,
    /// Heights, increasing, model units.
    pub heights: Vec<f64>,
    /// For each height those at all distances, increasing.
    meetings: Vec<Vec<Meeting>>,
}

impl Circles {
    /// Finds where circles meet a surface in the canonical frame, whose images are `opening` (radians) apart.
    pub fn new(
        points: &[DVec3],
        triangles: &[Triangle],
        opening: f64,
        [radii, heights]: [Vec<f64>; 2],
    ) -> Self {
        let mut meetings = vec![Vec::new(); radii.len() * heights.len()];
        for t in triangles {
            let corners = geom::measure::corners(points, t);
            let zs = corners.map(|p| p.z);
            let low = zs.into_iter().fold(f64::INFINITY, f64::min);
            let high = zs.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let first = heights.partition_point(|z| *z <= low);
            let last = heights.partition_point(|z| *z < high);
            for j in first..last {
                let Some([p, q]) = level(corners, heights[j]) else {
                    continue;
                };
                let [a, b, c] = corners;
                let normal = geom::measure::double_area_vector(a, b, c);
                let far = p.length().max(q.length());
                for (i, &radius) in radii.iter().enumerate() {
                    if radius > far {
                        break;
                    }
                    for at in meet(p, q, radius) {
                        // Behind the triangle, in the direction in which angles increase.
                        let ahead = normal.x * -at.y + normal.y * at.x;
                        let after = if ahead < 0.0 { t.back } else { t.front };
                        let turn = libm::atan2(at.y, at.x) / opening;
                        meetings[j * radii.len() + i].push(Meeting {
                            at: turn - turn.floor(),
                            enters: after != OUTSIDE,
                        });
                    }
                }
            }
        }
        for list in &mut meetings {
            list.sort_unstable_by(|a: &Meeting, b| a.at.total_cmp(&b.at));
        }
        Self {
            radii,
            heights,
            meetings,
        }
    }

    /// How near a circle's surface is to an angle, as a share of the opening, and whether the angle is in material; `None`
    /// on circles that meet no surface.
    pub fn gap(&self, [i, j]: [usize; 2], at: f64) -> Option<(f64, bool)> {
        let list = &self.meetings[j * self.radii.len() + i];
        let after = list.partition_point(|m| m.at <= at);
        let last = list.last()?;
        let (before, wrap) = match after {
            0 => (last, 1.0),
            k => (&list[k - 1], 0.0),
        };
        let (next, ahead) = match list.get(after) {
            Some(m) => (m, 0.0),
            None => (&list[0], 1.0),
        };
        let near = (at - before.at + wrap).min(next.at + ahead - at);
        Some((near, before.enters))
    }
}

/// The segment in which a triangle meets the plane at a height.
fn level(corners: [DVec3; 3], z: f64) -> Option<[DVec2; 2]> {
    let cross = |i: usize| {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
        ((p.z < z) != (q.z < z)).then(|| p.lerp(q, (z - p.z) / (q.z - p.z)).truncate())
    };
    let mut found = (0..3).filter_map(cross);
    Some([found.next()?, found.next()?])
}

/// The points of a segment at a distance from the axis.
fn meet(p: DVec2, q: DVec2, radius: f64) -> impl Iterator<Item = DVec2> {
    let along = q - p;
    let (a, b, c) = (
        along.length_squared(),
        p.dot(along),
        p.length_squared() - radius * radius,
    );
    let root = (b * b - a * c).sqrt();
    let places = [(-b - root) / a, (-b + root) / a];
    places
        .into_iter()
        .filter(|s| (0.0..1.0).contains(s))
        .map(move |s| p + along * s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_told_from_material() {
        // A wall across the circle at 10 degrees and one at 30, material between them.
        let wall = |degrees: f64| {
            let a = degrees.to_radians();
            let out = DVec3::new(a.cos(), a.sin(), 0.0);
            [out, 3.0 * out, 3.0 * out + 2.0 * DVec3::Z]
        };
        let points = [wall(10.0), wall(30.0)].concat();
        let triangle = |vertices| Triangle {
            vertices,
            marker: 0,
            front: OUTSIDE,
            back: 1,
        };
        let triangles = [triangle([0, 1, 2]), triangle([3, 5, 4])];
        let grid = [vec![2.5, 9.0], vec![1.0]];
        let circles = Circles::new(&points, &triangles, std::f64::consts::FRAC_PI_2, grid);
        let at = |degrees: f64| circles.gap([0, 0], degrees / 90.0);
        for (degrees, near, inside) in [(15.0, 5.0, true), (35.0, 5.0, false), (80.0, 20.0, false)]
        {
            let (found, material) = at(degrees).unwrap();
            assert!(
                (90.0 * found - near).abs() < 1e-9 && material == inside,
                "{degrees}: {found}"
            );
        }
        assert_eq!(circles.gap([1, 0], 0.5), None);
    }
}
