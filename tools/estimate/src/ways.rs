//! The ways to mesh a body, and which is taken.

use crate::elements::Estimate;
use crate::model::CostModel;
use crate::way::{Cut, Way};

/// Which hubs there may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hubs {
    /// Where they pay.
    Free,
    /// None.
    None,
    /// One of this inscribed radius, model units.
    Radius(f64),
}

/// What the elements have to be like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Bound on the ratio of circumradius to shortest edge that the mesher will be given.
    pub radius_edge: f64,
    /// Which hubs there may be.
    pub hubs: Hubs,
}

/// The ways to mesh a body.
pub struct Ways<'a> {
    model: CostModel,
    cuts: &'a [Cut],
    radius_edge: f64,
    /// The best way of each order, in the order of `cuts`.
    pub list: Vec<Way>,
}

impl<'a> Ways<'a> {
    /// Each order with its best hub and planes; cuts of one order follow each other.
    pub fn new(estimate: &Estimate, cuts: &'a [Cut], bounds: Bounds) -> Self {
        let mut ways = Self {
            model: estimate.model,
            cuts,
            radius_edge: bounds.radius_edge,
            list: Vec::new(),
        };
        let whole = estimate.whole().elements(&estimate.model);
        if whole.is_nan() || whole <= 0.0 {
            return ways;
        }
        let radii = match bounds.hubs {
            Hubs::Radius(radius) => vec![radius],
            Hubs::None => Vec::new(),
            Hubs::Free => estimate.radii(),
        };
        let asked = matches!(bounds.hubs, Hubs::Radius(_));
        let indices: Vec<usize> = (0..cuts.len()).collect();
        for group in indices.chunk_by(|&i, &j| cuts[i].order == cuts[j].order) {
            let mut found = Vec::new();
            for &i in group {
                let cut = &cuts[i];
                let narrow = cut.hub && estimate.is_narrow(cut.angle);
                if !asked && (!narrow || radii.is_empty()) {
                    found.push(estimate.way(i, cut, None));
                }
                if narrow || (asked && cut.hub) {
                    found.extend(radii.iter().map(|&r| estimate.way(i, cut, Some(r))));
                }
            }
            // No other plane changes what the seam costs.
            let seams = group.iter().map(|&i| estimate.seams(&cuts[i]));
            let base = 1.0 + seams.fold(f64::INFINITY, f64::min) / whole;
            ways.list.extend(ways.best(&found, base));
        }
        ways
    }

    /// The best way of each order, the one to take first.
    pub fn ranked(&self) -> Vec<Way> {
        let mut left = self.list.clone();
        let mut ranked = Vec::with_capacity(left.len());
        while let Some(best) = self.best(&left, 1.0) {
            // Each order is there once, whatever its cost is.
            left.retain(|w| w.cut != best.cut);
            ranked.push(best);
        }
        ranked
    }

    /// Whether a way has no more elements than are accepted.
    pub fn is_accepted(&self, way: &Way) -> bool {
        way.elements <= self.limit(way)
    }

    /// The fastest way within the accepted number of elements, else the one with the fewest. `base`: the
    /// elements that cannot be avoided, over those of the whole body.
    fn best(&self, ways: &[Way], base: f64) -> Option<Way> {
        let order = |w: &Way| self.cuts[w.cut].order;
        let accepted = || ways.iter().filter(|w| w.elements <= base * self.limit(w));
        let least = accepted().map(|w| w.meshed).fold(f64::INFINITY, f64::min);
        let as_fast = accepted().filter(|w| w.meshed <= self.model.accepted.as_fast * least);
        let chosen =
            as_fast.min_by(|a, b| order(a).cmp(&order(b)).then(a.meshed.total_cmp(&b.meshed)));
        let fewest = || ways.iter().min_by(|a, b| a.elements.total_cmp(&b.elements));
        chosen.or_else(fewest).copied()
    }

    /// Most elements that a way may have, over those of the whole body.
    fn limit(&self, way: &Way) -> f64 {
        let accepted = &self.model.accepted;
        let cut = &self.cuts[way.cut];
        let [from, to] = accepted.loose;
        let loose = ((self.radius_edge - from) / (to - from)).clamp(0.0, 1.0);
        match (way.hub, cut.across, cut.free) {
            (Some(_), ..) => accepted.more_cuts + (accepted.loose_hub - accepted.more_cuts) * loose,
            (None, true, _) => accepted.more_cuts,
            (None, false, true) => accepted.mirror,
            (None, false, false) => accepted.seam,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loose_bounds_accept_less_of_a_hub() {
        let cut = |order| Cut {
            order,
            angle: 1.0,
            copies: 1.0,
            hub_copies: 1.0,
            reach: 1.0,
            free: true,
            across: false,
            harm: 0.0,
            hub: true,
        };
        let cuts = [cut(4), cut(8)];
        let chosen = |radius_edge: f64, hub: Option<f64>| {
            let way = |cut, elements, meshed| Way {
                cut,
                hub,
                elements,
                meshed,
            };
            let ways = Ways {
                model: CostModel::CALIBRATED,
                cuts: &cuts,
                radius_edge,
                list: vec![way(0, 1.0, 0.2), way(1, 1.06, 0.1)],
            };
            cuts[ways.ranked()[0].cut].order
        };
        let hub = Some(0.1);
        assert_eq!([1.4, 1.7, 1.95, 3.0].map(|r| chosen(r, hub)), [8, 8, 4, 4]);
        assert_eq!([1.4, 3.0].map(|r| chosen(r, None)), [8, 8]);
    }
}
