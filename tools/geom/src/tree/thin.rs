//! Long and thin triangles, cut into pieces with boxes of their own.

use super::boxes::Bounds;
use glam::DVec3;

/// What counts as long and thin; a choice of time and memory only. The box of such a triangle, if it is oblique, is nearly empty, and where
/// many of them meet in a point each place is in the boxes of all; boxes of pieces are smaller.
pub struct Thin {
    /// Pieces per unit of half a box's surface over twice the triangle's area; zero for none.
    rate: f64,
}

impl Thin {
    /// Pieces of a triangle, at most.
    const MOST: usize = 16;
    /// Half a box's surface over twice the area of a triangle that is not thin, at most.
    const COMPACT: f64 = 3.0;
    /// Shorter triangles, in units of half the set's size, are left whole.
    const SHORT: f64 = 1.0 / 32.0;
    /// Pieces there may be beyond two for each triangle.
    const SPARE: usize = 1 << 16;

    /// Chooses a rate by which triangles are not cut into too many pieces.
    pub fn new(triangles: &[[DVec3; 3]]) -> Self {
        let mut thin = Self {
            rate: 1.0 / Self::COMPACT,
        };
        // Fewer for each where most triangles are thin.
        while thin.rate > 1e-6 {
            let pieces: usize = triangles.iter().map(|t| thin.pieces(t)).sum();
            if pieces <= 2 * triangles.len() + Self::SPARE {
                return thin;
            }
            thin.rate *= 0.25;
        }
        thin.rate = 0.0;
        thin
    }

    fn pieces(&self, t: &[DVec3; 3]) -> usize {
        let bounds = Bounds::of(t);
        let extent = (bounds.high - bounds.low).max_element();
        let area = (t[1] - t[0]).cross(t[2] - t[0]).length();
        let pieces = self.rate * bounds.half_area() / area;
        match pieces.is_finite() && extent > Self::SHORT {
            true => (pieces as usize).clamp(1, Self::MOST),
            false => 1,
        }
    }

    /// Gives the boxes of the pieces of a triangle, cut across its longest side.
    pub fn for_each_piece(&self, t: &[DVec3; 3], mut visit: impl FnMut(Bounds)) {
        let count = self.pieces(t);
        if count == 1 {
            return visit(Bounds::of(t));
        }
        let longest = (0..3).max_by(|&i, &j| {
            let square = |i: usize| (t[(i + 1) % 3] - t[i]).length_squared();
            square(i).total_cmp(&square(j))
        });
        let i = longest.unwrap_or(0);
        let (a, b, c) = (t[i], t[(i + 1) % 3], t[(i + 2) % 3]);
        let along = b - a;
        // Where the apex is, as a part of the longest side; between 0 and 1 but for rounding.
        let apex = ((c - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let on_base = |x: f64| a + along * x;
        let on_sides = |x: f64| match x < apex {
            true => a + (c - a) * (x / apex),
            false => b + (c - b) * ((1.0 - x) / (1.0 - apex)),
        };
        for k in 0..count {
            let [low, high] = [k, k + 1].map(|k| k as f64 / count as f64);
            let mut bounds = Bounds::EMPTY;
            for x in [low, high] {
                bounds = bounds.with(on_base(x));
                let q = on_sides(x);
                bounds = bounds.with(if q.is_finite() { q } else { c });
            }
            if (low..=high).contains(&apex) {
                bounds = bounds.with(c);
            }
            visit(bounds);
        }
    }
}
