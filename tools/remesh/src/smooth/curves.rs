//! Curves that the edges of facets are chords of.

use super::sheets::{Reading, Sheets};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// How the curve leaves its chord, as a part of it goes by from 0 to 1: by `t (1 - t) ((1 - t) b[0] + t b[1])`, model units.
pub type Bow = [DVec3; 2];

/// Straight.
pub const STRAIGHT: Bow = [DVec3::ZERO; 2];

/// Unit tangents of feature curves.
#[derive(Default)]
pub struct Tangents {
    /// By the vertex that it is at, and the one to which the edge leads.
    at: FxHashMap<[u32; 2], DVec3>,
}

impl Tangents {
    /// Of two feature edges at a vertex that turn by least, each of all beside the other, and by less than the feature angle, the
    /// tangent is that of the circle through their ends. Linear.
    pub fn new(sheets: &Sheets<'_>, is_feature: impl Fn(usize) -> bool, reading: Reading) -> Self {
        let mut ends: Vec<[u32; 2]> = Vec::new();
        for edge in (0..sheets.edges.len()).filter(|e| is_feature(*e)) {
            let [a, b] = sheets.edges.ends[edge];
            ends.extend([[a, b], [b, a]]);
        }
        ends.sort_unstable();
        let mut at = FxHashMap::default();
        for fan in ends.chunk_by(|s, t| s[0] == t[0]) {
            let here = sheets.points[fan[0][0] as usize];
            let away = |i: usize| sheets.points[fan[i][1] as usize] - here;
            let cosine = |i: usize, j: usize| {
                let (a, b) = (away(i).normalize_or_zero(), away(j).normalize_or_zero());
                -a.dot(b)
            };
            let best = |i: usize| {
                let others = (0..fan.len()).filter(|j| *j != i);
                others.fold(None, |best: Option<usize>, j| match best {
                    Some(k) if cosine(i, j) <= cosine(i, k) => best,
                    _ => Some(j),
                })
            };
            for (i, &ends) in fan.iter().enumerate() {
                let Some(j) = best(i).filter(|j| best(*j) == Some(i)) else {
                    continue;
                };
                if cosine(i, j) > reading.feature {
                    let (a, b) = (away(i), away(j));
                    let tangent = a / a.length_squared() - b / b.length_squared();
                    at.insert(ends, tangent.normalize_or_zero());
                }
            }
        }
        Self { at }
    }

    /// The tangent at a vertex of a feature edge to another one, leading there.
    pub fn at(&self, vertex: u32, other: u32) -> Option<DVec3> {
        self.at.get(&[vertex, other]).copied()
    }

    /// The curve of a feature edge. Where it ends at one of its corners it bends there as at the other one.
    pub fn bow(&self, sheets: &Sheets<'_>, [a, b]: [u32; 2]) -> Bow {
        let [p, q] = [a, b].map(|v| sheets.points[v as usize]);
        let along = (q - p).normalize_or_zero();
        let across = |t: DVec3| t - along * t.dot(along);
        // Both lead from a to b.
        let (m, n) = (self.at(a, b), self.at(b, a).map(|t| -t));
        let mirrored = |t: DVec3| along * t.dot(along) - across(t);
        let (m, n) = match (m, n) {
            (Some(m), Some(n)) => (m, n),
            (Some(m), None) => (m, mirrored(m)),
            (None, Some(n)) => (mirrored(n), n),
            (None, None) => return STRAIGHT,
        };
        let length = p.distance(q) / arc(m.dot(n));
        limited([across(m) * length, -across(n) * length])
    }
}

/// The largest ratio of what a curve bends by at its ends. A choice, usual for slopes that are not to overshoot (van Leer, 1979):
/// on a smooth shape both are alike, the more so the shorter the edge, and where they are not one of them is wrong.
const ALIKE: f64 = 2.0;

/// A curve that bends at each end at most so many times as much as at the other, and not at all where they disagree.
pub fn limited([low, high]: Bow) -> Bow {
    if low.dot(high) <= 0.0 {
        return STRAIGHT;
    }
    let most = ALIKE * low.length().min(high.length());
    [low.clamp_length_max(most), high.clamp_length_max(most)]
}

/// The squared cosine of a quarter of the angle between directions at the ends of a chord, whose cosine is given: an arc is
/// higher than a parabola with these slopes by its reciprocal.
pub fn arc(cosine: f64) -> f64 {
    // cos x = 2 cos^2 (x / 2) - 1, twice.
    let half = (0.5 * (1.0 + cosine.clamp(-1.0, 1.0))).sqrt();
    0.5 * (1.0 + half)
}
