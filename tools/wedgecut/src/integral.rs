//! How much of a body wants elements of which size: integrals over its section.
//!
//! The section's triangles are halved until they are no larger than the elements wanted there, each piece
//! with the samples of sizes that matter in it.

use crate::piece::Piece;
use glam::DVec2;
use kit::in_parallel;
use std::ops::Range;

/// How fast element sizes grow with the distance from a feature.
pub const GROWTH: f64 = 0.35;
/// Classes of radius.
pub const RADII: usize = 96;
/// Classes of size, and how many there are per factor of two.
pub const SIZES: usize = 80;
pub const PER_OCTAVE: usize = 4;
/// Bounds of the classes within a factor of two: two to the power of a quarter, a half, three quarters.
const WITHIN_OCTAVE: [f64; PER_OCTAVE - 1] = [
    1.189_207_115_002_721,
    std::f64::consts::SQRT_2,
    1.681_792_830_507_429,
];
/// Smallest pieces of the section, relative to its extent.
const FINEST: f64 = 1.0 / 256.0;
/// Size of pieces near the axis, where wedges get narrow quickly, relative to the radius.
const NEAR_AXIS: f64 = 0.3;
/// Pieces smaller than this, relative to the extent, are so many that each matters little: they may be larger than
/// elements, so many times, and need not be smaller for being near the axis.
const SMALL: f64 = 1.0 / 32.0;
const COARSE: f64 = 1.25;
/// Samples, the smallest sizes first, that are tried for whether they make others useless.
const COMPARED: usize = 256;
/// Samples of a run are copied without those that do not matter if that is at least one of so many.
const WORTH_COPYING: usize = 4;
/// Groups of triangles that are summed on their own, so that sums do not depend on the number of threads.
const GROUPS: usize = 8;

/// A size that a feature asks for, at a place of the section.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Radius and height, model units.
    pub at: DVec2,
    /// Size, model units.
    pub size: f64,
}

/// A triangle of the section.
pub struct Part {
    /// Radius and height of its corners, model units.
    pub corners: [DVec2; 3],
    /// Largest size of elements in it, model units.
    pub cap: f64,
    /// Share of the section, where there are several of the same body.
    pub weight: f64,
}

/// Classes of radius and size.
#[derive(Clone, Copy, Debug)]
pub struct Classes {
    /// Largest coordinate of the section.
    pub extent: f64,
    /// Smallest size there is.
    pub least: f64,
}

impl Classes {
    pub fn of_radius(&self, r: f64) -> usize {
        ((r / self.extent * RADII as f64) as usize).min(RADII - 1)
    }

    pub fn of_size(&self, size: f64) -> usize {
        let ratio = size / self.least;
        if ratio < 1.0 {
            return 0;
        }
        let bits = ratio.to_bits();
        let octave = (bits >> 52) as usize - 1023;
        let mantissa = f64::from_bits(bits & (u64::MAX >> 12) | 1.0_f64.to_bits());
        let within = WITHIN_OCTAVE.iter().filter(|&&b| mantissa >= b).count();
        (PER_OCTAVE * octave + within).min(SIZES - 1)
    }

    /// Middle of a class of radius.
    pub fn radius(&self, class: usize) -> f64 {
        (class as f64 + 0.5) / RADII as f64 * self.extent
    }

    /// Middle of a class of size.
    pub fn size(&self, class: usize) -> f64 {
        self.least * ((class as f64 + 0.5) / PER_OCTAVE as f64).exp2()
    }
}

/// What is summed over the section.
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
            volume: vec![[0.0; SIZES]; RADII],
            walls: vec![0.0; RADII],
            heights: vec![0.0; RADII],
        }
    }

    /// Over all parts of a section, with the sizes that samples ask for. Does not depend on the number of
    /// threads.
    pub fn over(parts: &[Part], samples: &[Sample], classes: Classes, threads: usize) -> Self {
        let groups: Vec<usize> = (0..GROUPS.min(parts.len())).collect();
        let samples = useful(samples);
        let of_group = |&group: &usize| {
            let mut sums = Self::zero();
            let mut near = Near::new(&samples, classes.extent);
            for part in parts.iter().skip(group).step_by(GROUPS) {
                sums.add_part(part, &mut near, classes);
            }
            sums
        };
        let mut sums = in_parallel(&groups, threads, of_group).into_iter();
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
        let [finest, small] = [FINEST, SMALL].map(|part| part * classes.extent);
        // The samples that matter in a piece on the stack are a run of `near`; runs of those above it on
        // the stack lie behind it.
        let mut stack = vec![(Piece::Triangle(part.corners), 0..near.all)];
        while let Some((piece, run)) = stack.pop() {
            near.len = run.end;
            let middle = piece.middle();
            let size = near.ask(run.clone(), middle).min(part.cap);
            let coarse = size.max(small.min(COARSE * size));
            let wanted = coarse.min((NEAR_AXIS * middle.x).max(small)).max(finest);
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
            let kept = near.keep(run, size + 2.0 * GROWTH * reach);
            let [first, second] = piece.halves();
            stack.push((first, kept.clone()));
            stack.push((second, kept));
        }
    }
}

/// The samples without those that another one makes useless: it asks for no more at their place, and so
/// anywhere.
fn useful(samples: &[Sample]) -> Vec<Sample> {
    let mut sorted = samples.to_vec();
    sorted.sort_by(|a, b| a.size.total_cmp(&b.size));
    let mut kept: Vec<Sample> = Vec::new();
    for s in sorted {
        // Squares, to do without a root.
        let is_below = |k: &Sample| {
            let spare = s.size - k.size;
            GROWTH * GROWTH * k.at.distance_squared(s.at) <= spare * spare
        };
        if !kept.iter().take(COMPARED).any(is_below) {
            kept.push(s);
        }
    }
    kept
}

/// Samples, coordinate by coordinate, and further copies of some of them behind; in single precision, which is
/// more than an estimate needs and takes half the time. Lengths are in units of the section's extent, since
/// single precision does not hold those of every model.
struct Near {
    all: usize,
    len: usize,
    /// Model units.
    extent: f64,
    /// Radius and height.
    x: Vec<f32>,
    y: Vec<f32>,
    size: Vec<f32>,
    /// What the samples last looked at ask for at the place they were asked about.
    asked: Vec<f32>,
}

impl Near {
    fn new(samples: &[Sample], extent: f64) -> Self {
        let all = |value: fn(&Sample) -> f64| {
            let relative = samples.iter().map(|s| (value(s) / extent) as f32);
            relative.collect()
        };
        Self {
            all: samples.len(),
            len: samples.len(),
            extent,
            x: all(|s| s.at.x),
            y: all(|s| s.at.y),
            size: all(|s| s.size),
            asked: vec![0.0; samples.len()],
        }
    }

    /// The smallest size that a run of samples asks for at a place, model units.
    fn ask(&mut self, run: Range<usize>, at: DVec2) -> f64 {
        let at = (at / self.extent).as_vec2();
        let asked = &mut self.asked[..run.len()];
        let (x, y) = (&self.x[run.clone()], &self.y[run.clone()]);
        let size = &self.size[run];
        for (((asked, x), y), size) in asked.iter_mut().zip(x).zip(y).zip(size) {
            let (dx, dy) = (x - at.x, y - at.y);
            *asked = size + GROWTH as f32 * (dx * dx + dy * dy).sqrt();
        }
        // Plain comparisons become single instructions; nothing here is NaN.
        let least = |m: f32, a: &f32| if *a < m { *a } else { m };
        f64::from(asked.iter().fold(f32::INFINITY, least)) * self.extent
    }

    /// Copies those of a run that asked for no more than `most` behind all others, and says where; leaves them
    /// where they are if that are nearly all.
    fn keep(&mut self, run: Range<usize>, most: f64) -> Range<usize> {
        let most = (most / self.extent) as f32;
        let kept = self.asked[..run.len()].iter().filter(|a| **a <= most);
        if WORTH_COPYING * kept.count() > (WORTH_COPYING - 1) * run.len() {
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

    const CLASSES: Classes = Classes {
        extent: 2.0,
        least: 0.01,
    };

    #[test]
    fn sizes_are_in_the_class_whose_middle_is_nearest() {
        for class in 0..SIZES - 1 {
            assert_eq!(CLASSES.of_size(CLASSES.size(class)), class);
        }
        assert_eq!(CLASSES.of_size(0.0), 0);
        assert_eq!(CLASSES.of_size(0.009), 0);
        assert_eq!(CLASSES.of_size(1e300), SIZES - 1);
        assert_eq!(CLASSES.of_size(f64::INFINITY), SIZES - 1);
    }

    #[test]
    fn samples_that_ask_for_less_make_others_useless() {
        let sample = |x: f64, size: f64| Sample {
            at: DVec2::new(x, 0.0),
            size,
        };
        let far = sample(1.0, 0.3);
        // Beside the smallest, and where it asks for no more at all.
        let useless = [sample(0.1, 0.1 + 0.2 * GROWTH), sample(0.9, 1.0)];
        let all = [far, useless[0], sample(0.0, 0.1), useless[1], far];
        let kept: Vec<f64> = useful(&all).iter().map(|s| s.size).collect();
        assert_eq!(kept, [0.1, 0.3]);
        let mut near = Near::new(&all, 1.0);
        let mut less = Near::new(&useful(&all), 1.0);
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
            Integral::over(&[part], &[feature], classes, 1)
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
            let sums = |threads| Integral::over(&parts, samples, CLASSES, threads);
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
