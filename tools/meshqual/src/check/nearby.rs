//! Points by place: finds the points within a small distance of a position.

use glam::DVec3;

const NONE: u32 = u32::MAX;

/// A hash grid over points. The cells are a few times wider than the distances asked for, so that a
/// query looks at one or two of them.
pub struct Nearby<'a> {
    points: &'a [DVec3],
    low: DVec3,
    per_cell: f64,
    radius: f64,
    /// First point of each hash value, the others follow in `next`.
    heads: Vec<u32>,
    next: Vec<u32>,
}

impl<'a> Nearby<'a> {
    /// An empty grid for queries of the given radius; points are added by index.
    pub fn new(points: &'a [DVec3], radius: f64) -> Self {
        let low = points.iter().fold(DVec3::INFINITY, |m, p| m.min(*p));
        let slots = (2 * points.len()).next_power_of_two().max(2);
        // A zero radius asks for equal points: any cell size will do.
        let cell = if radius > 0.0 { 8.0 * radius } else { 1.0 };
        Self {
            points,
            low,
            per_cell: 1.0 / cell,
            radius,
            heads: vec![NONE; slots],
            next: vec![NONE; points.len()],
        }
    }

    /// A grid with all points in it.
    pub fn all(points: &'a [DVec3], radius: f64) -> Self {
        let mut grid = Self::new(points, radius);
        for i in 0..points.len() as u32 {
            grid.insert(i);
        }
        grid
    }

    fn cell(&self, p: DVec3) -> [i64; 3] {
        // Saturates for positions far off, which is as good as any other value.
        ((p - self.low) * self.per_cell)
            .to_array()
            .map(|x| x.floor() as i64)
    }

    fn slot(&self, cell: [i64; 3]) -> usize {
        let mut hash = 0_u64;
        for x in cell {
            hash = (hash.rotate_left(23) ^ x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        }
        (hash >> 32) as usize & (self.heads.len() - 1)
    }

    /// Adds a point.
    pub fn insert(&mut self, index: u32) {
        let slot = self.slot(self.cell(self.points[index as usize]));
        self.next[index as usize] = self.heads[slot];
        self.heads[slot] = index;
    }

    /// The nearest point within the radius and its distance; the one of lowest index among equals.
    /// Stops when `budget` comparisons have been made.
    pub fn nearest(&self, p: DVec3, budget: &mut u64) -> Option<(u32, f64)> {
        let mut best: Option<(f64, u32)> = None;
        let reach = DVec3::splat(self.radius);
        let [x0, y0, z0] = self.cell(p - reach);
        let [x1, y1, z1] = self.cell(p + reach);
        for x in x0..=x1 {
            for y in y0..=y1 {
                for z in z0..=z1 {
                    let mut i = self.heads[self.slot([x, y, z])];
                    while i != NONE && *budget > 0 {
                        *budget -= 1;
                        let distance = (self.points[i as usize] - p).length();
                        let better = match best {
                            None => distance <= self.radius,
                            Some(b) => (distance, i) < b,
                        };
                        if better {
                            best = Some((distance, i));
                        }
                        i = self.next[i as usize];
                    }
                }
            }
        }
        best.map(|(distance, i)| (i, distance))
    }
}

/// Calls `found(later, earlier)` for every point that lies within `radius` of an earlier one.
///
/// Points found are not looked for again, so a grid cell holds a bounded number of points and the
/// work is linear.
pub fn coincident(points: &[DVec3], radius: f64, mut found: impl FnMut(u32, u32)) {
    let mut grid = Nearby::new(points, radius);
    let mut budget = u64::MAX;
    for i in 0..points.len() as u32 {
        match grid.nearest(points[i as usize], &mut budget) {
            Some((earlier, _)) => found(i, earlier),
            None => grid.insert(i),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_neighbours_across_cells_and_no_others() {
        let radius = 1e-3;
        // Pairs half a radius apart, strewn over many cells.
        let mut points = Vec::new();
        for i in 0..500_u32 {
            let t = f64::from(i);
            let p = DVec3::new(libm::sin(t), libm::sin(2.3 * t), libm::sin(0.7 * t));
            points.push(p);
            points.push(p + DVec3::new(0.3, -0.3, 0.2) * radius);
        }
        let mut pairs = Vec::new();
        coincident(&points, radius, |i, j| pairs.push((i, j)));
        let expected: Vec<_> = (0..500).map(|i| (2 * i + 1, 2 * i)).collect();
        assert_eq!(pairs, expected);
    }

    #[test]
    fn many_equal_points_cost_no_more() {
        let points = vec![DVec3::ONE; 100_000];
        let mut count = 0;
        coincident(&points, 0.0, |_, first| {
            assert_eq!(first, 0);
            count += 1;
        });
        assert_eq!(count, 99_999);
    }

    #[test]
    fn far_positions_have_no_neighbour() {
        let points = [DVec3::ZERO, DVec3::ONE];
        let grid = Nearby::all(&points, 1e-12);
        let mut budget = 100;
        assert_eq!(grid.nearest(DVec3::splat(1e300), &mut budget), None);
        assert_eq!(grid.nearest(DVec3::ONE, &mut budget), Some((1, 0.0)));
    }
}
