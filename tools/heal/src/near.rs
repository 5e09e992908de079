//! Points that differ by rounding only.

use geom::grid::Grid;
use geom::sets::DisjointSets;
use glam::DVec3;

/// Points that each point is compared with at most. Points are near to no more than a few others, unless
/// they are crowded within the tolerance: then they are joined by way of each other, and comparing
/// each with all would take quadratic time.
const CROWD: u64 = 64;

/// Joins those of the `candidates` (increasing point ids) that lie within `tolerance` of each other in
/// every coordinate: pairs (point, the point it becomes). Linear.
pub fn near_points(points: &[DVec3], candidates: &[u32], tolerance: f64) -> Vec<(u32, u32)> {
    if tolerance <= 0.0 {
        return Vec::new();
    }
    let place = |i: u32| points[candidates[i as usize] as usize];
    // A cube reaches farther than a ball into its corners.
    let reach = 3.0_f64.sqrt() * tolerance;
    let mut grid = Grid::for_reach(reach, candidates.len());
    let mut sets = DisjointSets::new(candidates.len());
    for i in 0..candidates.len() as u32 {
        let p = place(i);
        grid.each_within_of(p, reach, &mut CROWD.clone(), |j, _| {
            if (p - place(j)).abs().max_element() <= tolerance {
                sets.join(i, j);
            }
            true
        });
        grid.insert(p);
    }
    (0..candidates.len() as u32)
        .filter_map(|i| {
            let root = sets.find(i);
            (root != i).then(|| (candidates[i as usize], candidates[root as usize]))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_points_are_joined_across_grid_cells() {
        let points = [
            DVec3::ZERO,
            DVec3::new(1e-9, -1e-9, 0.0),
            DVec3::new(1.0, 0.0, 0.0),
            DVec3::new(1.0, 0.0, 3e-9),
        ];
        assert_eq!(near_points(&points, &[0, 1, 2, 3], 2e-9), [(1, 0)]);
        assert_eq!(near_points(&points, &[2, 3], 4e-9), [(3, 2)]);
        assert!(near_points(&points, &[0, 1, 2, 3], 0.0).is_empty());
    }
}
