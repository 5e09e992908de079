//! How many values of a metric are beyond a bound, as `--count-above` and `--count-below` ask.

use super::assignment::metric_and_value;
use super::metric::Metric;
use super::statistics::Sample;
use serde::Serialize;

/// A bound to count beyond.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bound {
    /// Which metric.
    pub metric: Metric,
    /// The bound, in the metric's unit.
    pub value: f64,
    /// Whether values above it count, rather than values below; never those equal to it.
    pub above: bool,
}

/// What is beyond a bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Beyond {
    /// The bound.
    #[serde(flatten)]
    pub bound: Bound,
    /// Values beyond it, in all copies: elements, edges for `edge_length`.
    pub count: u64,
    /// Their part of all values; 0 where there are none.
    pub share: f64,
}

impl Bound {
    /// Parses `METRIC=VALUE`.
    ///
    /// # Errors
    /// A sentence that says which names there are.
    pub fn parse(text: &str, above: bool) -> Result<Self, String> {
        let (name, value) = metric_and_value(text, "METRIC=VALUE")?;
        Ok(Self {
            metric: Metric::parse(name)?,
            value,
            above,
        })
    }

    /// Counts what is beyond it.
    pub fn count(self, sample: &Sample) -> Beyond {
        let (count, all) = sample.count(|x| {
            if self.above {
                x > self.value
            } else {
                x < self.value
            }
        });
        Beyond {
            bound: self,
            count,
            share: count as f64 / all.max(1) as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_parsed_and_counted() {
        let mut sample = Sample::default();
        sample.add(vec![1.0, 2.0, 2.0, f64::INFINITY], 3);
        sample.add(vec![0.5], 2);
        for (text, above, count) in [
            ("radius_edge_ratio=2", true, 3),
            ("radius_edge_ratio=1.99", true, 9),
            ("radius_edge_ratio=2", false, 5),
            ("radius_edge_ratio=0.5", false, 0),
        ] {
            let beyond = Bound::parse(text, above).unwrap().count(&sample);
            assert_eq!(beyond.count, count, "{text} {above}");
            assert_eq!(beyond.share, count as f64 / 14.0);
        }
        let none = Bound::parse("volume=0", true).unwrap();
        let none = none.count(&Sample::default());
        assert_eq!((none.count, none.share), (0, 0.0));
        for (text, part) in [
            ("volume", "expected METRIC=VALUE"),
            ("volume.min=1", "no metric 'volume.min'"),
            ("volume=inf", "'inf' is not a number"),
        ] {
            let error = Bound::parse(text, true).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
