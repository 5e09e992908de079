//! What there is to say about a mesh.

use crate::check::{Checks, check};
use crate::error::Error;
use crate::instances::is_sector;
use crate::measure::{Bound, Limit, Metric, Summary, Worst, common_bins, measure};
use crate::soundness::usable;
use kit::shortfalls;
use serde::Serialize;
use tmesh::Document;

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
    /// What the mesh does not meet of the bounds that it says were asked for, a sentence each.
    pub shortfalls: Vec<String>,
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

impl Report {
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
    let mut measured = measure(document, params.worst);
    let compared = other.map(|(name, other)| (name, other, measure(other, 0)));
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
    let summary = Summary::new(document, measured, &bins, &params.bounds);
    let compare = compared.map(|(name, other, measured)| Compared {
        name: name.to_owned(),
        summary: Summary::new(other, measured, &bins, &params.bounds),
    });
    Ok(Report {
        limits_broken: params
            .limits
            .iter()
            .filter_map(|l| l.broken(&summary))
            .collect(),
        shortfalls: shortfalls(document),
        notes: notes(document),
        summary,
        worst,
        checks,
        compare,
    })
}

/// What a reader should know to understand the figures, a sentence each.
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
