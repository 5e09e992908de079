//! How much of a body wants elements of which size: integrals over its section.
//!
//! The section's triangles are halved until they are no larger than the elements wanted there, each piece
//! with the samples of sizes that matter in it. Within a piece as large as an element, sizes vary by their growth;
//! near the axis pieces are as small as to let the width of a wedge vary by no more.

use crate::sum::classes::{Classes, RESOLUTION, SIZES};
use crate::sum::piece::Piece;
use crate::sum::samples::{Sample, useful};
use glam::DVec2;
use rayon::prelude::*;
use std::ops::Range;

/// A triangle of the section.
pub struct Part {
    /// Radius and height of its corners, model units.
    pub corners: [DVec2; 3],
    /// Largest size of elements in it, model units.
    pub cap: f64,
    /// Share of the section, where there are several of the same body.
    pub weight: f64,
}

/// What is summed over the section.
#[derive(Clone)]
pub struct Integral {
    /// Body volume of each class of radius and size.
    pub volume: Vec<[f64; SIZES]>,
    /// For each class of radius, the section's area over the square of the size, where the size is one
    /// that was asked for.
    pub walls: Vec<f64>,
    /// For each class of radius, how far the section reaches above the plane z = 0.
    pub heights: Vec<f64>,
}

impl Integral {
    fn zero() -> Self {
        Self {
            volume: vec![[0.0; SIZES]; RESOLUTION],
            walls: vec![0.0; RESOLUTION],
            heights: vec![0.0; RESOLUTION],
        }
    }

    /// Over all parts of a section, with the sizes that samples ask for, which grow with the distance from them by
    /// `growth`. Does not depend on the number of threads.
    pub fn over(
        parts: &[Part],
        samples: &[Sample],
        growth: f64,
        classes: Classes,
        threads: usize,
    ) -> Self {
        let samples = useful(samples, growth);
        // Groups of triangles are summed on their own, so that sums do not depend on the number of threads: as many
        // groups as triangles in each, so that neither the sums nor what is left to the last thread is much.
        let groups = parts.len().isqrt();
        let of_group = |group: usize| {
            let mut sums = Self::zero();
            let mut near = Near::new(&samples, growth, classes.extent);
            for part in parts.iter().skip(group).step_by(groups) {
                sums.add_part(part, &mut near, classes);
            }
            sums
        };
        let groups = 0..groups;
        // Where no thread is to be had, it goes without.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.min(groups.len()));
        let sums: Vec<Self> = match pool.build() {
            Ok(pool) if threads > 1 => {
                pool.install(|| groups.into_par_iter().map(of_group).collect())
            }
            _ => groups.map(of_group).collect(),
        };
        let mut sums = sums.into_iter();
        let mut all = sums.next().unwrap_or_else(Self::zero);
        sums.for_each(|s| all.add(&s));
        all
    }

    fn add(&mut self, other: &Self) {
        for (row, more) in self.volume.iter_mut().zip(&other.volume) {
            row.iter_mut().zip(more).for_each(|(v, more)| *v += more);
        }
        let walls = self.walls.iter_mut().zip(&other.walls);
        walls.for_each(|(w, more)| *w += more);
        let heights = self.heights.iter_mut().zip(&other.heights);
        heights.for_each(|(h, other)| *h = h.max(*other));
    }

    fn add_part(&mut self, part: &Part, near: &mut Near, classes: Classes) {
        let finest = classes.width();
        // The samples that matter in a piece on the stack are a run of `near`; runs of those above it on
        // the stack lie behind it.
        let mut stack = vec![(Piece::Triangle(part.corners), 0..near.all)];
        while let Some((piece, run)) = stack.pop() {
            near.len = run.end;
            let middle = piece.middle();
            let size = near.ask(run.clone(), middle).min(part.cap);
            let wanted = size.min(near.growth * middle.x).max(finest);
            let corners = piece.corners().iter();
            if piece.longest() <= wanted * wanted {
                let area = piece.area() * part.weight;
                let radius = classes.of_radius(middle.x);
                let volume = std::f64::consts::TAU * middle.x * area;
                self.volume[radius][classes.of_size(size)] += volume;
                let top = corners.fold(0.0_f64, |m, p| m.max(p.y.abs()));
                self.heights[radius] = self.heights[radius].max(top);
                if size == part.cap {
                    self.walls[radius] += area / (size * size);
                }
                continue;
            }
            // Samples that can matter somewhere in the piece.
            let reach = corners.map(|p| p.distance_squared(middle));
            let reach = reach.fold(0.0_f64, f64::max).sqrt();
            let kept = near.keep(run, size + 2.0 * near.growth * reach);
            let [first, second] = piece.halves();
            stack.push((first, kept.clone()));
            stack.push((second, kept));
        }
    }
}

/// Samples, coordinate by coordinate, and further copies of some of them behind; in single precision, which is
/// more than an estimate needs and takes half the time. Lengths are in units of the section's extent, since
/// single precision does not hold those of every model.
struct Near {
    all: usize,
    len: usize,
    /// Model units.
    extent: f64,
    growth: f64,
    /// Radius and height.
    x: Vec<f32>,
    y: Vec<f32>,
    size: Vec<f32>,
    /// What the samples last looked at ask for at the place they were asked about.
    asked: Vec<f32>,
}

impl Near {
    fn new(samples: &[Sample], growth: f64, extent: f64) -> Self {
        let all = |value: fn(&Sample) -> f64| {
            let relative = samples.iter().map(|s| (value(s) / extent) as f32);
            relative.collect()
        };
        Self {
            all: samples.len(),
            len: samples.len(),
            extent,
            growth,
            x: all(|s| s.at.x),
            y: all(|s| s.at.y),
            size: all(|s| s.size),
            asked: vec![0.0; samples.len()],
        }
    }

    /// The smallest size that a run of samples asks for at a place, model units.
    fn ask(&mut self, run: Range<usize>, at: DVec2) -> f64 {
        let at = (at / self.extent).as_vec2();
        let growth = self.growth as f32;
        let asked = &mut self.asked[..run.len()];
        let (x, y) = (&self.x[run.clone()], &self.y[run.clone()]);
        let size = &self.size[run];
        for (((asked, x), y), size) in asked.iter_mut().zip(x).zip(y).zip(size) {
            let (dx, dy) = (x - at.x, y - at.y);
            *asked = size + growth * (dx * dx + dy * dy).sqrt();
        }
        // Plain comparisons become single instructions; nothing here is NaN.
        let least = |m: f32, a: &f32| if *a < m { *a } else { m };
        f64::from(asked.iter().fold(f32::INFINITY, least)) * self.extent
    }

    /// Copies those of a run that asked for no more than `most` behind all others, and says where; leaves them
    /// where they are if that are three quarters or more, which is less work than to copy them.
    fn keep(&mut self, run: Range<usize>, most: f64) -> Range<usize> {
        let most = (most / self.extent) as f32;
        let kept = self.asked[..run.len()].iter().filter(|a| **a <= most);
        if 4 * kept.count() > 3 * run.len() {
            return run;
        }
        let first = self.len;
        let room = first + run.len();
        if self.x.len() < room {
            for list in [&mut self.x, &mut self.y, &mut self.size] {
                list.resize(2 * room, 0.0);
            }
        }
        // Written in any case, so that there is nothing to predict.
        let mut end = first;
        for (k, i) in run.enumerate() {
            self.x[end] = self.x[i];
            self.y[end] = self.y[i];
            self.size[end] = self.size[i];
            end += usize::from(self.asked[k] <= most);
        }
        self.len = end;
        first..end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROWTH: f64 = 0.35;
    const CLASSES: Classes = Classes {
        extent: 2.0,
        least: 0.01,
    };

    #[test]
    fn samples_that_others_make_useless_change_nothing() {
        let sample = |x: f64, size: f64| Sample {
            at: DVec2::new(x, 0.0),
            size,
        };
        let far = sample(1.0, 0.3);
        let useless = [sample(0.1, 0.1 + 0.2 * GROWTH), sample(0.9, 1.0)];
        let all = [far, useless[0], sample(0.0, 0.1), useless[1], far];
        let mut near = Near::new(&all, GROWTH, 1.0);
        let mut less = Near::new(&useful(&all, GROWTH), GROWTH, 1.0);
        for x in [0.0, 0.3, 0.7, 1.0, 2.0] {
            let at = DVec2::new(x, 0.5);
            assert_eq!(near.ask(0..5, at), less.ask(0..2, at));
        }
    }

    #[test]
    fn models_of_any_size_are_alike() {
        let sums = |unit: f64| {
            let at = |x, y| DVec2::new(x, y) * unit;
            let part = Part {
                corners: [at(1.0, 0.0), at(2.0, 0.0), at(2.0, 1.0)],
                cap: 0.2 * unit,
                weight: 1.0,
            };
            let feature = Sample {
                at: at(1.5, 0.25),
                size: 0.02 * unit,
            };
            let classes = Classes {
                extent: 2.0 * unit,
                least: 0.01 * unit,
            };
            Integral::over(&[part], &[feature], GROWTH, classes, 1)
        };
        let usual = sums(1.0);
        // Powers of two, so that nothing is rounded differently.
        for unit in [-100, -40, 40, 100].map(|k| 2.0_f64.powi(k)) {
            let scaled = sums(unit);
            for (a, b) in usual.volume.iter().zip(&scaled.volume) {
                assert_eq!(a.map(|v| v * unit.powi(3)), *b);
            }
            assert_eq!(usual.walls, scaled.walls);
        }
    }

    #[test]
    fn the_volume_is_that_of_the_ring_whatever_the_threads() {
        // A ring of radii 1 and 2 and height 1, and the same with a feature in the middle.
        let corner = DVec2::new;
        let [a, b, c, d] =
            [(1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0)].map(|(x, y)| corner(x, y));
        let parts = [[a, b, c], [a, c, d]].map(|corners| Part {
            corners,
            cap: 0.2,
            weight: 1.0,
        });
        let feature = Sample {
            at: corner(1.5, 0.5),
            size: 0.02,
        };
        for samples in [&[][..], &[feature][..]] {
            let sums = |threads| Integral::over(&parts, samples, GROWTH, CLASSES, threads);
            let one = sums(1);
            let volume: f64 = one.volume.iter().flatten().sum();
            let exact = std::f64::consts::PI * 3.0;
            assert!((volume - exact).abs() < 1e-3 * exact, "{volume}");
            let fine: f64 = one
                .volume
                .iter()
                .map(|row| row[..8].iter().sum::<f64>())
                .sum();
            assert_eq!(fine > 0.0, !samples.is_empty());
            let top = one.heights.iter().copied().fold(0.0, f64::max);
            assert_eq!(top, 1.0);
            for threads in [2, 3, 20] {
                assert_eq!(sums(threads).volume, one.volume);
                assert_eq!(sums(threads).walls, one.walls);
            }
        }
    }
}
