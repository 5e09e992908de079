//! The part of a displacement that swings slowly around an axis: an ovality, an eccentricity, a lobe.

use crate::allowance::model::FEWEST_IN_SHELL;
use geom::eigen;

/// A constant, and cosine and sine of one to three times the angle.
const TERMS: usize = 7;
/// Places around the axis that are distinguished: two dozen to each of the shortest waves.
const PLACES: usize = 72;
/// Combinations of terms that hardly occur at the places there are, relative to the one that occurs most.
const UNSEEN: f64 = 1e-2;

/// Displacements around an axis, fitted by a few waves in the sense of least squares.
pub struct Swing {
    matrix: [[f64; TERMS]; TERMS],
    right: [f64; TERMS],
    /// Whether there are displacements near each place.
    seen: [bool; PLACES],
    count: usize,
}

impl Default for Swing {
    fn default() -> Self {
        Self {
            matrix: [[0.0; TERMS]; TERMS],
            right: [0.0; TERMS],
            seen: [false; PLACES],
            count: 0,
        }
    }
}

impl Swing {
    /// Adds a displacement at a place around the axis, a part of a turn from 0 to 1.
    pub fn add(&mut self, turn: f64, displacement: f64, weight: f64) {
        let waves = waves(turn);
        for (row, x) in self.matrix.iter_mut().zip(waves) {
            for (a, y) in row.iter_mut().zip(waves) {
                *a += weight * x * y;
            }
        }
        for (b, x) in self.right.iter_mut().zip(waves) {
            *b += weight * x * displacement;
        }
        self.seen[((turn * PLACES as f64) as usize).min(PLACES - 1)] = true;
        self.count += 1;
    }

    /// The largest size of the fit at the places where there are displacements; zero when there are few.
    pub fn largest(&self) -> f64 {
        if self.count < FEWEST_IN_SHELL {
            return 0.0;
        }
        let solution = eigen::symmetric(self.matrix);
        let most = solution.values[TERMS - 1];
        let mut fit = [0.0; TERMS];
        for (value, vector) in solution.values.iter().zip(&solution.vectors) {
            if *value > UNSEEN * most {
                let along: f64 = vector.iter().zip(&self.right).map(|(v, b)| v * b).sum();
                for (f, v) in fit.iter_mut().zip(vector) {
                    *f += along / value * v;
                }
            }
        }
        let at = |place: usize| -> f64 {
            let waves = waves((place as f64 + 0.5) / PLACES as f64);
            waves.iter().zip(&fit).map(|(w, f)| w * f).sum()
        };
        let seen = (0..PLACES).filter(|&p| self.seen[p]);
        seen.map(|p| at(p).abs()).fold(0.0, f64::max)
    }
}

fn waves(turn: f64) -> [f64; TERMS] {
    let angle = std::f64::consts::TAU * turn;
    let [(s1, c1), (s2, c2), (s3, c3)] = [1.0, 2.0, 3.0].map(|m| libm::sincos(m * angle));
    [1.0, c1, s1, c2, s2, c3, s3]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(displacement: impl Fn(f64) -> f64, turns: impl Iterator<Item = f64>) -> f64 {
        let mut swing = Swing::default();
        turns.for_each(|t| swing.add(t, displacement(t), 2.0));
        swing.largest()
    }

    #[test]
    fn an_oval_is_seen_among_facets_and_facets_alone_are_not() {
        let turns = || (0..500).map(|i| (f64::from(i) * 0.618_033_988_75).fract());
        let wave = |m: f64, t: f64| libm::cos(std::f64::consts::TAU * m * t);
        let oval = of(|t| 1.5 * wave(2.0, t) + 2.0 * wave(16.0, t), turns());
        assert!((oval - 1.5).abs() < 0.2, "{oval}");
        let facets = of(|t| 2.0 * wave(16.0, t), turns());
        assert!(facets < 0.3, "{facets}");
        // Seen on a part of a turn only, where the fit may not run away.
        let part = of(|t| wave(2.0, t), turns().map(|t| 0.2 * t));
        assert!((0.9..1.1).contains(&part), "{part}");
        assert_eq!(of(|_| 1.0, (0..10).map(f64::from)), 0.0);
    }
}
