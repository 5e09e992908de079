//! What there is to say about a mesh.

use crate::check::{Checks, check};
use crate::instances::{Realized, assembled_vertices, is_sector, realized};
use crate::measure::{Measured, measure};
use crate::statistics::{Statistics, common_bins};
use crate::{Beyond, Bound, Error, Limit, Metric, Statistic, Worst};
use serde::Serialize;
use serde::ser::SerializeMap;
use std::collections::BTreeMap;
use tmesh::{Document, Region, Violation};

/// What to find out.
#[derive(Clone, Debug)]
pub struct Params {
    /// Bins per histogram, at least 1.
    pub bins: usize,
    /// Limits the mesh has to meet.
    pub limits: Vec<Limit>,
    /// Bounds beyond which values are counted.
    pub bounds: Vec<Bound>,
    /// Worst elements to find per metric.
    pub worst: usize,
}

/// All about a mesh.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Sizes and metrics.
    #[serde(flatten)]
    pub summary: Summary,
    /// The worst elements by each metric.
    pub worst: Vec<Worst>,
    /// Which promises hold.
    pub checks: Checks,
    /// Limits that are not met, a sentence each.
    pub limits_broken: Vec<String>,
    /// What a reader should know to understand the figures.
    pub notes: Vec<String>,
    /// The mesh it is compared with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compare: Option<Compared>,
}

/// The other mesh of a comparison.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    /// Where it was read from.
    pub name: String,
    /// Sizes and metrics.
    #[serde(flatten)]
    pub summary: Summary,
}

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

/// The surface triangles of a mesh.
#[derive(Clone, Debug, Serialize)]
pub struct Surface {
    /// Triangles, walls left out.
    pub triangles: u64,
    /// Area of those with material on exactly one side, model units squared.
    pub boundary_area: f64,
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

impl Report {
    /// A region's name, or its id where it has none.
    pub fn region_name(&self, id: u32) -> String {
        let mut regions = self.summary.regions.iter();
        let found = regions.find(|r| r.id == id && !r.name.is_empty());
        found.map_or_else(|| format!("region {id}"), |r| r.name.clone())
    }

    /// Everything that is wrong, a sentence each: broken promises if asked for, and limits.
    pub fn failures(&self, promises: bool) -> Vec<String> {
        let broken = self.checks.violations.iter().filter(|_| promises);
        broken
            .map(|b| format!("{}: {}", b.promise, b.text))
            .chain(self.limits_broken.iter().cloned())
            .collect()
    }
}

/// Measures and checks a mesh; `other` is a further mesh and its name, measured for comparison with
/// the same histogram bins.
///
/// # Errors
/// Documents that name what is not there, and empty ones.
pub fn analyse(
    document: &Document,
    other: Option<(&str, &Document)>,
    params: &Params,
) -> Result<Report, Error> {
    let violations = usable(document)?;
    if let Some((_, other)) = other {
        usable(other)?;
    }
    let mut measured = measure(document, params.worst)?;
    let compared = match other {
        Some((name, other)) => Some((name, other, measure(other, 0)?)),
        None => None,
    };
    let bins: Vec<Vec<f64>> = Metric::ALL
        .iter()
        .enumerate()
        .map(|(i, &metric)| {
            let mut samples = vec![&measured.samples[i]];
            samples.extend(compared.as_ref().map(|c| &c.2.samples[i]));
            common_bins(metric, &samples, params.bins)
        })
        .collect();
    let checks = check(document, &measured, &violations)?;
    let worst = std::mem::take(&mut measured.worst);
    let summary = summary(document, measured, &bins, &params.bounds);
    let compare = compared.map(|(name, other, measured)| Compared {
        name: name.to_owned(),
        summary: crate::report::summary(other, measured, &bins, &params.bounds),
    });
    Ok(Report {
        limits_broken: params
            .limits
            .iter()
            .filter_map(|l| l.broken(&summary))
            .collect(),
        notes: notes(document),
        summary,
        worst,
        checks,
        compare,
    })
}

/// Refuses documents whose indices lead nowhere; returns what else is wrong with one.
fn usable(document: &Document) -> Result<Vec<Violation>, Error> {
    let empty = |t: &tmesh::Template| t.tets.is_empty() && t.triangles.is_empty();
    if document.templates.iter().all(empty) {
        return Err(Error::Empty);
    }
    let violations = tmesh::validate(document);
    let usable = |v: &Violation| {
        matches!(
            v,
            Violation::BadPlane { .. }
                | Violation::OffPlane { .. }
                | Violation::OffAxis { .. }
                | Violation::NotAnImage { .. }
                | Violation::TrianglesDiffer { .. }
                | Violation::MissingNeighbour { .. }
                | Violation::OpenWall { .. }
                | Violation::RepeatedInstance { .. }
        )
    };
    let unusable = violations.iter().find(|v| !usable(v));
    // Violations of walls end validation before it comes to the instances, and a thousand of any kind
    // end it anywhere.
    let unknown = (violations.len() >= 1000 || !instances_in_range(document))
        .then(|| violations.first())
        .flatten();
    match unusable.or(unknown) {
        Some(violation) => Err(Error::Invalid(violation.clone())),
        None => Ok(violations),
    }
}

fn instances_in_range(document: &Document) -> bool {
    document.instances.iter().all(|i| {
        (i.template as usize) < document.templates.len()
            && i.region_map as usize <= document.region_maps.len()
    })
}

fn summary(
    document: &Document,
    mut measured: Measured,
    bins: &[Vec<f64>],
    bounds: &[Bound],
) -> Summary {
    let symmetry = if document.is_plain() {
        let promise = document.symmetry.as_ref().and_then(|s| s.promise.as_ref());
        promise.map(|p| Realized {
            order: p.order,
            mirror: p.mirror,
            horizontal_mirror: p.horizontal_mirror,
            outside: p.outside,
        })
    } else {
        Some(realized(document))
    };
    let mut by_region = std::mem::take(&mut measured.by_region);
    let mut quality = |id: u32| {
        let samples = by_region.remove(&id).into_iter().flatten();
        let metrics = samples.filter_map(|(metric, sample)| {
            let range = vec![0.0, 1.0];
            Some((metric, sample.statistics(range)?))
        });
        RegionMetrics(metrics.collect())
    };
    let mut regions: Vec<RegionReport> = measured
        .regions
        .iter()
        .map(|(&id, amount)| RegionReport {
            id,
            name: region(document, id).map_or_else(String::new, |r| r.name.clone()),
            tetrahedra: amount.tetrahedra,
            volume: amount.volume,
            metrics: quality(id),
        })
        .collect();
    // A listed region of which nothing is left must show.
    for r in &document.regions {
        if !measured.regions.contains_key(&r.id) {
            regions.push(RegionReport {
                id: r.id,
                name: r.name.clone(),
                tetrahedra: 0,
                volume: 0.0,
                metrics: RegionMetrics::default(),
            });
        }
    }
    regions.sort_by_key(|r| r.id);
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
    Summary {
        vertices: assembled_vertices(document),
        tetrahedra: measured.total.tetrahedra,
        volume: measured.total.volume,
        regions,
        surface: crate::measure::surface(document),
        templates: document.templates.len() as u64,
        instances: document.instances.len() as u64,
        symmetry,
        metrics: Metrics(metrics),
        beyond,
    }
}

/// The region table's entry of a region id.
pub fn region(document: &Document, id: u32) -> Option<&Region> {
    let found = document.regions.binary_search_by_key(&id, |r| r.id);
    found.ok().map(|i| &document.regions[i])
}

fn notes(document: &Document) -> Vec<String> {
    let mut notes = Vec::new();
    let tets: usize = document.templates.iter().map(|t| t.tets.len()).sum();
    if tets == 0 {
        notes.push(
            "there are no tetrahedra: volumes are those enclosed by the triangles, and the checks \
             are those of a surface"
                .to_owned(),
        );
    }
    if document.instances.is_empty() {
        notes.push("no template is placed: all amounts are zero".to_owned());
    }
    if is_sector(document) {
        notes.push(
            "this is one sector on its own: its walls count as open faces, and amounts are those \
             of the sector"
                .to_owned(),
        );
    }
    for (index, template) in document.templates.iter().enumerate() {
        if template.tets.is_empty() {
            continue;
        }
        let mut used = vec![false; template.vertices.len()];
        let corners = template.tets.iter().flat_map(|t| t.vertices);
        corners.for_each(|v| used[v as usize] = true);
        let unused = used.iter().filter(|u| !**u).count();
        if unused > 0 {
            notes.push(format!(
                "{unused} vertices of template {index} belong to no tetrahedron"
            ));
        }
    }
    notes
}
