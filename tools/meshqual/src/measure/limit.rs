//! Limits a mesh has to meet, as `--fail-below` and `--fail-above` give them.

use super::assignment::metric_and_value;
use super::metric::Metric;
use super::statistics::Statistic;
use super::summary::Summary;

/// A limit on a statistic of a metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Which metric.
    pub metric: Metric,
    /// Which statistic of it.
    pub statistic: Statistic,
    /// The limit, in the metric's unit.
    pub value: f64,
    /// Whether values above the limit fail, rather than values below.
    pub above: bool,
}

impl Limit {
    /// Parses `METRIC[.STATISTIC]=VALUE`; the statistic is `min` unless given, `max` with `above`.
    ///
    /// # Errors
    /// A sentence that says which names there are.
    pub fn parse(text: &str, above: bool) -> Result<Self, String> {
        let (name, value) = metric_and_value(text, "METRIC=VALUE or METRIC.STATISTIC=VALUE")?;
        let (metric, statistic) = match name.split_once('.') {
            Some((metric, statistic)) => (metric, Some(statistic)),
            None => (name, None),
        };
        let metric = Metric::parse(metric)?;
        let statistic = match statistic {
            None if above => Statistic::Max,
            None => Statistic::Min,
            Some(name) => Statistic::from_name(name).ok_or_else(|| {
                let known = Statistic::ALL.map(Statistic::name).join(", ");
                format!("there is no statistic '{name}'; the statistics are {known}")
            })?,
        };
        Ok(Self {
            metric,
            statistic,
            value,
            above,
        })
    }

    /// What is wrong, if the limit is not met. A mesh without tetrahedra meets none.
    pub fn broken(&self, summary: &Summary) -> Option<String> {
        let name = format!("{}.{}", self.metric.name(), self.statistic.name());
        let Some(statistics) = summary.metrics.get(self.metric) else {
            return Some(format!("{name} has no value: there are no tetrahedra"));
        };
        let found = statistics.get(self.statistic);
        let (fails, word) = if self.above {
            (found > self.value, "above")
        } else {
            (found < self.value, "below")
        };
        fails.then(|| format!("{name} is {found:.6}, {word} {}", self.value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_parsed() {
        let limit = Limit::parse("min_dihedral_deg=8", false).unwrap();
        assert_eq!(limit.metric, Metric::MinDihedral);
        assert_eq!((limit.statistic, limit.value), (Statistic::Min, 8.0));
        let limit = Limit::parse("radius_edge_ratio.p99=1.4", true).unwrap();
        assert_eq!((limit.statistic, limit.value), (Statistic::P99, 1.4));
        assert_eq!(
            Limit::parse("volume=1", true).unwrap().statistic,
            Statistic::Max
        );
        for (text, part) in [
            ("min_dihedral_deg", "expected METRIC=VALUE"),
            ("angle=3", "no metric 'angle'"),
            ("volume.p02=3", "no statistic 'p02'"),
            ("volume=much", "'much' is not a number"),
            ("volume=nan", "'nan' is not a number"),
        ] {
            let error = Limit::parse(text, false).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
