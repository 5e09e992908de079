//! Welding of points that differ by rounding only.

use geom::sets::DisjointSets;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Joins those of the `candidates` (increasing point ids) that lie within `tolerance` of each other:
/// pairs (point, the point it becomes). Linear for candidates that are not crowded.
pub fn near_points(points: &[DVec3], candidates: &[u32], tolerance: f64) -> Vec<(u32, u32)> {
    if tolerance <= 0.0 {
        return Vec::new();
    }
    let cell = |p: DVec3| (p / (2.0 * tolerance)).floor().to_array().map(|x| x as i64);
    let mut sets = DisjointSets::new(candidates.len());
    // One representative set per grid cell is enough: points of a cell are joined to a point they
    // are near to, and to those of the seven neighbouring cells that the tolerance reaches.
    let mut grid: FxHashMap<[i64; 3], Vec<u32>> = FxHashMap::default();
    for (i, &v) in candidates.iter().enumerate() {
        let p = points[v as usize];
        let (low, high) = (cell(p - tolerance), cell(p + tolerance));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for &j in grid.get(&[x, y, z]).into_iter().flatten() {
                        let q = points[candidates[j as usize] as usize];
                        if (p - q).abs().max_element() <= tolerance {
                            sets.join(i as u32, j);
                            break;
                        }
                    }
                }
            }
        }
        let list = grid.entry(cell(p)).or_default();
        // Crowded cells hold points of one cluster: a few of them stand for all.
        if list.len() < 8 {
            list.push(i as u32);
        }
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
