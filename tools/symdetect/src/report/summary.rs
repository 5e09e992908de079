//! What was found, in words and as a table of residuals.

use crate::budget::{LISTED, SHOWN};
use crate::report::detection::Detection;
use kit::point;
use std::fmt::Write;
use tmesh::Document;

/// Width of the longest bar of the table, characters.
const BAR: usize = 32;

impl Detection {
    /// A few sentences: mirror planes, further axes, the orders nearest to holding.
    pub fn summary(&self) -> Vec<String> {
        let s = &self.symmetry;
        let mut lines = Vec::new();
        let along = match (s.group.has_vertical_mirrors(), s.group.order) {
            (false, _) => "no mirror plane contains the axis".to_owned(),
            (true, 1) => format!(
                "a mirror plane contains the axis and {}",
                point(s.reference)
            ),
            (true, n) => format!(
                "{n} mirror planes contain the axis, one of them {}",
                point(s.reference)
            ),
        };
        let across = if s.group.has_horizontal_mirror() {
            "one lies across it"
        } else {
            "none lies across it"
        };
        let others = match (self.axes, self.search.other_axes.len()) {
            (0, _) => "no other axes".to_owned(),
            (1, _) => "one other axis".to_owned(),
            (n, listed) if listed < n => format!("{n} other axes, {listed} of them listed"),
            (n, _) => format!("{n} other axes"),
        };
        lines.push(format!("{along}, {across}; {others}"));
        let mut rejected = self.search.rejected.clone();
        rejected.sort_by(|a, b| {
            a.residual
                .total_cmp(&b.residual)
                .then(a.order.cmp(&b.order))
        });
        if !rejected.is_empty() {
            let list: Vec<String> = (rejected.iter().take(SHOWN))
                .map(|r| format!("{} (off by {:.1e})", r.order, r.residual))
                .collect();
            lines.push(format!(
                "orders nearest to holding beside it: {}",
                list.join(", ")
            ));
        }
        lines.extend(self.nearly.as_ref().map(ToString::to_string));
        lines
    }

    /// Which regions the group exchanges, and the part of it that keeps them; `None` where all are kept.
    pub fn exchange(&self, document: &Document) -> Option<String> {
        let all = self.symmetry.exchanged_regions();
        let name = |id: &u32| {
            let known = document.regions.iter().find(|r| r.id == *id);
            known.map_or_else(|| format!("region {id}"), |r| r.name.clone())
        };
        let orbit = |ids: &Vec<u32>| {
            let names: Vec<String> = ids.iter().map(name).collect();
            match &names[..] {
                names if names.len() > SHOWN => {
                    let (some, others) = names.split_at(SHOWN - 1);
                    format!("{} and {} more", some.join(", "), others.len())
                }
                [some @ .., last] => format!("{} and {last}", some.join(", ")),
                [] => String::new(),
            }
        };
        let mut orbits: Vec<String> = all.iter().take(SHOWN).map(orbit).collect();
        if all.len() > SHOWN {
            orbits.push(format!("{} other sets", all.len() - SHOWN));
        }
        let [group, keeping] = [self.symmetry.group, self.symmetry.keeping_regions()];
        (!orbits.is_empty()).then(|| {
            format!(
                "order {} ({group}) exchanging regions {}; order {} ({keeping}) keeping them",
                group.order,
                orbits.join(", and "),
                keeping.order
            )
        })
    }

    /// Residual against order as bars on a logarithmic scale, a line each.
    pub fn table(&self) -> Vec<String> {
        let tolerance = self.symmetry.tolerance;
        let values = self.profile.iter().map(|r| r.residual);
        let lowest = values.filter(|v| *v > 0.0).fold(0.1 * tolerance, f64::min);
        let decades = -libm::log10(lowest.max(1e-16));
        let place = |v: f64| {
            let share = 1.0 + libm::log10(v.max(1e-16)) / decades;
            (share.clamp(0.0, 1.0) * BAR as f64) as usize
        };
        let line = place(tolerance);
        let mut lines = vec![format!(
            "order  residual  (| marks the tolerance of {tolerance:.0e})"
        )];
        for r in self.profile.iter().take(LISTED) {
            let mut text = format!("{:5}  {:8.1e}  ", r.order, r.residual);
            for i in 0..=BAR {
                text.push(match i {
                    i if i == line => '|',
                    i if i < place(r.residual) => '#',
                    _ => ' ',
                });
            }
            let _ = write!(text, "{}", if r.holds { " holds" } else { "" });
            lines.push(text.trim_end().to_owned());
        }
        lines
    }
}
