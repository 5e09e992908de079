//! Cuts one wedge out of a symmetric body: the mirror wedge of angle pi/n between two mirror planes,
//! or the rotation wedge of angle 2 pi/n whose sides are images of each other.
//!
//! Stages: into the canonical axis frame, with heights and columns made exact ([`snap`]), and what is beside mirror
//! planes moved onto them where that changes nothing ([`slide`]); points
//! classified once against the two sides ([`opening`]); the surface clipped, flat patches as whole
//! polygons ([`clip`]); the sections closed by caps that carry the region interfaces ([`section`]);
//! for rotation wedges, the two sections paired and made exact images ([`seam`]); where there is a
//! hub, what lies in front of its plane united to a template of its own ([`hub`]).

mod align;
mod chains;
mod clean;
mod cli;
mod clip;
mod error;
mod finish;
mod hub;
mod names;
mod opening;
mod plan;
mod reconcile;
mod seam;
mod section;
mod slide;
mod snap;
mod surface;
#[cfg(test)]
mod tests;

pub use cli::Cli;
pub use error::CutError;
pub use plan::{Domain, Hub, Params};

use estimate::harm::{halved, sliced};
use estimate::{Bounds, CostModel, Cut, Estimate, Hubs, Way, Ways, edge_of_volume};
use finish::Caps;
use glam::DVec3;
use opening::{HubPlane, Opening, Side};
use plan::{HubPlan, Plan};
use section::{Borders, Extent, Section};
use std::collections::BTreeMap;
use surface::Surface;
use tmesh::{Document, Frame, Region, Source, Symmetry, Template, Triangle};

/// Multiple of the input's precision within which values count as equal: rotation into the axis
/// frame adds up three coordinates' errors, and the axis has an error of its own.
const PRECISION_REACH: f64 = 16.0;
/// Smallest distance, relative to the radius about the axis, within which values count as equal.
const ROUNDING_REACH: f64 = 1e-10;
/// Largest distance, relative to the radius about the axis, that a point is moved onto a cut plane
/// because the body is only nearly symmetric.
const LARGEST_SNAP: f64 = 1e-4;
/// The same of the axis; a point in the middle of a flat face is off it by more than the surface shows.
const LARGEST_AXIS_SNAP: f64 = 5e-4;

/// How far a point is moved onto a mirror plane along the surface, in multiples of what the body is symmetric to
/// and relative to the radius about the axis.
const SLIDE: f64 = 16.0;
const LARGEST_SLIDE: f64 = 5e-4;

/// What the cut did, besides its result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Sentences for the history and `-v`.
    pub notes: Vec<String>,
    /// How much the seam harms the faces it slices, see [`sliced::Harm`]; zero for mirror planes, whose
    /// section the body has anyway.
    pub harm: f64,
    /// What the user should know at once: that the cut is at a bad place, and where a better one is.
    pub warning: Option<String>,
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
    let plan = Plan::new(&symmetry, params, false)?;
    let body = &document.templates[0];
    let tolerances = Tolerances::new(body, &symmetry, document.source.as_ref(), params);
    let hub = match params.hub {
        Hub::Radius(radius) => Some(plan.hub(radius)?),
        Hub::Auto | Hub::None => None,
    };
    if !params.chooses() || plan.is_whole() {
        return cut_as_planned(&document, &symmetry, &plan, hub, params, &tolerances);
    }
    // Order and hub are chosen by the wedge of the order found, or of the highest that can be cut.
    let mut uncut = Uncut::default();
    let mut orders = match params.order {
        Some(order) => vec![order],
        None => orders(&symmetry, params, plan.mirror),
    };
    let (first, report) = loop {
        let order = orders.pop().unwrap_or(symmetry.group.order);
        let with = Params {
            order: Some(order),
            ..params.clone()
        };
        let plan = Plan::new(&symmetry, &with, false)?;
        match cut_as_planned(&document, &symmetry, &plan, None, &with, &tolerances) {
            Ok(cut) => break cut,
            Err(error) if error.is_of_the_shape() => {
                uncut.0.push((order, error));
                if orders.is_empty() {
                    return Err(uncut.first());
                }
            }
            Err(error) => return Err(error),
        }
    };
    loop {
        let Some((choice, why)) = choose(&document, (&first, &report), &symmetry, params, &uncut)
        else {
            if !uncut.0.is_empty() {
                return Err(uncut.first());
            }
            return match hub {
                None => Ok((first, report)),
                Some(_) => {
                    let plan = Plan::new(&symmetry, params, false)?;
                    cut_as_planned(&document, &symmetry, &plan, hub, params, &tolerances)
                }
            };
        };
        let first = (&first, &report);
        match cut_as_chosen(&document, &symmetry, &choice, first, params, &tolerances) {
            Ok((document, mut report)) => {
                report.notes.extend(uncut.notes());
                report.notes.push(why);
                return Ok((document, report));
            }
            Err(error) if error.is_of_the_shape() && params.order.is_none() => {
                uncut.0.push((choice.order, error));
            }
            Err(error) => return Err(error),
        }
    }
}

/// Orders that could not be cut, and why.
#[derive(Default)]
struct Uncut(Vec<(u32, CutError)>);

impl Uncut {
    /// Why the order that was tried first could not be cut.
    fn first(self) -> CutError {
        let first = self.0.into_iter().next();
        first.map_or(CutError::Empty, |(_, error)| error)
    }

    fn has(&self, order: u32) -> bool {
        self.0.iter().any(|(o, _)| *o == order)
    }

    fn notes(&self) -> Vec<String> {
        let note = |(order, error): &(u32, CutError)| format!("order {order} not cut: {error}");
        self.0.iter().map(note).collect()
    }
}

/// Cuts with the order, hub and planes chosen, with fewer planes if it has to be. `first`: the wedge
/// that they were chosen by.
fn cut_as_chosen(
    document: &Document,
    symmetry: &Symmetry,
    choice: &Choice,
    first: (&Document, &Report),
    params: &Params,
    tolerances: &Tolerances,
) -> Result<(Document, Report), CutError> {
    let params = Params {
        order: Some(choice.order),
        ..params.clone()
    };
    // A plane that nobody asked for must not be in the way.
    let may_drop = params.hub == Hub::Auto;
    let mut tried = vec![(choice.hub, choice.level), (choice.hub, false)];
    if may_drop {
        tried.extend([(None, choice.level), (None, false)]);
    }
    tried.dedup();
    let mut failed = None;
    for (radius, level) in tried {
        let plan = Plan::new(symmetry, &params, level)?;
        let hub = radius.map(|radius| plan.hub(radius)).transpose()?;
        let (document, mut report) =
            if hub.is_none() && !level && first.0.instances.len() == plan.instances.len() {
                (first.0.clone(), first.1.clone())
            } else {
                match cut_as_planned(document, symmetry, &plan, hub, &params, tolerances) {
                    Ok(cut) => cut,
                    Err(error) => {
                        failed.get_or_insert(error);
                        continue;
                    }
                }
            };
        if let Some(error) = failed {
            report.notes.push(format!("cut with fewer planes: {error}"));
        }
        return Ok((document, report));
    }
    Err(failed.unwrap_or(CutError::Empty))
}

/// Orders to choose from, increasing: the divisors of the order found.
fn orders(symmetry: &Symmetry, params: &Params, mirror: bool) -> Vec<u32> {
    // A mesh without symmetry is not what a symmetric body is cut for.
    let least = match params.hub {
        _ if symmetry.group.order == 1 => 1,
        Hub::Radius(_) => plan::HUB_LEAST_ORDER,
        _ if mirror => 1,
        _ => 2,
    };
    let mut orders = plan::divisors(symmetry.group.order);
    orders.retain(|&n| n >= least);
    orders
}

/// What has been chosen.
struct Choice {
    order: u32,
    hub: Option<f64>,
    level: bool,
}

/// Chooses order and hub, and says why.
fn choose(
    document: &Document,
    (wedge, report): (&Document, &Report),
    symmetry: &Symmetry,
    params: &Params,
    uncut: &Uncut,
) -> Option<(Choice, String)> {
    let first = wedge.templates[0].gluings.first();
    let mirror = first.is_some_and(|gluing| gluing.is_mirror(0));
    let max_volume = |region: u32| params.max_volume_of(&wedge.regions, region);
    let mut orders = match params.order {
        Some(order) => vec![order],
        None => orders(symmetry, params, mirror),
    };
    orders.retain(|&n| !uncut.has(n));
    let keeps_names = names::keeps_names(
        &document.templates[0],
        DVec3::from(symmetry.axis.point),
        DVec3::from(symmetry.axis.direction),
    );
    let level = params.level && symmetry.group.has_horizontal_mirror() && keeps_names;
    let levels: &[bool] = if level { &[false, true] } else { &[false] };
    let harm = report.harm;
    let cut = |order: u32, across: bool| {
        let images = [mirror, across].map(|on| if on { 2.0 } else { 1.0 });
        let images = images[0] * images[1];
        let full = if mirror { 1.0 } else { 2.0 };
        let angle = full * std::f64::consts::PI / f64::from(order);
        Cut {
            order,
            angle,
            copies: images * f64::from(order),
            hub_copies: images * f64::from(plan::hub_order(order, mirror)),
            reach: 1.0
                / if mirror {
                    angle.cos()
                } else {
                    (0.5 * angle).cos()
                },
            free: mirror,
            across,
            harm: harm * f64::from(order),
            hub: true,
        }
    };
    // Half a turn between the faces of a seam is left whole: three walls in two planes.
    let cuts: Vec<Cut> = (orders.iter())
        .flat_map(|&order| {
            let half = order == 2 && !mirror;
            let levels = levels.iter().filter(move |&&level| !(level && half));
            levels.map(move |&level| (order, level))
        })
        .map(|(order, level)| cut(order, level))
        .collect();
    let (body, copies) = (&document.templates[0], wedge.instances.len());
    let size = element_size(&document.regions, body, params);
    let needles = estimate::needles(body, size);
    let first = estimate::Wedge::new(&wedge.templates[0], copies);
    let model = CostModel::CALIBRATED;
    let estimate = Estimate::new(model, &first, needles, max_volume, params.threads);
    let bounds = Bounds {
        radius_edge: params.radius_edge,
        hubs: match params.hub {
            Hub::Radius(radius) => Hubs::Radius(radius),
            Hub::None => Hubs::None,
            Hub::Auto => Hubs::Free,
        },
    };
    let ways = Ways::new(&estimate, &cuts, bounds);
    let choice = ways.ranked().first().copied()?;
    let planes = |c: &Way| {
        let hub = c.hub.map(|r| format!(" with a hub of {r:.3}"));
        hub.unwrap_or_default() + if cuts[c.cut].across { " halved" } else { "" }
    };
    let list: Vec<String> = (ways.list.iter())
        .map(|c| format!("{}{} {:.2}", cuts[c.cut].order, planes(c), c.elements))
        .collect();
    let why = format!(
        "order {} of {}{}: the fastest that costs few elements; estimated elements over those of the whole body by \
         order: {}",
        cuts[choice.cut].order,
        symmetry.group.order,
        planes(&choice),
        list.join(", "),
    );
    let chosen = Choice {
        order: cuts[choice.cut].order,
        hub: choice.hub,
        level: cuts[choice.cut].across,
    };
    Some((chosen, why))
}

/// Cuts as a plan says, elsewhere if it cannot be done where it is best.
fn cut_as_planned(
    document: &Document,
    symmetry: &Symmetry,
    plan: &Plan,
    hub: Option<HubPlan>,
    params: &Params,
    tolerances: &Tolerances,
) -> Result<(Document, Report), CutError> {
    let places = places(document, symmetry, plan, params, tolerances)?;
    let mut failed = None;
    for (i, &(frame, harm)) in places.frames.iter().enumerate() {
        match cut_in_frame(document, symmetry, plan.clone(), hub, frame, tolerances) {
            Ok((document, mut report)) => {
                report.harm = harm;
                report.warning = places.warning;
                if let Some(error) = failed {
                    report.notes.push(format!(
                        "cut at the angle tried as number {} (--start-angle says which): {error}",
                        i + 1
                    ));
                }
                return Ok((document, report));
            }
            Err(error) => failed = failed.or(Some(error)),
        }
    }
    Err(failed.unwrap_or(CutError::Empty))
}

/// Cuts with the first side in the frame's plane y = 0.
fn cut_in_frame(
    document: &Document,
    symmetry: &Symmetry,
    mut plan: Plan,
    hub: Option<HubPlan>,
    frame: Frame,
    tolerances: &Tolerances,
) -> Result<(Document, Report), CutError> {
    let mut document = document.clone();
    let mut template = std::mem::take(&mut document.templates[0]);
    document.frame = frame;
    for p in &mut template.vertices {
        *p = document.frame.to_canonical(*p);
    }
    let body_volumes = region_volumes(&template);
    let body_volume: f64 = body_volumes.values().sum();
    let body_area = geom::measure::boundary_area(&template);
    let snapped = snap::snap_heights_and_columns(&mut template.vertices, tolerances.equal);
    let mut notes = vec![format!(
        "{} wedge of order {} ({} copies), points within {:.1e} of a cut plane and {:.1e} of the axis moved onto it, \
         heights and columns within {:.1e} made equal (largest movement {snapped:.1e})",
        if plan.mirror { "mirror" } else { "rotation" },
        plan.order,
        plan.instances.len(),
        tolerances.plane,
        tolerances.axis,
        tolerances.equal,
    )];
    if plan.mirror && tolerances.slide > 0.0 {
        let slid = slide::slide(
            &mut template.vertices,
            &template.triangles,
            &walls(&plan),
            tolerances.slide,
            tolerances.drift,
        );
        notes.push(format!(
            "{slid} points within {:.1e} of a cut plane moved onto it along the surface",
            tolerances.slide
        ));
    }
    let cutter = Cutter {
        plan: &plan,
        hub,
        tolerances,
        frame: &document.frame,
    };
    document.templates = cutter.cut(template, &mut notes)?;
    let copies = plan.instances.len();
    if let Some(hub) = &hub {
        plan.add_hub(hub);
        notes.push(format!(
            "hub of inscribed radius {} and order {} ({} copies), a template of its own",
            hub.radius,
            hub.order,
            plan.instances.len() - copies,
        ));
    }
    document.instances = plan.instances;
    document.region_maps = plan.region_maps;
    if document.templates[0].triangles.is_empty() {
        return Err(CutError::Empty);
    }
    let volumes: Vec<BTreeMap<u32, f64>> = document.templates.iter().map(region_volumes).collect();
    let mut of_copies: BTreeMap<u32, f64> = BTreeMap::new();
    for instance in &document.instances {
        for (&region, volume) in &volumes[instance.template as usize] {
            *of_copies
                .entry(document.placed_region(instance, region))
                .or_default() += volume;
        }
    }
    let wedge_volume: f64 = of_copies.values().sum();
    let relative = (wedge_volume - body_volume).abs() / body_volume.abs();
    let drift = symmetry.residual.max(0.0) * tolerances.radius
        + tolerances.plane
        + tolerances.detail
        + tolerances.near;
    let allowed = 1e-6 + 4.0 * drift * body_area / body_volume.abs();
    if relative > allowed {
        return Err(CutError::VolumeDiffers {
            copies,
            wedge: wedge_volume,
            body: body_volume,
            relative,
            allowed,
        });
    }
    for (&region, &body) in &body_volumes {
        let wedge = of_copies.get(&region).copied().unwrap_or_default();
        let allowed = allowed * body_volume.abs();
        if (wedge - body).abs() > allowed {
            return Err(CutError::RegionVolumeDiffers {
                region,
                copies,
                wedge,
                body,
                allowed,
            });
        }
    }
    notes.push(format!(
        "{copies} copies of the wedge differ from the body's volume by {relative:.1e}"
    ));
    let report = Report {
        notes,
        ..Report::default()
    };
    Ok((document, report))
}

/// The mirror planes that bound a wedge.
fn walls(plan: &Plan) -> Vec<slide::Plane> {
    let (cos, sin) = plan.opening.cos_sin();
    let wall = |outward: DVec3| slide::Plane {
        normal: DVec3::Z.cross(outward),
        outward,
    };
    let mut walls = vec![wall(DVec3::X), wall(DVec3::new(cos, sin, 0.0))];
    if plan.level {
        walls.push(slide::Plane {
            normal: DVec3::Z,
            outward: DVec3::ZERO,
        });
    }
    walls
}

/// Distances, model units.
struct Tolerances {
    /// Largest distance of a point from the axis.
    radius: f64,
    /// Values that count as equal.
    equal: f64,
    /// Points that count as on a plane.
    plane: f64,
    /// Points that count as on the axis: of a body that is only nearly symmetric, the middle of a face may be off
    /// it by more than what is moved onto a plane.
    axis: f64,
    /// Faces that count as in one plane.
    flat: f64,
    /// Edges that are collapsed; 0 for none.
    detail: f64,
    /// Edges at the cut planes that are collapsed: what the body is symmetric to.
    near: f64,
    /// Points of the two sections that count as partners.
    partner: f64,
    /// What the body is symmetric to.
    drift: f64,
    /// Points that are moved onto a mirror plane along the surface; 0 for none.
    slide: f64,
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
        let detail = params.clean * radius;
        // Partners up to half of that apart are one point: two would leave detail that is collapsed elsewhere.
        let partner = (4.0 * drift)
            .max(4.0 * equal)
            .max(2.0 * plane)
            .max(2.0 * detail);
        Self {
            radius,
            equal,
            plane,
            axis: match params.snap {
                Some(_) => plane,
                None => plane.max((4.0 * drift).min(LARGEST_AXIS_SNAP * radius)),
            },
            flat: equal,
            detail,
            near: match params.clean > 0.0 && drift > detail {
                true => drift,
                false => 0.0,
            },
            partner,
            drift,
            slide: match params.snap {
                None if drift > equal => (LARGEST_SLIDE * radius).min(SLIDE * drift),
                _ => 0.0,
            },
        }
    }
}

/// The size of elements beside a triangle, model units: as asked for, at most that of the body.
fn element_size(regions: &[Region], body: &Template, params: &Params) -> impl Fn(&Triangle) -> f64 {
    let low = body.vertices.iter().copied().reduce(DVec3::min);
    let high = body.vertices.iter().copied().reduce(DVec3::max);
    let extent = low.zip(high).map_or(0.0, |(a, b)| a.distance(b));
    move |t| {
        let cap = |region| params.max_volume_of(regions, region).map(edge_of_volume);
        let caps = [t.front, t.back].into_iter().filter_map(cap);
        caps.fold(extent, f64::min)
    }
}

/// How many places of the seam are tried, at most.
const TRIALS: usize = 4;
/// Harm from which a seam at an angle that was asked for is told, see [`sliced::Harm`], if another place does
/// so many times less.
const HARMFUL: f64 = 20.0;
const LESS: f64 = 4.0;
/// Harm from which it is refused: each copy would get so many elements more, in units of [`ELEMENTS`].
const USELESS: f64 = 2000.0;
/// Elements that a unit of harm costs, see [`sliced::Harm::sliced`].
const ELEMENTS: f64 = 100.0;

/// Where a seam may be.
struct Places {
    /// The canonical frames to try, z along the axis, x in the first side of the wedge, with the harm that a
    /// seam there does: of rotation wedges some that start elsewhere, unless it was said where, the
    /// least harm first.
    frames: Vec<(Frame, f64)>,
    /// That the place asked for is a bad one.
    warning: Option<String>,
}

fn places(
    document: &Document,
    symmetry: &Symmetry,
    plan: &Plan,
    params: &Params,
    tolerances: &Tolerances,
) -> Result<Places, CutError> {
    let body = &document.templates[0];
    let axis = DVec3::from(symmetry.axis.direction);
    let origin = DVec3::from(symmetry.axis.point);
    let reference = DVec3::from(symmetry.reference);
    let bad = || CutError::BadAxis(axis.x, axis.y, axis.z);
    let base = Frame::from_axis(origin, axis, reference)
        .filter(|f| f.rotation.is_finite() && f.origin.is_finite())
        .ok_or_else(bad)?;
    let canonical = || -> Vec<DVec3> {
        let to_canonical = |&p| base.to_canonical(p);
        body.vertices.iter().map(to_canonical).collect()
    };
    let mut warning = None;
    let angles = if plan.mirror {
        let step = std::f64::consts::PI / f64::from(symmetry.group.order);
        // Both walls are images of the same mirror plane, and there are others to choose, unless they rename
        // regions differently.
        let choice = (symmetry.group.order / plan.order).is_multiple_of(2)
            && symmetry.rotation_regions().pairs.is_empty();
        let angle = params.start_angle.unwrap_or_else(|| {
            if !choice {
                return 0.0;
            }
            let vertices = canonical();
            let both = [0.0, step];
            let [given, other] =
                both.map(|a| halved::harm(&vertices, &body.triangles, a, tolerances.plane));
            let [cut, less] =
                both.map(|a| halved::crossed(&vertices, &body.triangles, a, tolerances.plane));
            // Rounding does not choose.
            let alike = (given - other).abs() <= 1e-6 * given.max(other);
            let is_better = if alike { less < cut } else { other < given };
            if is_better { step } else { 0.0 }
        });
        vec![(angle, 0.0)]
    } else if plan.is_whole() {
        vec![(0.0, 0.0)]
    } else {
        let vertices = canonical();
        let size = element_size(&document.regions, body, params);
        let harm =
            |angle: f64| sliced::harm(&vertices, &body.triangles, angle, tolerances.plane, &size);
        let clear = plan::clear_angles(&vertices, plan.order, tolerances.plane);
        let mut list: Vec<_> = clear.into_iter().map(|a| (a, harm(a))).collect();
        // Stable, and rounding does not choose: the clearest place stays first among equals.
        let class = |harm: sliced::Harm| (harm.total() * 1e3).round();
        list.sort_by(|a, b| class(a.1).total_cmp(&class(b.1)));
        if let Some(angle) = params.start_angle {
            let given = harm(angle);
            warning = is_harmful(angle, given, list[0])?;
            list = vec![(angle, given)];
        }
        list.truncate(TRIALS);
        list.into_iter().map(|(a, harm)| (a, harm.sliced)).collect()
    };
    let at = |(angle, harm): (f64, f64)| {
        if angle == 0.0 {
            return Ok((base, harm));
        }
        let x = base.rotation * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
        let frame = Frame::from_axis(origin, axis, x).ok_or_else(bad)?;
        Ok((frame, harm))
    };
    let frames = angles.into_iter().map(at).collect::<Result<_, _>>()?;
    Ok(Places { frames, warning })
}

/// Says that the place of a seam, as an angle (radians) and the harm there, is a bad one, if there is a much
/// better one.
///
/// # Errors
/// The same of a place that makes the mesh useless.
fn is_harmful(
    angle: f64,
    harm: sliced::Harm,
    best: (f64, sliced::Harm),
) -> Result<Option<String>, CutError> {
    let (given, least) = (harm.total(), best.1.total());
    if given <= HARMFUL.max(LESS * least) {
        return Ok(None);
    }
    let error = CutError::BadPlace {
        angle: (angle.to_degrees() * 1e9).round() / 1e9,
        elements: ELEMENTS * given,
        better: (best.0.to_degrees() * 1e4).round() / 1e4,
        fewer: ELEMENTS * least,
    };
    if given > USELESS {
        return Err(error);
    }
    Ok(Some(error.to_string()))
}

/// What is needed to cut the templates.
struct Cutter<'a> {
    plan: &'a Plan,
    hub: Option<HubPlan>,
    tolerances: &'a Tolerances,
    frame: &'a Frame,
}

impl Cutter<'_> {
    fn cut(&self, body: Template, notes: &mut Vec<String>) -> Result<Vec<Template>, CutError> {
        let (plan, tolerances, frame) = (self.plan, self.tolerances, self.frame);
        if plan.is_whole() {
            let mut surface = Surface::new(body.vertices, body.triangles, None, tolerances.flat);
            collapse(&mut surface, tolerances, notes);
            return Ok(vec![finish::whole(&surface, frame)?]);
        }
        let plane = self
            .hub
            .map(|hub| HubPlane::new(hub.radius, plan.opening, plan.mirror));
        let opening = Opening::new(plan.opening, tolerances.plane)
            .with_axis(tolerances.axis)
            .with_hub(plane)
            .with_level(plan.level);
        let context = finish::Context { plan, frame };
        let mut surface = Surface::new(
            body.vertices,
            body.triangles,
            Some(&opening),
            tolerances.flat,
        );
        let split_at_axis = plan.is_half() && !plan.mirror;
        for &side in opening.sides() {
            clip::clip(&mut surface, &opening, side, split_at_axis);
        }
        collapse(&mut surface, tolerances, notes);
        if tolerances.near > 0.0 {
            let joined = clean::collapse_at_sides(&mut surface, tolerances.near);
            notes.push(format!(
                "{joined} points within {:.1e} of others on a cut plane joined to them",
                tolerances.near
            ));
        }
        if self.hub.is_some() {
            clip::divide_at_hub(&mut surface, &opening);
        }
        if !(plan.is_half() && plan.mirror) {
            surface.add_corners(&opening);
        }
        let matched = if plan.mirror {
            None
        } else {
            Some(self.match_seam(&mut surface, &opening, notes)?)
        };
        let faces = std::mem::take(&mut surface.faces);
        let (outer, inner): (Vec<Triangle>, Vec<Triangle>) = faces.into_iter().partition(|f| {
            f.vertices
                .iter()
                .all(|&v| surface.classes[v as usize].hub >= 0)
        });

        let hub_cap = match &self.hub {
            Some(hub) => self.hub_cap(&mut surface, &opening, &outer, &inner, hub)?,
            None => Vec::new(),
        };
        let caps = self.caps(&mut surface, &opening, &outer)?;
        let wedge = match &matched {
            None => finish::mirror_wedge(&surface, outer, &caps, &hub_cap, &context)?,
            Some(matched) => {
                finish::rotation_wedge(&surface, outer, &caps, &hub_cap, matched, &context)?
            }
        };
        let Some(hub) = &self.hub else {
            return Ok(vec![wedge.template]);
        };
        let caps = self.caps(&mut surface, &opening, &inner)?;
        let inner = hub::Inner {
            surface: &surface,
            faces: &inner,
            low: &caps.sides[0],
            high: caps.sides.get(1).map_or(&[], |cap| cap),
            level: caps.level.as_deref(),
            pairs: matched.as_ref().map_or(&[], |m| &m.pairs),
            hub: &hub_cap,
        };
        let united = hub::unite(&inner, &wedge, plan, hub, frame)?;
        Ok(vec![wedge.template, united])
    }

    /// The sides on which the wedge ends.
    fn extents(&self) -> Vec<Extent> {
        match (self.plan.is_half(), self.plan.mirror) {
            (true, true) => vec![Extent::WholePlane],
            (true, false) => vec![Extent::HalfPlane(Side::A), Extent::FarHalf],
            (false, _) => vec![Extent::HalfPlane(Side::A), Extent::HalfPlane(Side::B)],
        }
    }

    fn match_seam(
        &self,
        surface: &mut Surface,
        opening: &Opening,
        notes: &mut Vec<String>,
    ) -> Result<seam::Matched, CutError> {
        let sections = self.extents();
        let mut low = Section::new(surface, opening, sections[0]);
        let mut high = Section::new(surface, opening, sections[1]);
        let matched = seam::match_sections(
            surface,
            opening,
            self.plan.opening,
            &mut low,
            &mut high,
            self.tolerances.partner,
            self.frame,
        )?;
        notes.push(format!(
            "{} point pairs on the seam, moved by {:.1e} at most; {} points that only one side had",
            matched.pairs.len(),
            matched.moved,
            matched.inserted,
        ));
        Ok(matched)
    }

    /// Caps that close a part of the surface.
    fn caps(
        &self,
        surface: &mut Surface,
        opening: &Opening,
        part: &[Triangle],
    ) -> Result<Caps, CutError> {
        let mut extents = self.extents();
        if !self.plan.mirror {
            extents.truncate(1);
        }
        let mut borders = Borders::default();
        let mut sides = Vec::new();
        for extent in extents {
            let cap = self.cap(surface, opening, part, extent, &Borders::default())?;
            borders.add(&cap);
            sides.push(cap);
        }
        let level = match self.plan.level {
            true => Some(self.cap(surface, opening, part, Extent::Level, &borders)?),
            false => None,
        };
        Ok(Caps { sides, level })
    }

    fn cap(
        &self,
        surface: &mut Surface,
        opening: &Opening,
        part: &[Triangle],
        extent: Extent,
        borders: &Borders,
    ) -> Result<Vec<Triangle>, CutError> {
        surface.faces = part.to_vec();
        // Corners on the other side of the hub's plane are none of this part's.
        let corners = surface.corners.clone();
        let hub = |v: u32| surface.classes[v as usize].hub;
        let inside = part.iter().flat_map(|f| f.vertices).any(|v| hub(v) < 0);
        let own = |v: &u32| if inside { hub(*v) <= 0 } else { hub(*v) >= 0 };
        let own: Vec<u32> = corners.iter().copied().filter(own).collect();
        surface.corners = own;
        let section = Section::new(surface, opening, extent);
        let cap = section.cap(surface, opening, self.frame, inside, borders);
        surface.faces.clear();
        surface.corners = corners;
        cap
    }

    /// The cap between wedge and hub, facing out of the wedge.
    fn hub_cap(
        &self,
        surface: &mut Surface,
        opening: &Opening,
        outer: &[Triangle],
        inner: &[Triangle],
        hub: &HubPlan,
    ) -> Result<Vec<Triangle>, CutError> {
        let bad = |reason: &str| CutError::BadHub {
            radius: hub.radius,
            reason: reason.to_owned(),
        };
        if inner.is_empty() {
            return Err(bad("nothing of the body is that near to the axis"));
        }
        if outer.is_empty() {
            return Err(bad("nothing of the body is farther from the axis"));
        }
        surface.faces = outer.to_vec();
        let from_outside = Section::new(surface, opening, Extent::Hub);
        surface.faces = inner.to_vec();
        let from_inside = Section::new(surface, opening, Extent::HubInside);
        surface.faces.clear();
        let regions = |s: &Section| -> Vec<_> {
            s.edges
                .iter()
                .filter(|e| e.left != e.right)
                .map(|e| (e.ends, e.left, e.right))
                .collect()
        };
        if regions(&from_outside) != regions(&from_inside) {
            return Err(bad(
                "a face of the body lies in the hub's wall; choose another radius",
            ));
        }
        let cap = from_outside.cap(surface, opening, self.frame, false, &Borders::default())?;
        if cap.is_empty() {
            return Err(bad("there is no material at its wall"));
        }
        Ok(cap)
    }
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

/// Volume of each region of a template, model units cubed.
fn region_volumes(template: &Template) -> BTreeMap<u32, f64> {
    let origin = template.vertices.first().copied().unwrap_or_default();
    let mut volumes = BTreeMap::new();
    for t in &template.triangles {
        let [a, b, c] = geom::measure::corners(&template.vertices, t);
        let volume = geom::measure::tet_volume(origin, a, b, c);
        for (region, sign) in [(t.back, 1.0), (t.front, -1.0)] {
            if region != tmesh::OUTSIDE {
                *volumes.entry(region).or_default() += sign * volume;
            }
        }
    }
    volumes
}
