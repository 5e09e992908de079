//! Round values along the axis of a histogram.

/// Values to label, increasing, and the place of each as a share of the axis.
pub struct Ticks(pub Vec<(f64, f64)>);

impl Ticks {
    /// At most so many multiples of one, two or five times a power of ten; between boundaries of equal ratio
    /// powers of ten, or one, two and five times such where there are less than two.
    pub fn of(edges: &[f64], most: usize) -> Self {
        let (low, high) = (edges[0], edges[edges.len() - 1]);
        if !(low.is_finite() && high.is_finite() && high > low) {
            return Self(vec![(low, 0.0)]);
        }
        let bins = (edges.len() - 1) as f64;
        // The first of bins of equal ratio is by far the narrowest.
        let ratio = low > 0.0 && 2.0 * (edges[1] - low) * bins < high - low;
        let (values, place): (Vec<f64>, fn(f64) -> f64) = match ratio {
            true => (decades(low, high, most), libm::log),
            false => (multiples(low, high, most), |x| x),
        };
        let (start, end) = (place(low), place(high));
        let share = |x: f64| (place(x) - start) / (end - start);
        Self(values.into_iter().map(|x| (x, share(x))).collect())
    }
}

/// Multiples of the smallest step of which there are not too many.
fn multiples(low: f64, high: f64, most: usize) -> Vec<f64> {
    let decade = libm::floor(libm::log10((high - low) / most as f64)) as i32;
    let steps = (decade..).flat_map(|d| [1.0, 2.0, 5.0].map(|m| (m, d)));
    let mut all = steps.map(|(m, d)| {
        let unit = m * power(d);
        let (first, last) = (libm::ceil(low / unit), libm::floor(high / unit));
        let count = (last - first + 1.0).max(0.0) as usize;
        let values = (0..count.min(most + 1)).map(|i| (first + i as f64) * unit);
        values.collect::<Vec<f64>>()
    });
    all.find(|values| values.len() <= most).unwrap_or_default()
}

/// Powers of ten, every second or third of them where there are many, or parts of a decade where there are few.
fn decades(low: f64, high: f64, most: usize) -> Vec<f64> {
    let (first, last) = (libm::floor(libm::log10(low)), libm::ceil(libm::log10(high)));
    let between = |mantissas: &[f64], every: usize| -> Vec<f64> {
        let decades = (first as i32..=last as i32).step_by(every);
        let values = decades.flat_map(|d| {
            let power = power(d);
            mantissas.iter().map(move |m| m * power)
        });
        values.filter(|x| (low..=high).contains(x)).collect()
    };
    let fine = between(&[1.0, 2.0, 5.0], 1);
    if fine.len() <= most {
        return fine;
    }
    let mut all = (1..).map(|every| between(&[1.0], every));
    all.find(|values| values.len() <= most).unwrap_or_default()
}

/// A power of ten; those below one are rounded once.
fn power(decade: i32) -> f64 {
    let power = libm::pow(10.0, f64::from(decade.abs()));
    if decade < 0 { 1.0 / power } else { power }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(edges: &[f64]) -> Vec<f64> {
        let ticks = Ticks::of(edges, 6).0;
        assert!(
            ticks.iter().all(|t| (0.0..=1.0).contains(&t.1)),
            "{ticks:?}"
        );
        ticks.into_iter().map(|t| t.0).collect()
    }

    #[test]
    fn labels_are_round() {
        assert_eq!(values(&[0.0, 40.0, 80.0]), [0.0, 20.0, 40.0, 60.0, 80.0]);
        assert_eq!(values(&[0.6175, 1.0, 1.39999]).len(), 3);
        assert_eq!(values(&[-0.3, 0.1, 0.5]), [-0.2, 0.0, 0.2, 0.4]);
        let equal: Vec<f64> = (0..=20)
            .map(|i| libm::pow(10.0, -9.5 + 0.25 * f64::from(i)))
            .collect();
        assert_eq!(values(&equal), [1e-9, 1e-8, 1e-7, 1e-6, 1e-5]);
        assert_eq!(values(&[5.0, 5.0]), [5.0]);
        assert_eq!(values(&[0.0, f64::INFINITY]).len(), 1);
    }
}
