//! Sizes that features of the body ask for, at places of its section.

use glam::DVec2;
use rustc_hash::FxHashMap;

/// A size that a feature asks for, at a place of the section.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Radius and height, model units.
    pub at: DVec2,
    /// Size, model units.
    pub size: f64,
}

/// Keeps the smallest size per square cell, of which `cells` are as wide as the section's extent (model units).
pub fn thinned(samples: Vec<Sample>, extent: f64, cells: f64) -> Vec<Sample> {
    let mut best: FxHashMap<[i64; 2], Sample> = FxHashMap::default();
    for s in samples {
        let cell = (s.at / extent * cells).floor().to_array().map(|x| x as i64);
        let entry = best.entry(cell).or_insert(s);
        if s.size < entry.size {
            *entry = s;
        }
    }
    let mut kept: Vec<_> = best.into_iter().collect();
    kept.sort_unstable_by_key(|(cell, _)| *cell);
    kept.into_iter().map(|(_, s)| s).collect()
}

/// The samples without those that another one makes useless: where sizes grow with the distance by `growth`, it
/// asks for no more at their place, and so anywhere.
pub fn useful(samples: &[Sample], growth: f64) -> Vec<Sample> {
    let mut sorted = samples.to_vec();
    sorted.sort_by(|a, b| a.size.total_cmp(&b.size));
    let mut kept: Vec<Sample> = Vec::new();
    for s in sorted {
        // Squares, to do without a root.
        let is_below = |k: &Sample| {
            let spare = s.size - k.size;
            growth * growth * k.at.distance_squared(s.at) <= spare * spare
        };
        if !kept.iter().any(is_below) {
            kept.push(s);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_that_ask_for_less_make_others_useless() {
        let growth = 0.35;
        let sample = |x: f64, size: f64| Sample {
            at: DVec2::new(x, 0.0),
            size,
        };
        let far = sample(1.0, 0.3);
        // Beside the smallest, and where it asks for no more at all.
        let useless = [sample(0.1, 0.1 + 0.2 * growth), sample(0.9, 1.0)];
        let all = [far, useless[0], sample(0.0, 0.1), useless[1], far];
        let kept: Vec<f64> = useful(&all, growth).iter().map(|s| s.size).collect();
        assert_eq!(kept, [0.1, 0.3]);
    }
}
