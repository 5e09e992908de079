//! Points by place, in two or three dimensions.

/// No further point in a list.
const NONE: u32 = u32::MAX;

/// A hashed grid over points of `N` coordinates. Points have the numbers 0, 1, ... in the order in which
/// they are added.
///
/// Cells are centred on multiples of their width, so that round coordinates, such as those of points on
/// coordinate planes, are in the middle of a cell and not at its border.
pub struct Grid<const N: usize> {
    points: Vec<[f64; N]>,
    cells_per_length: f64,
    /// Newest point of each hash value, a power of two of them; the others follow in `next`.
    heads: Vec<u32>,
    next: Vec<u32>,
}

impl<const N: usize> Grid<N> {
    /// An empty grid with cells of a given width, model units, positive; `expected` points at about.
    pub fn new(width: f64, expected: usize) -> Self {
        Self {
            points: Vec::with_capacity(expected),
            cells_per_length: 1.0 / width,
            heads: vec![NONE; (2 * expected).next_power_of_two().max(16)],
            next: Vec::with_capacity(expected),
        }
    }

    /// An empty grid for questions about points up to `reach` apart, model units; a reach of zero asks for
    /// equal points.
    pub fn for_reach(reach: f64, expected: usize) -> Self {
        // As wide as what is asked about, which so is in two cells along each axis. Equal points are in one cell, whatever
        // its width.
        let width = if reach > 0.0 { 2.0 * reach } else { 1.0 };
        Self::new(width, expected)
    }

    /// A grid with these points for questions about points up to `reach` apart.
    pub fn of<P: Into<[f64; N]>>(points: impl ExactSizeIterator<Item = P>, reach: f64) -> Self {
        let mut grid = Self::for_reach(reach, points.len());
        for p in points {
            grid.insert(p);
        }
        grid
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Adds a point and returns its number.
    pub fn insert(&mut self, point: impl Into<[f64; N]>) -> u32 {
        if 2 * self.points.len() >= self.heads.len() {
            self.grow();
        }
        let point = point.into();
        let slot = self.slot(self.cell(point));
        let number = self.points.len() as u32;
        self.points.push(point);
        self.next.push(self.heads[slot]);
        self.heads[slot] = number;
        number
    }

    /// Calls `visit` with the number and the distance of every point within a distance of a place until it
    /// returns false. The order is the same in every run; a point may come twice where the lists of
    /// two cells are one.
    pub fn each_within(
        &self,
        place: impl Into<[f64; N]>,
        within: f64,
        visit: impl FnMut(u32, f64) -> bool,
    ) {
        self.each_within_of(place, within, &mut u64::MAX.clone(), visit);
    }

    /// The same; the search ends when as many points as `looked_at` says have been compared, which is counted down.
    pub fn each_within_of(
        &self,
        place: impl Into<[f64; N]>,
        within: f64,
        looked_at: &mut u64,
        mut visit: impl FnMut(u32, f64) -> bool,
    ) {
        let place = place.into();
        let low = self.cell(place.map(|x| x - within));
        let high = self.cell(place.map(|x| x + within));
        let mut cell = low;
        loop {
            let mut at = self.heads[self.slot(cell)];
            while at != NONE && *looked_at > 0 {
                *looked_at -= 1;
                let distance = distance(&self.points[at as usize], &place);
                if distance <= within && !visit(at, distance) {
                    return;
                }
                at = self.next[at as usize];
            }
            let Some(axis) = (0..N).find(|&k| cell[k] < high[k]) else {
                return;
            };
            cell[..axis].copy_from_slice(&low[..axis]);
            cell[axis] += 1;
        }
    }

    /// The nearest point within a distance of a place, and its distance; of equally near ones the first.
    pub fn nearest(&self, place: impl Into<[f64; N]>, within: f64) -> Option<(u32, f64)> {
        self.nearest_of(place, within, &mut u64::MAX.clone())
    }

    /// The same; the search ends when as many points as `looked_at` says have been compared, which is
    /// counted down.
    pub fn nearest_of(
        &self,
        place: impl Into<[f64; N]>,
        within: f64,
        looked_at: &mut u64,
    ) -> Option<(u32, f64)> {
        let mut best: Option<(f64, u32)> = None;
        self.each_within_of(place, within, looked_at, |point, distance| {
            if best.is_none_or(|b| (distance, point) < b) {
                best = Some((distance, point));
            }
            true
        });
        best.map(|(distance, point)| (point, distance))
    }

    fn cell(&self, p: [f64; N]) -> [i64; N] {
        // Saturates far off, where all points are in one cell.
        p.map(|x| (x * self.cells_per_length).round() as i64)
    }

    fn slot(&self, cell: [i64; N]) -> usize {
        let mut hash = 0_u64;
        for x in cell {
            // Fibonacci hashing: multiplication by 2^64 over the golden ratio.
            hash = (hash.rotate_left(23) ^ x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        }
        (hash >> 32) as usize & (self.heads.len() - 1)
    }

    /// Doubles the number of lists.
    fn grow(&mut self) {
        self.heads = vec![NONE; 2 * self.heads.len()];
        for i in 0..self.points.len() {
            let slot = self.slot(self.cell(self.points[i]));
            self.next[i] = self.heads[slot];
            self.heads[slot] = i as u32;
        }
    }
}

fn distance<const N: usize>(p: &[f64; N], q: &[f64; N]) -> f64 {
    let squares = p.iter().zip(q).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

/// Calls `found(later, earlier)` for every point that lies within `reach` of an earlier one, with the
/// nearest such one that is not found itself. So a cell holds a bounded number of points, and the work is linear.
pub fn coincident<const N: usize, P: Into<[f64; N]>>(
    points: impl ExactSizeIterator<Item = P>,
    reach: f64,
    mut found: impl FnMut(u32, u32),
) {
    let mut grid = Grid::for_reach(reach, points.len());
    let mut number = Vec::new();
    for (i, p) in (0..).zip(points) {
        let p = p.into();
        match grid.nearest(p, reach) {
            Some((earlier, _)) => found(i, number[earlier as usize]),
            None => {
                grid.insert(p);
                number.push(i);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};

    #[test]
    fn finds_neighbours_across_cells_and_no_others() {
        let reach = 1e-3;
        // Pairs half a reach apart, strewn over many cells.
        let mut points = Vec::new();
        for i in 0..500_u32 {
            let t = f64::from(i);
            let p = DVec3::new(libm::sin(t), libm::sin(2.3 * t), libm::sin(0.7 * t));
            points.push(p);
            points.push(p + DVec3::new(0.3, -0.3, 0.2) * reach);
        }
        let mut pairs = Vec::new();
        coincident(points.iter().copied(), reach, |i, j| pairs.push((i, j)));
        let expected: Vec<_> = (0..500).map(|i| (2 * i + 1, 2 * i)).collect();
        assert_eq!(pairs, expected);
    }

    #[test]
    fn the_nearest_is_that_of_a_search_through_all() {
        let place = |i: u32| {
            let t = f64::from(i);
            DVec2::new(libm::sin(t), libm::sin(2.3 * t))
        };
        // Begins small and grows.
        let mut grid = Grid::new(0.03, 0);
        (0..2000).for_each(|i| assert_eq!(grid.insert(place(i)), i));
        for within in [0.004, 0.03, 0.2] {
            for i in 0..300 {
                let p = place(i) * 0.7 + 0.01;
                let all = (0..2000).map(|j| (place(j).distance(p), j));
                let best = all.min_by(|a, b| a.0.total_cmp(&b.0));
                let best = best.filter(|b| b.0 <= within).map(|(d, j)| (j, d));
                assert_eq!(grid.nearest(p, within), best);
            }
        }
    }

    #[test]
    fn of_equally_near_points_the_first_is_found() {
        let points = [DVec2::X, -DVec2::X, DVec2::Y, DVec2::X];
        let grid = Grid::of(points.into_iter(), 2.0);
        assert_eq!(grid.nearest(DVec2::ZERO, 2.0), Some((0, 1.0)));
        assert_eq!(grid.nearest(DVec2::new(1.0, 0.0), 0.0), Some((0, 0.0)));
    }

    #[test]
    fn many_equal_points_cost_no_more() {
        let points = vec![DVec3::ONE; 100_000];
        let mut count = 0;
        coincident(points.into_iter(), 0.0, |_, first| {
            assert_eq!(first, 0);
            count += 1;
        });
        assert_eq!(count, 99_999);
    }

    #[test]
    fn far_positions_have_no_neighbour() {
        let reach = 1e-12;
        let grid = Grid::of([DVec3::ZERO, DVec3::ONE].into_iter(), reach);
        let mut budget = 100;
        let far = DVec3::splat(1e300);
        assert_eq!(grid.nearest_of(far, reach, &mut budget), None);
        let found = grid.nearest_of(DVec3::ONE, reach, &mut budget);
        assert_eq!(found, Some((1, 0.0)));
    }

    #[test]
    fn a_search_ends_with_its_budget() {
        let grid = Grid::of(vec![DVec3::ONE; 50].into_iter(), 0.0);
        let mut budget = 20;
        let found = grid.nearest_of(DVec3::ONE, 0.0, &mut budget);
        assert_eq!((found, budget), (Some((30, 0.0)), 0));
    }
}
