//! Checks what every assembled mesh promises.
//!
//! A plain mesh is checked as it stands. An instanced one is checked template by template, and at
//! the walls: that proves the same of the assembled mesh, because copies are congruent and meet
//! nowhere but there.

mod conformity;
mod findings;
mod surface;
mod symmetric;
#[cfg(test)]
mod tests;
mod vertices;
mod volume;
mod walls;

pub use findings::Broken;

use crate::Error;
use crate::instances::{Realized, is_sector, realized, wall_triangles};
use crate::measure::Measured;
use conformity::{Skin, conformity};
use findings::{Findings, Kind};
use geom::predicate::orientation;
use kit::number;
use serde::Serialize;
use tmesh::{Document, Outside, Promise, Violation};

/// Distance below which two vertices coincide, relative to the mesh's size (the diagonal of its
/// bounding box).
pub const COINCIDENCE: f64 = 1e-12;

/// How well a distance from the axis is known, relative to it.
const RADIUS_SLACK: f64 = 1e-9;

/// Results of the checks; `null` in JSON where one does not apply.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Checks {
    /// Whether each interior face has exactly two tetrahedra, one on each side, and each boundary face
    /// one; the surface triangles are those faces, with the right regions on their sides. For a
    /// surface: whether it bounds each region.
    pub conforming: Option<bool>,
    /// Tetrahedra whose orientation, evaluated exactly, is not positive.
    pub inverted: Option<u64>,
    /// Vertices closer than 1e-12 of the size to an earlier one.
    pub coincident_vertices: Option<u64>,
    /// Largest distance between a vertex's image and the vertex it falls on, relative to the size.
    pub symmetry_residual: Option<f64>,
    /// Whether the symmetry maps vertices, tetrahedra, regions and triangles onto such.
    pub connectivity_symmetric: Option<bool>,
    /// Relative difference between the volume and that of the input body.
    pub volume_error: Option<f64>,
    /// The largest such difference of a region.
    pub region_volume_error: Option<f64>,
    /// Relative difference between the area of the outer boundary and that of the input body.
    pub boundary_area_error: Option<f64>,
    /// Whether no promise is broken.
    pub passed: bool,
    /// The broken promises.
    pub violations: Vec<Broken>,
}

/// Checks a document that passed [`tmesh::validate`] but for the violations given.
pub fn check(
    document: &Document,
    measured: &Measured,
    violations: &[Violation],
) -> Result<Checks, Error> {
    let mut findings = Findings::new();
    for violation in violations {
        findings.add(Kind::Document, || violation.to_string());
    }
    let mut checks = Checks::default();
    let has_tets = document.templates.iter().any(|t| !t.tets.is_empty());
    let size = document.diagonal();
    let on_wall = wall_triangles(document);
    let sector = is_sector(document);

    let mut skins = Vec::new();
    let mut inverted_count = 0;
    for (index, template) in document.templates.iter().enumerate() {
        let inverted = inverted(document, index, &mut findings);
        inverted_count += inverted.len() as u64;
        skins.push(if template.tets.is_empty() {
            surface::closedness(document, index, &mut findings);
            Skin::of_triangles(template, &on_wall[index])
        } else {
            conformity(document, index, &on_wall[index], &inverted, &mut findings)?
        });
    }
    for index in 0..document.templates.len() {
        walls::check(document, index, size, &skins, &mut findings);
    }
    if !sector {
        walls::hub_coverage(document, &mut findings);
    }
    vertices::coincident_vertices(document, size, &mut findings);

    let promise = document.promise.as_ref();
    if document.is_plain() {
        if let (Some(promise), true) = (promise, has_tets) {
            let found = symmetric::check(document, promise, size, &mut findings);
            checks.symmetry_residual = Some(found.residual);
            checks.connectivity_symmetric = Some(found.connectivity);
        }
    } else if !sector && has_tets {
        checks.symmetry_residual = Some(plane_residual(document, size));
        let missing = violations
            .iter()
            .any(|v| matches!(v, Violation::MissingNeighbour { .. }));
        let realized = realized(document);
        let kept = promise.is_none_or(|p| {
            let holds = p.group.is_subgroup_of(realized.group);
            if !holds {
                findings.add(Kind::Instances, || {
                    format!(
                        "they have the symmetry {}, the document promises {}",
                        realized.group, p.group
                    )
                });
            }
            holds && outside_holds(&realized, p, &mut findings)
        });
        checks.connectivity_symmetric = Some(!missing && kept);
    }
    if !sector && !document.instances.is_empty() {
        volume::check(document, measured, &skins, &mut checks, &mut findings);
    }

    checks.inverted = has_tets.then_some(inverted_count);
    checks.violations = findings.broken();
    let coincident = checks
        .violations
        .iter()
        .filter(|b| b.promise == "coincidence");
    checks.coincident_vertices = Some(coincident.map(|b| b.count).sum());
    checks.conforming = Some(!checks.violations.iter().any(|b| b.promise == "conforming"));
    checks.passed = checks.violations.is_empty();
    Ok(checks)
}

/// Whether the instances have the symmetry that is promised away from the axis.
fn outside_holds(realized: &Realized, promise: &Promise, findings: &mut Findings) -> bool {
    let Some(promised) = promise.outside else {
        return true;
    };
    let whole = Outside {
        group: realized.group,
        radius: 0.0,
    };
    let candidates = [Some(whole), realized.outside];
    let holds = candidates.iter().flatten().any(|o| {
        promised.group.is_subgroup_of(o.group) && o.radius <= promised.radius * (1.0 + RADIUS_SLACK)
    });
    if !holds {
        findings.add(Kind::Instances, || {
            let found = realized.outside.unwrap_or(whole);
            format!(
                "they have the symmetry {} outside of the radius {}, the document promises {} outside of {}",
                found.group,
                number(found.radius),
                promised.group,
                number(promised.radius)
            )
        });
    }
    holds
}

/// Indices of the tetrahedra of a template that are flat or inside out, increasing.
fn inverted(document: &Document, index: usize, findings: &mut Findings) -> Vec<u32> {
    let template = &document.templates[index];
    let mut inverted = Vec::new();
    for (i, tet) in template.tets.iter().enumerate() {
        let [a, b, c, d] = tet.vertices.map(|v| template.vertices[v as usize]);
        let sign = orientation(a, b, c, d);
        if sign <= 0.0 || sign.is_nan() {
            inverted.push(i as u32);
            findings.add(Kind::Inverted, || {
                let what = if sign == 0.0 { "flat" } else { "inside out" };
                let place = findings::at(document, index, &tet.vertices);
                format!("tetrahedron {i} is {what} {place}")
            });
        }
    }
    inverted
}

/// Largest distance between a point of a mirror wall and its own image, relative to the size.
fn plane_residual(document: &Document, size: f64) -> f64 {
    let mut residual = 0.0_f64;
    for (index, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            if let Some(plane) = gluing.mirror_plane(index) {
                for v in gluing.vertices_here() {
                    let distance = plane.distance(template.vertices[v as usize]);
                    residual = residual.max(2.0 * distance.abs());
                }
            }
        }
    }
    if size > 0.0 { residual / size } else { 0.0 }
}
