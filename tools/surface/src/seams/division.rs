//! One division for two edges that are images of each other.

/// A division of the unit interval as dense as the denser of two everywhere, evenly so: inner
/// points, increasing.
///
/// The density of a division is the inverse of its local interval; the larger one of both,
/// integrated from the start, gives the number of intervals, and equal parts of it their ends.
pub fn merged(low: &[f64], high: &[f64]) -> Vec<f64> {
    if same(low, high) {
        return low.to_vec();
    }
    let mut breaks: Vec<f64> = [low, high].concat();
    breaks.extend([0.0, 1.0]);
    breaks.sort_by(f64::total_cmp);
    let mut integral = vec![0.0];
    let mut total = 0.0;
    for w in breaks.windows(2) {
        let middle = 0.5 * (w[0] + w[1]);
        let length = interval(low, middle).min(interval(high, middle));
        total += (w[1] - w[0]) / length;
        integral.push(total);
    }
    let count = total.round().max(1.0);
    let mut points = Vec::with_capacity(count as usize);
    let mut i = 1;
    for k in 1..count as usize {
        let target = total * k as f64 / count;
        while i + 1 < integral.len() && integral[i] < target {
            i += 1;
        }
        let part = (target - integral[i - 1]) / (integral[i] - integral[i - 1]);
        points.push(breaks[i - 1] + part * (breaks[i] - breaks[i - 1]));
    }
    points
}

/// Whether two divisions are the same but for rounding, which may take half of the digits.
pub fn same(a: &[f64], b: &[f64]) -> bool {
    let rounding = f64::EPSILON.sqrt();
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= rounding)
}

/// The same division, seen from the other end.
pub fn reversed(division: &[f64]) -> Vec<f64> {
    division.iter().rev().map(|t| 1.0 - t).collect()
}

/// A division that is the same from both ends, with as many points as the given one.
pub fn symmetric(division: &[f64]) -> Vec<f64> {
    let back = reversed(division);
    let both = division.iter().zip(back);
    both.map(|(a, b)| 0.5 * (a + b)).collect()
}

/// Length of the interval around `t`.
fn interval(division: &[f64], t: f64) -> f64 {
    let after = division.partition_point(|&x| x <= t);
    let begin = if after == 0 { 0.0 } else { division[after - 1] };
    division.get(after).copied().unwrap_or(1.0) - begin
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shifted_divisions_do_not_add_up() {
        let low: Vec<f64> = (1..10).map(|i| 0.1 * f64::from(i)).collect();
        let high: Vec<f64> = (1..9).map(|i| f64::from(i) / 9.0).collect();
        assert_eq!(merged(&low, &high).len(), 9);
        assert_eq!(merged(&low, &low), low);
        assert!(merged(&[], &[]).is_empty());
        assert_eq!(merged(&[], &[0.5]), [0.5]);
    }

    #[test]
    fn divisions_of_edges_that_are_their_own_images_are_symmetric() {
        let division = [0.125, 0.25, 0.5];
        assert_eq!(reversed(&division), [0.5, 0.75, 0.875]);
        let both = symmetric(&merged(&division, &reversed(&division)));
        assert!(both.len() >= 4, "{both:?}");
        assert!(same(&both, &reversed(&both)), "{both:?}");
        assert!(both.windows(2).all(|w| w[0] < w[1]));
    }

    #[test]
    fn both_ends_are_as_fine_as_asked() {
        let both = merged(&[0.01, 0.02, 0.1], &[0.9, 0.99]);
        assert!(both[0] < 0.015 && both.last().unwrap() > &0.98, "{both:?}");
        assert!(both.windows(2).all(|w| w[0] < w[1]));
        assert!(both.len() < 8);
    }
}
