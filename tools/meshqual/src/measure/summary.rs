//! Sizes and metrics of a mesh.

use super::bound::{Beyond, Bound};
use super::measured::Measured;
use super::metric::Metric;
use super::statistics::{Statistic, Statistics};
use super::surface::{Surface, surface};
use crate::instances::{Realized, assembled_vertices, realized};
use serde::Serialize;
use serde::ser::SerializeMap;
use std::collections::BTreeMap;
use tmesh::Document;

/// Sizes and metrics of a mesh as it is when assembled.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Vertices.
    pub vertices: u64,
    /// Tetrahedra.
    pub tetrahedra: u64,
    /// Volume, model units cubed.
    pub volume: f64,
    /// Parts by region id.
    pub regions: Vec<RegionReport>,
    /// Surface triangles, stored ones.
    pub surface: Surface,
    /// Templates the mesh is stored as.
    pub templates: u64,
    /// Placed copies of templates.
    pub instances: u64,
    /// Symmetry of the instances, or what a plain mesh promises; `null` for one that promises nothing.
    pub symmetry: Option<Realized>,
    /// Statistics of the metrics; each `null` without tetrahedra.
    pub metrics: Metrics,
    /// What is beyond the bounds that were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beyond: Vec<Beyond>,
}

/// One region of a mesh.
#[derive(Clone, Debug, Serialize)]
pub struct RegionReport {
    /// Region id.
    pub id: u32,
    /// Name, empty if it has none.
    pub name: String,
    /// Tetrahedra.
    pub tetrahedra: u64,
    /// Volume, model units cubed.
    pub volume: f64,
    /// Statistics of the metrics.
    pub metrics: RegionMetrics,
}

/// Statistics of the metrics of one region's tetrahedra, edge lengths left out.
#[derive(Clone, Debug, Default)]
pub struct RegionMetrics(Vec<(Metric, Statistics)>);

impl RegionMetrics {
    /// Statistics of a metric; `None` without tetrahedra.
    pub fn get(&self, metric: Metric) -> Option<&Statistics> {
        let found = self.0.iter().find(|m| m.0 == metric);
        found.map(|m| &m.1)
    }
}

impl Serialize for RegionMetrics {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (metric, statistics) in &self.0 {
            let values: BTreeMap<&str, f64> = Statistic::ALL
                .iter()
                .map(|&s| (s.name(), statistics.get(s)))
                .collect();
            map.serialize_entry(metric.name(), &values)?;
        }
        map.end()
    }
}

/// Statistics of all metrics, in the order of [`Metric::ALL`].
#[derive(Clone, Debug)]
pub struct Metrics(Vec<Option<Statistics>>);

impl Metrics {
    /// Statistics of a metric; `None` without tetrahedra.
    pub fn get(&self, metric: Metric) -> Option<&Statistics> {
        self.0[metric as usize].as_ref()
    }
}

impl Serialize for Metrics {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for metric in Metric::ALL {
            map.serialize_entry(metric.name(), &self.get(metric))?;
        }
        map.end()
    }
}

impl Summary {
    /// Sizes and metrics of a document from its measures, with the boundaries of the histograms, in the
    /// order of [`Metric::ALL`].
    pub fn new(
        document: &Document,
        mut measured: Measured,
        bins: &[Vec<f64>],
        bounds: &[Bound],
    ) -> Self {
        let regions = regions(document, &mut measured);
        let beyond = bounds
            .iter()
            .map(|bound| bound.count(&measured.samples[bound.metric as usize]))
            .collect();
        let metrics = measured
            .samples
            .into_iter()
            .zip(bins)
            .map(|(sample, bins)| sample.statistics(bins.clone()))
            .collect();
        Self {
            vertices: assembled_vertices(document),
            tetrahedra: measured.total.tetrahedra,
            volume: measured.total.volume,
            regions,
            surface: surface(document),
            templates: document.templates.len() as u64,
            instances: document.instances.len() as u64,
            symmetry: symmetry(document),
            metrics: Metrics(metrics),
            beyond,
        }
    }

    /// A region's name, or its id where it has none.
    pub fn region_name(&self, id: u32) -> String {
        let found = self
            .regions
            .iter()
            .find(|r| r.id == id && !r.name.is_empty());
        found.map_or_else(|| format!("region {id}"), |r| r.name.clone())
    }
}

/// What a plain mesh promises, and what the instances of another one make.
fn symmetry(document: &Document) -> Option<Realized> {
    if !document.is_plain() {
        return Some(realized(document));
    }
    let promise = document.promise.as_ref();
    promise.map(|p| Realized {
        group: p.group,
        outside: p.outside,
    })
}

/// The regions by id: those that the elements name, and listed ones of which nothing is left, which
/// must show.
fn regions(document: &Document, measured: &mut Measured) -> Vec<RegionReport> {
    let mut by_region = std::mem::take(&mut measured.by_region);
    let mut quality = |id: u32| {
        let samples = by_region.remove(&id).into_iter().flatten();
        let metrics = samples.filter_map(|(metric, sample)| {
            // Histograms by region are not shown.
            let one_bin = vec![0.0, 1.0];
            Some((metric, sample.statistics(one_bin)?))
        });
        RegionMetrics(metrics.collect())
    };
    let name = |id: u32| {
        let found = document.regions.binary_search_by_key(&id, |r| r.id);
        found.map_or_else(|_| String::new(), |i| document.regions[i].name.clone())
    };
    let mut ids: Vec<u32> = document.regions.iter().map(|r| r.id).collect();
    ids.extend(measured.regions.keys());
    ids.sort_unstable();
    ids.dedup();
    ids.into_iter()
        .map(|id| {
            let amount = measured.regions.get(&id).copied().unwrap_or_default();
            RegionReport {
                id,
                name: name(id),
                tetrahedra: amount.tetrahedra,
                volume: amount.volume,
                metrics: quality(id),
            }
        })
        .collect()
}
