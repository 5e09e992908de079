//! Making exact what the input's number format left nearly so.
//!
//! A rotated or single-precision file has no two points at exactly the same height, and no wall
//! exactly upright; TetGen then fails on bodies it meshes at once when they are exact. Heights, and
//! positions seen along the axis, that differ by no more than the precision of the input are made
//! equal.

use geom::grid::Grid;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// Makes nearly equal heights equal, then nearly equal (x, y) equal. Returns the largest movement.
///
/// `reach`: span up to which values count as equal, model units. Groups that are not clearly apart
/// from others (as on finely meshed curved faces) are left alone.
pub fn snap_heights_and_columns(points: &mut [DVec3], reach: f64) -> f64 {
    let before = points.to_vec();
    snap_levels(points, 2, reach);
    snap_columns(points, reach);
    largest_movement(points, &before)
}

/// Makes nearly equal x equal, and nearly equal y, where walls along the axis may be that lie along the frame. Returns the
/// largest movement.
pub fn snap_walls(points: &mut [DVec3], reach: f64) -> f64 {
    let before = points.to_vec();
    snap_levels(points, 0, reach);
    snap_levels(points, 1, reach);
    largest_movement(points, &before)
}

fn largest_movement(points: &[DVec3], before: &[DVec3]) -> f64 {
    (points.iter().zip(before))
        .map(|(p, q)| p.distance(*q))
        .fold(0.0, f64::max)
}

/// Makes coordinates along an axis equal.
fn snap_levels(points: &mut [DVec3], axis: usize, reach: f64) {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    let level = |points: &[DVec3], v: u32| points[v as usize][axis];
    order.sort_unstable_by(|&i, &j| {
        level(points, i)
            .total_cmp(&level(points, j))
            .then(i.cmp(&j))
    });
    let mut start = 0;
    for i in 1..=order.len() {
        let apart =
            i == order.len() || level(points, order[i]) - level(points, order[i - 1]) > reach;
        if !apart {
            continue;
        }
        let group = &order[start..i];
        start = i;
        let (low, high) = (
            level(points, group[0]),
            level(points, group[group.len() - 1]),
        );
        if group.len() > 1 && high - low <= reach && high > low {
            let offset: f64 = group.iter().map(|&v| level(points, v) - low).sum();
            let mean = low + offset / group.len() as f64;
            group.iter().for_each(|&v| points[v as usize][axis] = mean);
        }
    }
}

fn snap_columns(points: &mut [DVec3], reach: f64) {
    let plane = |p: DVec3| DVec2::new(p.x, p.y);
    let mut grid = Grid::for_reach(reach, points.len());
    // The points in the grid, each of which leads those near to it that come later.
    let mut leaders: Vec<u32> = Vec::new();
    let mut leader: Vec<u32> = Vec::with_capacity(points.len());
    for i in 0..points.len() as u32 {
        let p = plane(points[i as usize]);
        let mut near: Option<u32> = None;
        grid.each_within(p, reach, |j, _| {
            near = Some(near.map_or(j, |k| k.min(j)));
            true
        });
        if near.is_none() {
            grid.insert(p);
            leaders.push(i);
        }
        leader.push(near.map_or(i, |j| leaders[j as usize]));
    }
    let mut sums: FxHashMap<u32, (DVec2, u32)> = FxHashMap::default();
    for (p, &l) in points.iter().zip(&leader) {
        let sum = sums.entry(l).or_default();
        sum.0 += plane(*p) - plane(points[l as usize]);
        sum.1 += 1;
    }
    let target: Vec<DVec2> = leader
        .iter()
        .map(|l| {
            let (sum, count) = sums[l];
            plane(points[*l as usize]) + sum / f64::from(count)
        })
        .collect();
    for (p, t) in points.iter_mut().zip(target) {
        (p.x, p.y) = (t.x, t.y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noisy_prisms_become_exact_and_dense_values_stay() {
        let mut points = Vec::new();
        for k in 0..12 {
            let a = f64::from(k) * 0.5;
            for z in [0.0, 0.3, 1.0] {
                let noise = 1e-8 * f64::from(k % 5);
                points.push(DVec3::new(a.cos() + noise, a.sin() - noise, z + noise));
            }
        }
        let moved = snap_heights_and_columns(&mut points, 1e-7);
        assert!(moved > 0.0 && moved < 1e-7);
        for k in 0..12 {
            for j in 0..3 {
                assert_eq!(points[3 * k + j].z, points[j].z);
                assert_eq!(points[3 * k + j].x, points[3 * k].x);
                assert_eq!(points[3 * k + j].y, points[3 * k].y);
            }
        }
        // Steps of half the reach over a long range: no plane to speak of.
        let dense: Vec<DVec3> = (0..100)
            .map(|i| DVec3::new(f64::from(i), 0.0, 5e-8 * f64::from(i)))
            .collect();
        let mut same = dense.clone();
        snap_heights_and_columns(&mut same, 1e-7);
        assert_eq!(same, dense);
    }
}
