//! Polygons that need not be planar or convex, broken into triangles.

use super::plane::{Projection, area_vector};
use geom::cdt::triangulate_enclosed;
use glam::DVec3;

/// Triangles of a polygon whose corners are distinct points by id, but for neighbours that were the same
/// point of the file and are left out. No triangles where fewer than three corners are left.
pub fn triangles_of(points: &[DVec3], corners: &[u32]) -> Vec<[u32; 3]> {
    let mut corners = corners.to_vec();
    corners.dedup();
    while corners.len() > 1 && corners[0] == corners[corners.len() - 1] {
        corners.pop();
    }
    match *corners.as_slice() {
        [] | [_] | [_, _] => Vec::new(),
        [a, b, c] => vec![[a, b, c]],
        [a, b, c, d] => quadrilateral(points, [a, b, c, d]).to_vec(),
        _ => planar(points, &corners).unwrap_or_else(|| {
            // A fan keeps the boundary whatever the shape.
            let fan = corners[1..].windows(2);
            fan.map(|w| [corners[0], w[0], w[1]]).collect()
        }),
    }
}

/// Splits along the shorter diagonal that leaves both triangles facing the polygon's way.
fn quadrilateral(points: &[DVec3], [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let normal = area_vector(points, &[a, b, c, d]);
    let at = |v: u32| points[v as usize];
    let splits = [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]];
    let good = |split: &[[u32; 3]; 2]| {
        split.iter().all(|t| {
            let [p, q, r] = t.map(at);
            (q - p).cross(r - p).dot(normal) > 0.0
        })
    };
    let length = |p: u32, q: u32| (at(p) - at(q)).length_squared();
    match (good(&splits[0]), good(&splits[1])) {
        (true, true) if length(b, d) < length(a, c) => splits[1],
        (false, true) => splits[1],
        _ => splits[0],
    }
}

/// Triangulates a polygon in its plane; `None` when it crosses itself there.
fn planar(points: &[DVec3], corners: &[u32]) -> Option<Vec<[u32; 3]>> {
    let project = Projection::along(area_vector(points, corners))?;
    let flat: Vec<[f64; 2]> = corners
        .iter()
        .map(|&v| project.flat(points[v as usize]))
        .collect();
    let n = corners.len() as u32;
    let loop_: Vec<[u32; 2]> = (0..n).map(|i| [i, (i + 1) % n]).collect();
    let triangles = triangulate_enclosed(&flat, &loop_, &[]).ok()?;
    // Fewer where a corner lies on another edge: the boundary would be lost.
    (triangles.len() as u32 == n - 2).then(|| {
        triangles
            .into_iter()
            .map(|t| t.map(|i| corners[i as usize]))
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::welded::welded;

    fn broken(corners: &[[f64; 3]]) -> (f64, usize) {
        let (points, ids) = welded(corners.iter().map(|&c| DVec3::from(c)), 8);
        let triangles = triangles_of(&points, &ids);
        let area = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| points[v as usize]);
                0.5 * (b - a).cross(c - a).y
            })
            .sum();
        (area, triangles.len())
    }

    #[test]
    fn concave_polygons_keep_their_area() {
        // In the plane y = 1, counter-clockwise seen from larger y.
        let dart = [
            [0.0, 1.0, 0.0],
            [1.0, 1.0, 1.0],
            [0.0, 1.0, -4.0],
            [-1.0, 1.0, 1.0],
        ];
        let (area, n) = broken(&dart);
        assert_eq!((area.abs(), n), (4.0, 2));
        let l = [
            [0.0, 1.0, 0.0],
            [0.0, 1.0, 3.0],
            [1.0, 1.0, 3.0],
            [1.0, 1.0, 1.0],
            [3.0, 1.0, 1.0],
            [3.0, 1.0, 0.0],
        ];
        assert_eq!(broken(&l), (5.0, 4));
    }

    #[test]
    fn repeated_corners_are_left_out() {
        let square = [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
        ];
        assert_eq!(broken(&square), (1.0, 2));
    }
}
