//! The worst elements by each metric, with their places.

use super::metric::Metric;
use glam::DVec3;
use serde::Serialize;
use tmesh::{Document, Template};

/// An element that is among the worst by a metric.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// The metric.
    pub metric: Metric,
    /// Its value; infinite (`null` in JSON) for flat elements.
    pub value: f64,
    /// Region id, as the first copy has it.
    pub region: u32,
    /// Template index.
    pub template: u32,
    /// Index of the tetrahedron in the template.
    pub tetrahedron: u64,
    /// Number of copies, all alike.
    pub copies: u64,
    /// Centroid of the first copy, world coordinates.
    pub place: [f64; 3],
}

/// Metrics by which there are worst elements, and whether large values are bad.
const RANKED: [(Metric, bool); 5] = [
    (Metric::RadiusEdgeRatio, true),
    (Metric::MinDihedral, false),
    (Metric::MaxDihedral, true),
    (Metric::AspectRatio, true),
    (Metric::Volume, false),
];

/// Collects the worst elements of all templates.
pub struct Ranking {
    count: usize,
    /// Per entry of [`RANKED`]: badness, template, tetrahedron, value; the worst first.
    found: [Vec<(f64, u32, u64, f64)>; RANKED.len()],
}

impl Ranking {
    /// So many elements per metric.
    pub fn new(count: usize) -> Self {
        Self {
            count,
            found: Default::default(),
        }
    }

    /// Looks at the values of a template that is placed, in the order of [`Metric::ALL`], one per
    /// tetrahedron but for the edge lengths.
    pub fn look(&mut self, template: u32, values: &[Vec<f64>; 6]) {
        if self.count == 0 {
            return;
        }
        for (list, (metric, large)) in self.found.iter_mut().zip(RANKED) {
            for (tet, &value) in (0..).zip(&values[metric as usize]) {
                let badness = if large { value } else { -value };
                if list.len() == self.count && list.last().is_some_and(|l| l.0 >= badness) {
                    continue;
                }
                let at = list.partition_point(|l| l.0 >= badness);
                list.insert(at, (badness, template, tet, value));
                list.truncate(self.count);
            }
        }
    }

    /// The elements, by metric, the worst first; those met first among equals.
    pub fn finish(self, document: &Document, copies: &[u64]) -> Vec<Worst> {
        let mut all = Vec::new();
        for (list, (metric, _)) in self.found.into_iter().zip(RANKED) {
            for (_, template, tetrahedron, value) in list {
                let t = &document.templates[template as usize];
                let placed = document.instances.iter().find(|i| i.template == template);
                let Some(placed) = placed else { continue };
                let centroid = placed.isometry.apply(centroid(t, tetrahedron));
                all.push(Worst {
                    metric,
                    value,
                    region: document.placed_region(placed, t.tets[tetrahedron as usize].region),
                    template,
                    tetrahedron,
                    copies: copies[template as usize],
                    place: document.frame.to_world(centroid).to_array(),
                });
            }
        }
        all
    }
}

fn centroid(template: &Template, tet: u64) -> DVec3 {
    let corners = template.tets[tet as usize].vertices;
    let sum: DVec3 = corners.iter().map(|&v| template.vertices[v as usize]).sum();
    0.25 * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_come_first_and_the_first_among_equals() {
        let mut values: [Vec<f64>; 6] = Default::default();
        values[Metric::MinDihedral as usize] = vec![30.0, 5.0, 20.0, 5.0, 1.0];
        values[Metric::MaxDihedral as usize] = vec![90.0, f64::INFINITY, 120.0, 90.0, 100.0];
        let mut ranking = Ranking::new(3);
        ranking.look(0, &values);
        ranking.look(1, &values);
        let order = |i: usize| -> Vec<_> { ranking.found[i].iter().map(|l| (l.1, l.2)).collect() };
        assert_eq!(order(1), [(0, 4), (1, 4), (0, 1)]);
        assert_eq!(order(2), [(0, 1), (1, 1), (0, 2)]);
    }
}
