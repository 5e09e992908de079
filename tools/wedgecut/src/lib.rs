//! Cuts one wedge out of a symmetric body: the mirror wedge of angle pi/n between two mirror planes,
//! or the rotation wedge of angle 2 pi/n whose sides are images of each other.
//!
//! Stages: into the canonical axis frame, with heights and columns made exact ([`snap`]); points
//! classified once against the two sides ([`opening`]); the surface clipped, flat patches as whole
//! polygons ([`clip`]); the sections closed by caps that carry the region interfaces ([`section`]);
//! for rotation wedges, the two sections paired and made exact images ([`seam`]).

mod clean;
mod cli;
mod clip;
mod error;
mod finish;
mod opening;
mod plan;
mod planar;
mod reconcile;
mod seam;
mod section;
mod snap;
mod surface;
#[cfg(test)]
mod tests;

pub use cli::Cli;
pub use error::CutError;
pub use plan::{Domain, Params};

use glam::DVec3;
use opening::{Opening, Side};
use plan::Plan;
use section::{Extent, Section};
use surface::Surface;
use tmesh::{Document, Frame, Source, Symmetry, Template};

/// Multiple of the input's precision within which values count as equal: rotation into the axis
/// frame adds up three coordinates' errors, and the axis has an error of its own.
const PRECISION_REACH: f64 = 16.0;
/// Smallest distance, relative to the radius about the axis, within which values count as equal.
const ROUNDING_REACH: f64 = 1e-10;
/// Largest distance, relative to the radius about the axis, that a point is moved onto a cut plane
/// because the body is only nearly symmetric.
const LARGEST_SNAP: f64 = 1e-4;

/// What the cut did, besides its result.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Sentences for the history and `-v`.
    pub notes: Vec<String>,
}

/// Cuts the wedge out of a body.
///
/// The document needs a symmetry and one surface template in world coordinates. The result has the
/// wedge's surface as its template, in the canonical frame, with walls, axis vertices, and one
/// instance per copy.
///
/// # Errors
/// Missing symmetry, an order or domain the body does not have, sections that are not clean or do
/// not match.
pub fn cut(document: Document, params: &Params) -> Result<(Document, Report), CutError> {
    let symmetry = document.symmetry.clone().ok_or(CutError::NoSymmetry)?;
    if !document.is_plain() || !document.frame.is_identity() {
        return Err(CutError::NotASurface("this document has been cut already"));
    }
    if !document.templates[0].tets.is_empty() {
        return Err(CutError::NotASurface("this document holds a volume mesh"));
    }
    let plan = Plan::new(&symmetry, params)?;
    let mut document = document;
    let mut template = std::mem::take(&mut document.templates[0]);
    let tolerances = Tolerances::new(&template, &symmetry, document.source.as_ref(), params);
    document.frame = frame(&symmetry, &plan, params, &template.vertices, &tolerances)?;
    for p in &mut template.vertices {
        *p = document.frame.to_canonical(*p);
    }
    let body_volume = total_volume(&template);
    let body_area = geom::measure::boundary_area(&template);
    let snapped = snap::snap_heights_and_columns(&mut template.vertices, tolerances.equal);
    let mut notes = vec![format!(
        "{} wedge of order {} ({} copies), points within {:.1e} of a cut plane moved onto it, \
         heights and columns within {:.1e} made equal (largest movement {snapped:.1e})",
        if plan.mirror { "mirror" } else { "rotation" },
        plan.order,
        plan.instances.len(),
        tolerances.plane,
        tolerances.equal,
    )];
    let wedge = cut_wedge(template, &plan, &tolerances, &document.frame, &mut notes)?;
    document.templates = vec![wedge];
    document.instances = plan.instances;
    document.region_maps = plan.region_maps;
    let copies = document.instances.len();
    let wedge_volume = total_volume(&document.templates[0]) * copies as f64;
    let relative = (wedge_volume - body_volume).abs() / body_volume.abs();
    let drift =
        symmetry.residual.max(0.0) * tolerances.radius + tolerances.plane + tolerances.detail;
    let allowed = 1e-6 + 4.0 * drift * body_area / body_volume.abs();
    if document.templates[0].triangles.is_empty() {
        return Err(CutError::Empty);
    }
    if relative > allowed {
        return Err(CutError::VolumeDiffers {
            copies,
            wedge: wedge_volume,
            body: body_volume,
            relative,
            allowed,
        });
    }
    notes.push(format!(
        "{copies} copies of the wedge differ from the body's volume by {relative:.1e}"
    ));
    Ok((document, Report { notes }))
}

/// Distances, model units.
struct Tolerances {
    /// Largest distance of a point from the axis.
    radius: f64,
    /// Values that count as equal.
    equal: f64,
    /// Points that count as on a plane.
    plane: f64,
    /// Faces that count as in one plane.
    flat: f64,
    /// Edges that are collapsed; 0 for none.
    detail: f64,
    /// Points of the two sections that count as partners.
    partner: f64,
}

impl Tolerances {
    fn new(
        template: &Template,
        symmetry: &Symmetry,
        source: Option<&Source>,
        params: &Params,
    ) -> Self {
        let (point, axis) = (
            DVec3::from(symmetry.axis.point),
            DVec3::from(symmetry.axis.direction),
        );
        let radius = template
            .vertices
            .iter()
            .map(|&p| (p - point).cross(axis).length())
            .fold(0.0, f64::max);
        let height = template
            .vertices
            .iter()
            .map(|&p| (p - point).dot(axis).abs())
            .fold(0.0, f64::max);
        let size = radius.max(height);
        let precision = source.map_or(0.0, |s| s.precision);
        let equal = (PRECISION_REACH * precision).max(ROUNDING_REACH * size);
        let drift = symmetry.residual.max(0.0) * radius;
        let plane = match params.snap {
            Some(relative) => (relative * radius).max(ROUNDING_REACH * size),
            None => equal.max((2.0 * drift).min(LARGEST_SNAP * radius)),
        };
        let partner = (4.0 * drift).max(4.0 * equal).max(2.0 * plane);
        Self {
            radius,
            equal,
            plane,
            flat: equal,
            detail: params.clean * radius,
            partner,
        }
    }
}

/// The canonical frame: z along the axis, x in the first side of the wedge.
fn frame(
    symmetry: &Symmetry,
    plan: &Plan,
    params: &Params,
    vertices: &[DVec3],
    tolerances: &Tolerances,
) -> Result<Frame, CutError> {
    let axis = DVec3::from(symmetry.axis.direction);
    let origin = DVec3::from(symmetry.axis.point);
    let reference = DVec3::from(symmetry.mirror_direction);
    let bad = || CutError::BadAxis(axis.x, axis.y, axis.z);
    let base = Frame::from_axis(origin, axis, reference)
        .filter(|f| f.rotation.is_finite() && f.origin.is_finite())
        .ok_or_else(bad)?;
    let angle = if plan.mirror {
        let step = std::f64::consts::PI / f64::from(symmetry.order);
        let angle = params.start_angle.unwrap_or(0.0);
        let planes = (angle / step).round();
        if (angle - planes * step).abs() > 1e-9 {
            let (angle, step) = (angle.to_degrees(), step.to_degrees());
            return Err(CutError::NotAMirrorPlane { angle, step });
        }
        angle
    } else if plan.is_whole() {
        0.0
    } else {
        params.start_angle.unwrap_or_else(|| {
            let canonical: Vec<DVec3> = vertices.iter().map(|&p| base.to_canonical(p)).collect();
            plan::clear_angle(&canonical, plan.order, tolerances.plane)
        })
    };
    if angle == 0.0 {
        return Ok(base);
    }
    let x = base.rotation * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
    Frame::from_axis(origin, axis, x).ok_or_else(bad)
}

fn cut_wedge(
    template: Template,
    plan: &Plan,
    tolerances: &Tolerances,
    frame: &Frame,
    notes: &mut Vec<String>,
) -> Result<Template, CutError> {
    if plan.is_whole() {
        let mut surface =
            Surface::new(template.vertices, template.triangles, None, tolerances.flat);
        collapse(&mut surface, tolerances, notes);
        return finish::whole(surface, frame);
    }
    let opening = Opening::new(plan.opening, tolerances.plane);
    let mut surface = Surface::new(
        template.vertices,
        template.triangles,
        Some(&opening),
        tolerances.flat,
    );
    let split_at_axis = plan.is_half() && !plan.mirror;
    for &side in opening.sides() {
        clip::clip(&mut surface, &opening, side, split_at_axis);
    }
    collapse(&mut surface, tolerances, notes);
    let far = if plan.is_half() {
        Extent::FarHalf
    } else {
        Extent::HalfPlane(Side::B)
    };
    if plan.mirror {
        let extents = if plan.is_half() {
            vec![Extent::WholePlane]
        } else {
            vec![Extent::HalfPlane(Side::A), far]
        };
        let mut caps = Vec::new();
        for extent in extents {
            let section = Section::new(&surface, &opening, extent);
            caps.push(section.cap(&surface, &opening, frame)?);
        }
        return finish::mirror_wedge(surface, caps, plan, &opening, frame);
    }
    let mut low = Section::new(&surface, &opening, Extent::HalfPlane(Side::A));
    let mut high = Section::new(&surface, &opening, far);
    let matched = seam::match_sections(
        &mut surface,
        &opening,
        plan.opening,
        &mut low,
        &mut high,
        tolerances.partner,
        frame,
    )?;
    notes.push(format!(
        "{} point pairs on the seam, moved by {:.1e} at most; {} points that only one side had",
        matched.pairs.len(),
        matched.moved,
        matched.inserted,
    ));
    let cap = low.cap(&surface, &opening, frame)?;
    finish::rotation_wedge(surface, cap, matched, plan, frame)
}

fn collapse(surface: &mut Surface, tolerances: &Tolerances, notes: &mut Vec<String>) {
    if tolerances.detail > 0.0 {
        let collapsed = clean::collapse_short_edges(surface, tolerances.detail);
        notes.push(format!(
            "edges below {:.1e} collapsed: {} points and {} faces fewer",
            tolerances.detail, collapsed.points, collapsed.faces
        ));
    }
}

fn total_volume(template: &Template) -> f64 {
    // Interfaces have a region on both sides and cancel.
    let origin = template.vertices.first().copied().unwrap_or_default();
    template
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = geom::measure::corners(&template.vertices, t);
            let volume = geom::measure::tet_volume(origin, a, b, c);
            let inside = |region: u32| f64::from(u8::from(region != tmesh::OUTSIDE));
            volume * (inside(t.back) - inside(t.front))
        })
        .sum()
}
