//! Points of a nearly symmetric body beside the mirror planes it is cut at.
//!
//! Where a body is symmetric only up to a residual, an edge of its drawing that belongs onto a mirror plane may lie
//! beside it by several times as much: along a smooth or flat surface that hardly shows. The cut would
//! leave a strip between the two, and elements as small as that.

use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::Triangle;

/// How much of a triangle's area has to be left: of a triangle across which a point slides to the middle half is,
/// and rounding and a slight turn of the triangle take some of that.
const LEFT: f64 = 0.4;

/// A half plane that begins at the axis, or a plane across it.
pub struct Plane {
    /// Unit normal; the plane goes through the origin.
    pub normal: DVec3,
    /// The side of the axis it is on; zero for both.
    pub outward: DVec3,
}

/// Moves points that are within `reach` of one plane onto it, where no face around them moves by more than
/// `most` for that, none gets much smaller, and no other plane is as near. Lengths in model units. Returns the
/// number of points moved.
pub fn slide(
    points: &mut [DVec3],
    triangles: &[Triangle],
    planes: &[Plane],
    reach: f64,
    most: f64,
) -> usize {
    let mut near: FxHashMap<u32, (usize, Vec<u32>)> = FxHashMap::default();
    for (i, p) in points.iter().enumerate() {
        let mut within = (planes.iter().enumerate())
            .filter(|(_, plane)| p.dot(plane.normal).abs() <= 2.0 * reach)
            .filter(|(_, plane)| p.dot(plane.outward) >= 0.0);
        if let (Some((k, plane)), None) = (within.next(), within.next())
            && (f64::MIN_POSITIVE..=reach).contains(&p.dot(plane.normal).abs())
        {
            near.insert(i as u32, (k, Vec::new()));
        }
    }
    if near.is_empty() {
        return 0;
    }
    for (t, triangle) in triangles.iter().enumerate() {
        for v in triangle.vertices {
            if let Some((_, around)) = near.get_mut(&v) {
                around.push(t as u32);
            }
        }
    }
    let mut near: Vec<_> = near.into_iter().collect();
    near.sort_unstable_by_key(|(v, _)| *v);
    let mut moved = 0;
    for (v, (k, around)) in near {
        let from = points[v as usize];
        let to = from - planes[k].normal * from.dot(planes[k].normal);
        let area = |t: u32, points: &[DVec3]| {
            let [a, b, c] = geom::measure::corners(points, triangles[t as usize]);
            geom::measure::double_area_vector(a, b, c)
        };
        let before: Vec<DVec3> = around.iter().map(|&t| area(t, points)).collect();
        points[v as usize] = to;
        let stays = |(&t, before): (&u32, &DVec3)| {
            let size = before.length();
            let normal = *before / size;
            size > 0.0
                && (to - from).dot(normal).abs() <= most
                && area(t, points).dot(normal) >= LEFT * size
        };
        if around.iter().zip(&before).all(stays) {
            moved += 1;
        } else {
            points[v as usize] = from;
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::OUTSIDE;

    /// Four triangles around a point beside the plane y = 0, of a roof whose ridge is `height` high.
    fn roof(y: f64, height: f64) -> (Vec<DVec3>, Vec<Triangle>) {
        let points = vec![
            DVec3::new(1.0, y, height),
            DVec3::new(2.0, 0.0, height),
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::new(0.5, 0.0, height),
            DVec3::new(1.0, -1.0, 0.0),
        ];
        let fan = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]];
        let triangle = |vertices| Triangle {
            vertices,
            marker: 1,
            front: OUTSIDE,
            back: 1,
        };
        (points, fan.map(triangle).to_vec())
    }

    #[test]
    fn points_slide_along_flat_faces_only() {
        let walls = [Plane {
            normal: DVec3::Y,
            outward: DVec3::X,
        }];
        let slid = |y: f64, height: f64| {
            let (mut points, triangles) = roof(y, height);
            let moved = slide(&mut points, &triangles, &walls, 1e-2, 1e-4);
            (moved, points[0].y)
        };
        assert_eq!(slid(5e-3, 0.0), (1, 0.0));
        assert_eq!(slid(-5e-3, 1e-3), (1, 0.0));
        // Out of reach, on a steep roof, there already.
        assert_eq!(slid(2e-2, 0.0), (0, 2e-2));
        assert_eq!(slid(5e-3, 1.0), (0, 5e-3));
        assert_eq!(slid(0.0, 0.0), (0, 0.0));
        // On the other side of the axis there is no wall.
        let (mut points, triangles) = roof(5e-3, 0.0);
        points.iter_mut().for_each(|p| p.x -= 5.0);
        assert_eq!(slide(&mut points, &triangles, &walls, 1e-2, 1e-4), 0);
    }

    #[test]
    fn two_sides_of_a_strip_do_not_meet() {
        let (mut points, triangles) = roof(5e-3, 0.0);
        points[4].y = -5e-3;
        let walls = [Plane {
            normal: DVec3::Y,
            outward: DVec3::X,
        }];
        assert_eq!(slide(&mut points, &triangles, &walls, 1e-2, 1e-4), 1);
        assert_eq!((points[0].y, points[4].y), (0.0, -5e-3));
    }
}
