//! Points that differ by rounding only.

use geom::grid::coincident;
use glam::DVec3;

/// Which of the `candidates` (point ids) lie within `reach` of an earlier one that stays: pairs (point, the
/// point it becomes), so that no point moves farther than that. Linear.
pub fn near_points(points: &[DVec3], candidates: &[u32], reach: f64) -> Vec<(u32, u32)> {
    let mut pairs = Vec::new();
    let places = candidates.iter().map(|&v| points[v as usize]);
    coincident(places, reach, |later, earlier| {
        pairs.push((candidates[later as usize], candidates[earlier as usize]));
    });
    pairs
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
