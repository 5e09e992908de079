//! All checks of a document.

use super::copies;
use super::faces::{Skin, closedness, coincident_vertices, conformity, inverted};
use super::findings::{Broken, Findings, Kind};
use super::symmetry::{instanced, plain};
use super::volume::volume_errors;
use super::walls::{self, Mesh, gluing_residual, hub_coverage};
use crate::error::Error;
use crate::instances::{Copies, is_sector, wall_triangles};
use crate::measure::Measured;
use serde::Serialize;
use tmesh::{Document, Violation};

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
    /// What there is nothing to check against, a few words each.
    pub unchecked: Vec<&'static str>,
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
    for (index, copies) in Copies::of(document).of_template.iter().enumerate() {
        if *copies == 0 {
            findings.add(Kind::Unplaced, || format!("template {index}"));
        }
    }
    let sector_of = document.source.as_ref().and_then(|s| s.sector_of);
    if let Some(instances) = sector_of {
        findings.add(Kind::Sector, || {
            format!("the input was one sector of a mesh of {instances} instances")
        });
    }
    let mut checks = Checks::default();
    let has_tets = document.templates.iter().any(|t| !t.tets.is_empty());
    let sector = is_sector(document);
    let on_wall = wall_triangles(document);
    let (skins, inverted) = check_templates(document, &on_wall, &mut findings)?;
    let mesh = Mesh {
        document,
        size: document.diagonal(),
        skins: &skins,
    };
    walls::check(mesh, &mut findings);
    if !sector {
        hub_coverage(document, &mut findings);
    }
    coincident_vertices(document, mesh.size, &mut findings);
    // Vertices of one template that coincide do so in all copies, and are reported already.
    let reported = [Kind::Coincident, Kind::NearWall, Kind::UnpairedVertex];
    if !sector && document.instances.len() > 1 && !findings.has(&reported) {
        copies::check(&mesh, &on_wall, &mut findings);
    }
    if has_tets && !sector {
        checks.check_symmetry(&mesh, violations, &mut findings);
    }
    if !sector && !document.instances.is_empty() {
        let errors = volume_errors(document, measured, &skins, &mut findings);
        checks.volume_error = errors.volume;
        checks.region_volume_error = errors.region_volume;
        checks.boundary_area_error = errors.boundary_area;
    }
    checks.unchecked = unchecked(document, has_tets, sector);
    checks.inverted = has_tets.then_some(inverted);
    checks.settle(&findings);
    Ok(checks)
}

/// What promises a document leaves nothing to be checked against.
fn unchecked(document: &Document, has_tets: bool, sector: bool) -> Vec<&'static str> {
    let mut unchecked = Vec::new();
    if sector {
        unchecked.push("the whole, as this is one sector of it");
    }
    if !has_tets {
        unchecked.push("elements, as there are none");
    }
    if document.source.is_none() {
        unchecked.push("volume and boundary, as those of the input are not in the file");
    }
    if document.is_plain() && document.promise.is_none() {
        unchecked.push("symmetry, as none is promised");
    }
    unchecked
}

/// Checks the templates one by one; returns their outer faces and the number of inverted tetrahedra.
fn check_templates(
    document: &Document,
    on_wall: &[Vec<bool>],
    findings: &mut Findings,
) -> Result<(Vec<Skin>, u64), Error> {
    let mut skins = Vec::new();
    let mut count = 0;
    for (index, template) in document.templates.iter().enumerate() {
        let inverted = inverted(document, index, findings);
        count += inverted.len() as u64;
        skins.push(if template.tets.is_empty() {
            closedness(document, index, findings);
            Skin::of_triangles(template, &on_wall[index])
        } else {
            conformity(document, index, &on_wall[index], &inverted, findings)?
        });
    }
    Ok((skins, count))
}

impl Checks {
    /// Checks what is promised: of a plain mesh by coordinates and connectivity, of instances by their
    /// placements.
    fn check_symmetry(
        &mut self,
        mesh: &Mesh<'_>,
        violations: &[Violation],
        findings: &mut Findings,
    ) {
        if !mesh.document.is_plain() {
            let missing = violations
                .iter()
                .any(|v| matches!(v, Violation::MissingNeighbour { .. }));
            let kept = instanced::check(mesh.document, findings);
            self.symmetry_residual = Some(gluing_residual(mesh));
            self.connectivity_symmetric = Some(!missing && kept);
        } else if let Some(promise) = &mesh.document.promise {
            let found = plain::check(mesh.document, promise, mesh.size, findings);
            self.symmetry_residual = Some(found.residual);
            self.connectivity_symmetric = Some(found.connectivity);
        }
    }

    /// Notes what was found.
    fn settle(&mut self, findings: &Findings) {
        self.violations = findings.broken();
        let of = |promise: &str| {
            let broken = self.violations.iter().filter(|b| b.promise == promise);
            broken.map(|b| b.count).sum::<u64>()
        };
        self.coincident_vertices = Some(of("coincidence"));
        self.conforming = Some(of("conforming") == 0);
        self.passed = self.violations.is_empty();
    }
}
