//! Measures the tetrahedra of the templates and adds them up over the instances.

use super::metric::Metric;
use super::statistics::{Sample, sum};
use super::worst::{Ranking, Worst};
use crate::instances::Copies;
use geom::measure::{corners, tet_volume};
use geom::tet::TetMeasures;
use std::collections::BTreeMap;
use tmesh::{Document, OUTSIDE, Template};

/// Amounts of one region, or of all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Amount {
    /// Number of tetrahedra.
    pub tetrahedra: u64,
    /// Volume, model units cubed; enclosed by the triangles where there are no tetrahedra.
    pub volume: f64,
}

impl Amount {
    fn add(&mut self, other: Self, times: u64) {
        self.tetrahedra += other.tetrahedra * times;
        self.volume += other.volume * times as f64;
    }
}

/// Measures of a document.
pub struct Measured {
    /// Amounts per region of the assembled mesh.
    pub regions: BTreeMap<u32, Amount>,
    /// Amounts of everything.
    pub total: Amount,
    /// Values of each metric, in the order of [`Metric::ALL`].
    pub samples: Vec<Sample>,
    /// Values of each metric but the edge lengths, by region.
    pub by_region: BTreeMap<u32, Vec<(Metric, Sample)>>,
    /// The worst elements.
    pub worst: Vec<Worst>,
}

/// Metrics that are told by region: one value per tetrahedron.
const BY_REGION: [Metric; 5] = [
    Metric::RadiusEdgeRatio,
    Metric::MinDihedral,
    Metric::MaxDihedral,
    Metric::AspectRatio,
    Metric::Volume,
];

/// Measures a document as it would be assembled, and finds so many worst elements per metric. Linear
/// in the templates.
pub fn measure(document: &Document, worst: usize) -> Measured {
    let copies = Copies::of(document);
    let mut samples = vec![Sample::default(); Metric::ALL.len()];
    let mut regions: BTreeMap<u32, Amount> = BTreeMap::new();
    let mut by_region: BTreeMap<u32, Vec<(Metric, Sample)>> = BTreeMap::new();
    let mut ranking = Ranking::new(worst);
    for (index, template) in document.templates.iter().enumerate() {
        let own = if template.tets.is_empty() {
            enclosed(template)
        } else {
            let values = values(template);
            if copies.of_template[index] > 0 {
                ranking.look(index as u32, &values);
            }
            let parts = parts(template, &values);
            for instance in first_of_each_map(document, index as u32) {
                let count = copies.of_map[&(index as u32, instance.region_map)];
                for (&region, parts) in &parts {
                    let region = document.placed_region(instance, region);
                    let samples = by_region
                        .entry(region)
                        .or_insert_with(|| BY_REGION.map(|m| (m, Sample::default())).to_vec());
                    for ((_, sample), values) in samples.iter_mut().zip(parts) {
                        sample.add(values.clone(), count);
                    }
                }
            }
            let volumes = &values[Metric::ALL.len() - 1];
            let own = amounts(template, volumes);
            for (sample, values) in samples.iter_mut().zip(values) {
                sample.add(values, copies.of_template[index]);
            }
            own
        };
        for instance in first_of_each_map(document, index as u32) {
            let count = copies.of_map[&(index as u32, instance.region_map)];
            for (&region, &amount) in &own {
                let region = document.placed_region(instance, region);
                regions.entry(region).or_default().add(amount, count);
            }
        }
    }
    let mut total = Amount::default();
    regions.values().for_each(|r| total.add(*r, 1));
    Measured {
        regions,
        total,
        samples,
        by_region,
        worst: ranking.finish(document, &copies.of_template),
    }
}

fn first_of_each_map(document: &Document, template: u32) -> impl Iterator<Item = &tmesh::Instance> {
    let firsts: BTreeMap<u32, &tmesh::Instance> = document
        .instances
        .iter()
        .rev()
        .filter(|i| i.template == template)
        .map(|i| (i.region_map, i))
        .collect();
    firsts.into_values()
}

/// Values of each metric over the tetrahedra of a template, in the order of [`Metric::ALL`].
fn values(template: &Template) -> [Vec<f64>; 6] {
    let count = template.tets.len();
    let mut radius_edge = Vec::with_capacity(count);
    let mut min_dihedral = Vec::with_capacity(count);
    let mut max_dihedral = Vec::with_capacity(count);
    let mut aspect = Vec::with_capacity(count);
    let mut edges = Vec::with_capacity(6 * count);
    let mut volumes = Vec::with_capacity(count);
    for tet in &template.tets {
        let m = TetMeasures::of(tet.vertices.map(|v| template.vertices[v as usize]));
        radius_edge.push(m.radius_edge_ratio);
        min_dihedral.push(m.min_dihedral().to_degrees());
        max_dihedral.push(m.max_dihedral().to_degrees());
        aspect.push(m.aspect_ratio);
        edges.extend_from_slice(&m.edges);
        volumes.push(m.volume);
    }
    [
        radius_edge,
        min_dihedral,
        max_dihedral,
        aspect,
        edges,
        volumes,
    ]
}

/// Values of the metrics of [`BY_REGION`] by region.
fn parts(template: &Template, values: &[Vec<f64>; 6]) -> BTreeMap<u32, [Vec<f64>; 5]> {
    let mut parts: BTreeMap<u32, [Vec<f64>; 5]> = BTreeMap::new();
    let mut begin = 0;
    for run in template.tets.chunk_by(|a, b| a.region == b.region) {
        let end = begin + run.len();
        let part = parts.entry(run[0].region).or_default();
        for (list, metric) in part.iter_mut().zip(BY_REGION) {
            list.extend(&values[metric as usize][begin..end]);
        }
        begin = end;
    }
    parts
}

/// Amounts per region of a template, from the volumes of its tetrahedra.
fn amounts(template: &Template, volumes: &[f64]) -> BTreeMap<u32, Amount> {
    // Runs of equal region are summed as blocks.
    let mut amounts: BTreeMap<u32, Amount> = BTreeMap::new();
    let mut begin = 0;
    for run in template.tets.chunk_by(|a, b| a.region == b.region) {
        let end = begin + run.len();
        let amount = amounts.entry(run[0].region).or_default();
        amount.tetrahedra += run.len() as u64;
        amount.volume += sum(&volumes[begin..end]);
        begin = end;
    }
    amounts
}

/// Volumes enclosed by the triangles of a template, per region, by the divergence theorem.
fn enclosed(template: &Template) -> BTreeMap<u32, Amount> {
    let origin = template.vertices.first().copied().unwrap_or_default();
    let mut amounts: BTreeMap<u32, Amount> = BTreeMap::new();
    for t in &template.triangles {
        let [a, b, c] = corners(&template.vertices, t);
        let volume = tet_volume(origin, a, b, c);
        for (region, volume) in [(t.back, volume), (t.front, -volume)] {
            if region != OUTSIDE {
                amounts.entry(region).or_default().volume += volume;
            }
        }
    }
    amounts
}
