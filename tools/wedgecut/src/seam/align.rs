//! Which points of two drawings of one curve belong together, and where each drawing gets the points
//! that only the other one has.
//!
//! All is decided by places along the curves, so that the points of both come in one order.

use crate::section::{Chain, Place, project};
use glam::DVec2;

/// A point of the common curve: where it is on either drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A point of both, by indices.
    Both(usize, usize),
    /// A point of the first alone, and its place on the second.
    First(usize, Place),
    /// A point of the second alone, and its place on the first.
    Second(usize, Place),
}

/// Where two curves are too far apart: index of the point of the first (`true`) or second one, and
/// its distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Whether the point is one of the first curve.
    pub first: bool,
    /// Its index.
    pub point: usize,
    /// Its distance from the other curve.
    pub distance: f64,
}

/// Lengths along a curve.
struct Line<'a> {
    at: &'a [DVec2],
    length: Vec<f64>,
}

impl<'a> Line<'a> {
    fn new(chain: &'a Chain) -> Self {
        let mut length = vec![0.0];
        for w in chain.at.windows(2) {
            length.push(length[length.len() - 1] + w[0].distance(w[1]));
        }
        Self {
            at: &chain.at,
            length,
        }
    }

    fn total(&self) -> f64 {
        self.length[self.length.len() - 1]
    }

    /// The edge at a length, and the share along it.
    fn place(&self, s: f64) -> Place {
        let edge = self.length.partition_point(|&l| l <= s).max(1) - 1;
        let edge = edge.min(self.at.len() - 2);
        let span = self.length[edge + 1] - self.length[edge];
        let at = match span > 0.0 {
            true => ((s - self.length[edge]) / span).clamp(0.0, 1.0),
            false => 0.0,
        };
        Place { edge, at }
    }

    fn point(&self, s: f64) -> DVec2 {
        let Place { edge, at } = self.place(s);
        self.at[edge].lerp(self.at[edge + 1], at)
    }

    /// For each point of another line, the length along this one of the nearest place that keeps the
    /// order, ends at ends.
    fn follow(&self, other: &Line<'_>, reach: f64) -> Vec<f64> {
        let mut found = vec![0.0];
        let mut low = 0.0_f64;
        for i in 1..other.at.len() - 1 {
            let step = other.length[i] - other.length[i - 1];
            let high = low + 1.5 * step + 2.0 * reach;
            let first = self.place(low).edge;
            let mut best = (f64::INFINITY, low);
            for edge in first..self.at.len() - 1 {
                if self.length[edge] > high {
                    break;
                }
                let (at, _) = project(other.at[i], self.at[edge], self.at[edge + 1]);
                let span = self.length[edge + 1] - self.length[edge];
                let s = (self.length[edge] + at * span).clamp(low, high);
                let distance = self.point(s).distance(other.at[i]);
                // Of places about as near, the one that is about as far along.
                if distance < best.0 - f64::EPSILON.sqrt() * reach {
                    best = (distance, s);
                }
            }
            low = best.1;
            found.push(low);
        }
        found.push(self.total());
        found
    }
}

/// Aligns two curves whose ends belong together.
///
/// `tolerance`: largest distance of a point from the other curve, model units.
///
/// # Errors
/// The point farthest from the other curve, if that is beyond the tolerance.
pub fn align(first: &Chain, second: &Chain, tolerance: f64) -> Result<Vec<Step>, Apart> {
    let (a, b) = (Line::new(first), Line::new(second));
    let on_b = b.follow(&a, tolerance);
    let (n, m) = (a.at.len(), b.at.len());
    let pairs = pairs(&a, &b, &on_b, tolerance);
    let mut steps = vec![Step::Both(0, 0)];
    let mut worst = Apart {
        first: true,
        point: 0,
        distance: 0.0,
    };
    let mut keep = |first: bool, point: usize, distance: f64| {
        if distance > worst.distance {
            worst = Apart {
                first,
                point,
                distance,
            };
        }
    };
    for w in pairs.windows(2) {
        let ([i, j], [k, l]) = (w[0], w[1]);
        // Both in one order, by the length along the second.
        let along = |p: usize| match p {
            p if p == i => b.length[j],
            p if p == k => b.length[l],
            p => on_b[p].clamp(b.length[j], b.length[l]),
        };
        let share = |x: f64, from: f64, to: f64| match to > from {
            true => ((x - from) / (to - from)).clamp(0.0, 1.0),
            false => 0.5,
        };
        let (mut p, mut q) = (i, j);
        while p + 1 < k || q + 1 < l {
            let of_first = q + 1 == l || p + 1 < k && along(p + 1) <= b.length[q + 1];
            if of_first {
                p += 1;
                let at = share(along(p), b.length[q], b.length[q + 1]);
                keep(true, p, b.at[q].lerp(b.at[q + 1], at).distance(a.at[p]));
                steps.push(Step::First(p, Place { edge: q, at }));
            } else {
                q += 1;
                let at = share(b.length[q], along(p), along(p + 1));
                keep(false, q, a.at[p].lerp(a.at[p + 1], at).distance(b.at[q]));
                steps.push(Step::Second(q, Place { edge: p, at }));
            }
        }
        keep(true, k, a.at[k].distance(b.at[l]));
        steps.push(Step::Both(k, l));
    }
    debug_assert_eq!(pairs.last(), Some(&[n - 1, m - 1]));
    spread(&mut steps, &a, &b, tolerance);
    match worst.distance > tolerance {
        true => Err(worst),
        false => Ok(steps),
    }
}

/// Points that belong together, increasing in both: ends, and others that are each other's nearest along the curves.
fn pairs(a: &Line<'_>, b: &Line<'_>, on_b: &[f64], tolerance: f64) -> Vec<[usize; 2]> {
    let ends = [[0, 0], [a.at.len() - 1, b.at.len() - 1]];
    let (own, other) = (1..ends[1][0], 1..ends[1][1]);
    let [own_at, other_at] = [&on_b[own.clone()], &b.length[other.clone()]];
    let (to, back) = (nearest(own_at, other_at), nearest(other_at, own_at));
    let inner = own.filter_map(|i| {
        let y = to[i - 1].filter(|&y| back[y] == Some(i - 1))?;
        let j = y + 1;
        let along = (on_b[i] - b.length[j]).abs();
        (along.max(a.at[i].distance(b.at[j])) <= tolerance).then_some([i, j])
    });
    let mut found = vec![ends[0]];
    found.extend(inner);
    found.push(ends[1]);
    found
}

/// For each of some increasing values, the index of the nearest of others, which increase too.
fn nearest(values: &[f64], others: &[f64]) -> Vec<Option<usize>> {
    let nearest = |x: &f64| {
        let after = others.partition_point(|y| y < x);
        let around = after.saturating_sub(1)..(after + 1).min(others.len());
        around.min_by(|&i, &j| (others[i] - x).abs().total_cmp(&(others[j] - x).abs()))
    };
    values.iter().map(nearest).collect()
}

/// Keeps points that one edge gets apart from each other and from its ends, without moving them by
/// more than `reach` for each.
fn spread(steps: &mut [Step], a: &Line<'_>, b: &Line<'_>, reach: f64) {
    for first in [true, false] {
        let mut of_edge: Vec<&mut Place> = (steps.iter_mut())
            .filter_map(|step| match step {
                Step::First(_, place) if first => Some(place),
                Step::Second(_, place) if !first => Some(place),
                _ => None,
            })
            .collect();
        for group in of_edge.chunk_by_mut(|p, q| p.edge == q.edge) {
            let count = group.len() as f64;
            let line = if first { b } else { a };
            let edge = group[0].edge;
            let length = line.length[edge + 1] - line.length[edge];
            let gap = (reach / length.max(f64::MIN_POSITIVE)).min(1.0) / (count + 1.0);
            let mut least = gap;
            for place in group.iter_mut() {
                place.at = place.at.max(least);
                least = place.at + gap;
            }
            let mut most = 1.0 - gap;
            for place in group.iter_mut().rev() {
                place.at = place.at.min(most);
                most = place.at - gap;
            }
        }
    }
}
