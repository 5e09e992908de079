//! Exact statistics of a metric over weighted parts.

use super::metric::Metric;
use serde::Serialize;

/// A statistic over all values of a metric.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// Smallest value.
    Min,
    /// Largest value.
    Max,
    /// Arithmetic mean.
    Mean,
    /// First percentile.
    P01,
    /// Median.
    P50,
    /// 99th percentile.
    P99,
}

impl Statistic {
    /// All statistics, in the order of reports.
    pub const ALL: [Self; 6] = [
        Self::Min,
        Self::Max,
        Self::Mean,
        Self::P01,
        Self::P50,
        Self::P99,
    ];

    /// Name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Min => "min",
            Self::Max => "max",
            Self::Mean => "mean",
            Self::P01 => "p01",
            Self::P50 => "p50",
            Self::P99 => "p99",
        }
    }

    /// The statistic with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.name() == name)
    }
}

/// Values of one metric: parts of equal weight, one per template, weighted by its instances.
#[derive(Clone, Debug, Default)]
pub struct Sample {
    parts: Vec<(Vec<f64>, u64)>,
}

/// Statistics of one metric. Infinite values (flat elements) appear as `null` in JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Statistics {
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Arithmetic mean.
    pub mean: f64,
    /// First percentile. Percentiles are values that occur: the smallest one with at least that
    /// share of all values at or below it.
    pub p01: f64,
    /// Median.
    pub p50: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Distribution.
    pub histogram: Histogram,
}

/// Counts of values between boundaries.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Histogram {
    /// Boundaries, one more than counts; a bin includes its lower one, the last bin both. Values that
    /// miss a boundary by less than half of their digits (of the bin's width) count as on it: right angles are common, and
    /// rounding must not strew them over two bins.
    pub edges: Vec<f64>,
    /// Values in each bin. Values beyond the ends (infinite ones) count in the outermost bins.
    pub counts: Vec<u64>,
}

impl Statistics {
    /// One of the statistics.
    pub fn get(&self, statistic: Statistic) -> f64 {
        match statistic {
            Statistic::Min => self.min,
            Statistic::Max => self.max,
            Statistic::Mean => self.mean,
            Statistic::P01 => self.p01,
            Statistic::P50 => self.p50,
            Statistic::P99 => self.p99,
        }
    }
}

impl Sample {
    /// Adds the values of a part that occurs `weight` times. Values may be infinite, not NaN.
    pub fn add(&mut self, values: Vec<f64>, weight: u64) {
        if weight > 0 && !values.is_empty() {
            self.parts.push((values, weight));
        }
    }

    /// Smallest and largest finite value.
    pub fn finite_range(&self) -> Option<(f64, f64)> {
        let mut range: Option<(f64, f64)> = None;
        for &x in self.parts.iter().flat_map(|(values, _)| values) {
            if x.is_finite() {
                range = Some(range.map_or((x, x), |(a, b)| (a.min(x), b.max(x))));
            }
        }
        range
    }

    /// Values for which something holds, and all values.
    pub fn count(&self, holds: impl Fn(f64) -> bool) -> (u64, u64) {
        self.parts
            .iter()
            .fold((0, 0), |(some, all), (values, weight)| {
                let found = values.iter().filter(|&&x| holds(x)).count();
                (
                    some + weight * found as u64,
                    all + weight * values.len() as u64,
                )
            })
    }

    /// The statistics, with the histogram over `edges`; `None` without values. Linear in the number
    /// of values when all weights are equal, else one sort.
    pub fn statistics(self, edges: Vec<f64>) -> Option<Statistics> {
        let total: u64 = self
            .parts
            .iter()
            .map(|(values, weight)| values.len() as u64 * weight)
            .sum();
        if total == 0 {
            return None;
        }
        let mean = self
            .parts
            .iter()
            .map(|(values, weight)| sum(values) * *weight as f64)
            .sum::<f64>()
            / total as f64;
        let counts = self.counts(&edges);
        // One-based ranks, in whole numbers: a share of a count has no exact product.
        let ranks = [1, 50, 99].map(|percent: u64| (total * percent).div_ceil(100));
        let (min, max, [p01, p50, p99]) = self.ranked(ranks);
        Some(Statistics {
            min,
            max,
            mean,
            p01,
            p50,
            p99,
            histogram: Histogram { edges, counts },
        })
    }

    fn counts(&self, edges: &[f64]) -> Vec<u64> {
        // Half of the digits: far above the rounding of angles, and far too little to be seen.
        let rounding = f64::EPSILON.sqrt();
        let inner: Vec<f64> = edges
            .windows(2)
            .skip(1)
            .map(|e| e[0] - rounding * (e[1] - e[0]))
            .collect();
        let mut counts = vec![0; edges.len() - 1];
        for (values, weight) in &self.parts {
            for x in values {
                counts[inner.partition_point(|e| e <= x)] += weight;
            }
        }
        counts
    }

    /// Minimum, maximum, and the values at three increasing one-based ranks.
    fn ranked(mut self, ranks: [u64; 3]) -> (f64, f64, [f64; 3]) {
        let first_weight = self.parts[0].1;
        if self.parts.iter().all(|(_, weight)| *weight == first_weight) {
            let mut values = self.parts.swap_remove(0).0;
            for (more, _) in &self.parts {
                values.extend_from_slice(more);
            }
            let min = values.iter().copied().fold(f64::INFINITY, f64::min);
            let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let mut begin = 0;
            let found = ranks.map(|rank| {
                let index = ((rank - 1) / first_weight) as usize;
                let tail = &mut values[begin..];
                let (_, value, _) = tail.select_nth_unstable_by(index - begin, f64::total_cmp);
                begin = index;
                *value
            });
            return (min, max, found);
        }
        let mut values: Vec<(f64, u64)> = self
            .parts
            .into_iter()
            .flat_map(|(values, weight)| values.into_iter().map(move |x| (x, weight)))
            .collect();
        values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let last = values[values.len() - 1].0;
        let mut found = [last; 3];
        let mut below = 0;
        let mut next = 0;
        for (x, weight) in &values {
            below += weight;
            while next < 3 && ranks[next] <= below {
                found[next] = *x;
                next += 1;
            }
        }
        (values[0].0, last, found)
    }
}

/// Sum as good as if it were formed with twice the digits: what each addition loses is summed apart
/// (Ogita, Rump and Oishi 2005, algorithm Sum2).
pub fn sum(values: &[f64]) -> f64 {
    let (mut sum, mut lost) = (0.0, 0.0);
    for &x in values {
        let next = sum + x;
        let part = next - sum;
        lost += (sum - (next - part)) + (x - part);
        sum = next;
    }
    // An infinite value leaves no loss to tell.
    if sum.is_finite() { sum + lost } else { sum }
}

/// The boundaries of a metric's histogram over several samples.
pub fn common_bins(metric: Metric, samples: &[&Sample], bins: usize) -> Vec<f64> {
    let (low, high) = samples
        .iter()
        .filter_map(|s| s.finite_range())
        .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
        .unwrap_or((0.0, 1.0));
    metric.bins(low, high, bins)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(parts: &[(&[f64], u64)]) -> Sample {
        let mut sample = Sample::default();
        for (values, weight) in parts {
            sample.add(values.to_vec(), *weight);
        }
        sample
    }

    #[test]
    fn percentiles_are_nearest_ranks() {
        let values: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        let s = sample(&[(&values, 1)])
            .statistics(vec![1.0, 101.0, 200.0])
            .unwrap();
        assert_eq!((s.min, s.max, s.mean), (1.0, 200.0, 100.5));
        assert_eq!((s.p01, s.p50, s.p99), (2.0, 100.0, 198.0));
        assert_eq!(s.histogram.counts, [100, 100]);
    }

    #[test]
    fn weights_stand_for_copies() {
        let a = [3.0, 1.0, 9.0, 4.0, f64::INFINITY];
        let b = [2.0, 7.0, 7.0];
        let edges = vec![0.0, 2.0, 5.0, 9.0];
        for (wa, wb) in [(7, 7), (5, 32), (100, 1), (0, 3)] {
            let mut copies = Vec::new();
            (0..wa).for_each(|_| copies.extend(a));
            (0..wb).for_each(|_| copies.extend(b));
            let expanded = sample(&[(&copies, 1)]).statistics(edges.clone()).unwrap();
            let weighted = sample(&[(&a, wa), (&b, wb)])
                .statistics(edges.clone())
                .unwrap();
            assert_eq!(weighted, expanded);
        }
    }

    #[test]
    fn rounding_does_not_change_the_bin() {
        let below = 90.0_f64.next_down();
        let s = sample(&[(&[60.0, 89.9, below, 90.0, below.next_down()], 1)]);
        let s = s.statistics(vec![60.0, 90.0, 120.0]).unwrap();
        assert_eq!(s.histogram.counts, [2, 3]);
    }

    #[test]
    fn names_lead_back() {
        for statistic in Statistic::ALL {
            assert_eq!(Statistic::from_name(statistic.name()), Some(statistic));
        }
    }

    #[test]
    fn nothing_has_no_statistics() {
        assert_eq!(sample(&[]).statistics(vec![0.0, 1.0]), None);
        assert_eq!(
            common_bins(Metric::Volume, &[&sample(&[])], 2),
            [0.0, 0.5, 1.0]
        );
    }
}
