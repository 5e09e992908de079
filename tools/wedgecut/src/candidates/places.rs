//! Where the first side of a wedge may lie.

use super::angles::{PLACES, clear_angles};
use crate::body::Body;
use crate::cell::angle;
use crate::cutting::Place;
use crate::error::CutError;
use crate::graph::{Graph, Rails, between};
use crate::params::Seam;
use estimate::CostModel;
use estimate::harm::sliced::Harm;
use estimate::harm::{halved, sliced};
use geom::number::number;
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use tmesh::{Frame, Group, Isometry, Kind};

/// Harm from which walls on the axes of half turns, which nobody asked for, are given up, since they cannot be elsewhere;
/// and by how much more a seam at an angle that was asked for harms than at the best place when the user is told. A
/// choice between what was found: half turns of helical gears harm by up to 205 and are kept, those of a knot and of
/// a twisted bar, whose walls cut slivers, by 217 to 240. It is some ten thousand tetrahedra in each copy.
pub const HARMFUL: f64 = 210.0;
/// Harm from which a seam at an angle that was asked for is refused: each copy would get as many elements as a whole
/// body usually has. A choice; only angles that pass an edge by a hundred-thousandth of the body reach it.
const USELESS: f64 = 2000.0;

/// Places to try for the wedge of a group, best first.
pub struct Places {
    /// The places.
    pub list: Vec<Place>,
    /// That the place asked for is a bad one.
    pub warning: Option<String>,
}

impl Places {
    /// The places of a group.
    ///
    /// # Errors
    /// An angle asked for that is not one of the group's, or is useless.
    pub fn new(body: &Body<'_>, group: Group) -> Result<Self, CutError> {
        match group.kind {
            _ if group.is_trivial() => Self::fixed(body, 0, 0.0),
            Kind::Cv | Kind::Dh | Kind::Dd => Self::of_mirrors(body, group),
            Kind::D => match &body.graph {
                Some(graph) => Self::of_graph(body, graph),
                None => Self::of_half_turns(body, group),
            },
            Kind::C | Kind::Ch | Kind::S => match &body.graph {
                Some(graph) => Self::of_graph(body, graph),
                None => Self::of_seams(body, group),
            },
        }
    }

    /// The seam that was asked for.
    fn of_graph(body: &Body<'_>, graph: &Arc<Graph>) -> Result<Self, CutError> {
        let place = Place {
            frame: turned(body, body.params.start_angle.unwrap_or(0.0))?,
            start: Isometry::IDENTITY,
            harm: 0.0,
            graph: Some(Arc::clone(graph)),
        };
        Ok(Self {
            list: vec![place],
            warning: None,
        })
    }

    /// The one place that is `steps` half steps of the group found from the reference.
    fn fixed(body: &Body<'_>, steps: i64, harm: f64) -> Result<Self, CutError> {
        let found = body.symmetry.group.order;
        let angle = match body.params.start_angle {
            Some(angle) => angle,
            None => steps as f64 * (PI / f64::from(found)),
        };
        let place = Place {
            frame: turned(body, angle)?,
            start: Isometry::rotation(steps, 2 * found),
            harm,
            graph: None,
        };
        Ok(Self {
            list: vec![place],
            warning: None,
        })
    }

    /// The mirror plane, or half turn's axis, that was asked for, as a number of half steps.
    fn asked(body: &Body<'_>) -> Result<Option<i64>, CutError> {
        let Some(angle) = body.params.start_angle else {
            return Ok(None);
        };
        let step = PI / f64::from(body.symmetry.group.order);
        let steps = (angle / step).round();
        if (angle - steps * step).abs() > f64::EPSILON.sqrt() {
            let (angle, step) = (angle.to_degrees(), step.to_degrees());
            return Err(CutError::NotAMirrorPlane { angle, step });
        }
        Ok(Some(steps as i64))
    }

    /// Whether the angle asked for, if one is, is that of a half turn's axis: seams may be anywhere.
    pub fn has_half_turn(body: &Body<'_>) -> bool {
        Self::asked(body).is_ok()
    }

    /// Whether planes at odd multiples of half a step are others than those at even ones, and may be chosen.
    fn has_choice(body: &Body<'_>, group: Group) -> bool {
        let found = body.symmetry.group.order;
        let renames = !body.symmetry.rotation_regions().pairs.is_empty();
        (found / group.order).is_multiple_of(2) && !renames
    }

    /// Both walls are images of the same mirror plane, and there may be others to choose.
    fn of_mirrors(body: &Body<'_>, group: Group) -> Result<Self, CutError> {
        if let Some(steps) = Self::asked(body)? {
            return Self::fixed(body, steps, 0.0);
        }
        let harm = match group.kind {
            // The half turns' axes lie between the mirror planes, and are images of each other.
            Kind::Dd => {
                let between = PI / f64::from(2 * group.order);
                2.0 * slicing(body)(between).sliced
            }
            _ => 0.0,
        };
        // Where the images of a drawing are off by more than its points are moved, sectors are drawn differently.
        let slide = body.tolerance.slide();
        let drawn_alike = slide == 0.0 || body.tolerance.drift() <= slide;
        if !drawn_alike && body.symmetry.rotation_regions().pairs.is_empty() {
            return Self::fixed(body, Self::best_sector(body, group), harm);
        }
        if !Self::has_choice(body, group) {
            return Self::fixed(body, 0, harm);
        }
        let vertices = body.canonical();
        let triangles = &body.surface.triangles;
        let plane = body.tolerance.on_plane();
        let both = [0.0, PI / f64::from(body.symmetry.group.order)];
        let [given, other] = both.map(|a| halved::harm(&vertices, triangles, a, plane));
        let [cut, less] = both.map(|a| halved::crossed(&vertices, triangles, a, plane));
        // Rounding does not choose.
        let alike = (given - other).abs() <= f64::EPSILON.sqrt() * given.max(other);
        let is_better = if alike { less < cut } else { other < given };
        Self::fixed(body, i64::from(is_better), harm)
    }

    /// The sector, as a number of half steps, whose sides harm the drawing least, where that does not share the symmetry:
    /// of all of them, or of [`PLACES`] all around.
    fn best_sector(body: &Body<'_>, group: Group) -> i64 {
        let sectors = 2 * body.symmetry.group.order as usize;
        let step = TAU / sectors as f64;
        let slicing = slicing(body);
        let harm = |k: usize| {
            let first = k as f64 * step;
            slicing(first).total() + slicing(first + angle(group)).total()
        };
        let places = (0..sectors).step_by(sectors.div_ceil(PLACES));
        let all = places.map(|k| (harm(k), k as i64));
        // The first of those that differ by less than an element.
        let elements = |harm: f64| (CostModel::CALIBRATED.sliced * harm).round();
        let best = all.min_by(|a, b| elements(a.0).total_cmp(&elements(b.0)));
        best.map_or(0, |(_, k)| k)
    }

    /// The sides lie along axes of half turns.
    fn of_half_turns(body: &Body<'_>, group: Group) -> Result<Self, CutError> {
        let step = PI / f64::from(body.symmetry.group.order);
        let slicing = slicing(body);
        let harm = |steps: i64| {
            let first = steps as f64 * step;
            let second = first + PI / f64::from(group.order);
            [first, second]
                .map(|a| slicing(a).sliced)
                .iter()
                .sum::<f64>()
        };
        if let Some(steps) = Self::asked(body)? {
            return Self::fixed(body, steps, harm(steps));
        }
        let [given, other] = [0, 1].map(harm);
        let is_better = Self::has_choice(body, group) && other < given;
        Self::fixed(
            body,
            i64::from(is_better),
            if is_better { other } else { given },
        )
    }

    /// The sides may lie anywhere.
    fn of_seams(body: &Body<'_>, group: Group) -> Result<Self, CutError> {
        let opening = angle(group);
        let vertices = body.canonical();
        let slicing = slicing(body);
        let tolerance = &body.tolerance;
        let seen =
            [tolerance.on_plane(), tolerance.detail()].map(|d| d / tolerance.extent().radius);
        let clear = clear_angles(&vertices, opening, tolerance.on_plane(), seen);
        let mut list: Vec<_> = clear.into_iter().map(|a| (a, slicing(a))).collect();
        // Stable: of places that differ by less than an element the clearest stays first.
        let class = |harm: Harm| (CostModel::CALIBRATED.sliced * harm.kept()).round();
        list.sort_by(|a, b| class(a.1).total_cmp(&class(b.1)));
        let mut warning = None;
        if let Some(angle) = body.params.start_angle {
            let given = slicing(angle);
            warning = is_harmful(angle, given, list[0])?;
            list = vec![(angle, given)];
        }
        let graph = match (&body.params.seam, body.params.start_angle) {
            (Seam::Auto, None) if group.kind != Kind::S => Self::between(body, opening, list[0].1),
            _ => None,
        };
        // Turns of the rotation have as many faces as it has sides.
        let sides = if group.kind == Kind::S { 2.0 } else { 1.0 };
        let place = |(angle, harm): (f64, Harm)| {
            Ok(Place {
                frame: turned(body, angle)?,
                start: Isometry::IDENTITY,
                harm: sides * harm.sliced,
                graph: None,
            })
        };
        let planes: Vec<Place> = list
            .into_iter()
            .map(place)
            .collect::<Result<_, CutError>>()?;
        Ok(Self {
            list: graph.into_iter().chain(planes).collect(),
            warning,
        })
    }

    /// The seam between the blades, where it harms less than a plane does.
    fn between(body: &Body<'_>, opening: f64, plane: Harm) -> Option<Place> {
        let elements = |harm: Harm| (CostModel::CALIBRATED.sliced * harm.kept()).round();
        if elements(plane) == 0.0 {
            return None;
        }
        let vertices = body.canonical();
        let stay = body.stay();
        let harm_of = |graph: &Graph| harm_of_graph(body, (&vertices, &stay), graph);
        // The first of those that differ by less than an element, which of the graphs has the fewest knots.
        let least = |graphs: &mut dyn Iterator<Item = Graph>| {
            let all = graphs.map(|graph| (harm_of(&graph), graph));
            all.min_by(|a, b| elements(a.0).total_cmp(&elements(b.0)))
        };
        let graphs = between(&vertices, &body.surface.triangles, opening, PLACES);
        // Along edges it cuts no faces; half of the way to a blade there may be some.
        let rails = Rails::new(&vertices, &body.surface.triangles, body.tolerance.equal());
        let bend = |graph: &Graph| rails.bend(graph, [opening, 0.25 * opening]);
        let bent = least(&mut graphs.iter().filter_map(bend));
        let (_, graph) = least(&mut graphs.into_iter())?;
        // Turned a little, it passes fewer points closely.
        let part = opening / (PLACES * PLACES) as f64;
        let turns = [0, 1, -1, 2, -2, 3, -3, 4, -4].map(|k| f64::from(k) * part);
        let turned = least(&mut turns.into_iter().map(|by| graph.clone().turned(by)));
        let (harm, graph) = ([turned, bent].into_iter().flatten())
            .min_by(|a, b| elements(a.0).total_cmp(&elements(b.0)))?;
        (elements(harm) < elements(plane)).then(|| Place {
            frame: body.frame,
            start: Isometry::IDENTITY,
            harm: harm.sliced,
            graph: Some(Arc::new(graph)),
        })
    }
}

/// The symmetry's frame, turned by an angle, radians.
fn turned(body: &Body<'_>, angle: f64) -> Result<Frame, CutError> {
    if angle == 0.0 {
        return Ok(body.frame);
    }
    let axis = DVec3::from(body.symmetry.axis.direction);
    let x = body.frame.rotation * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
    Frame::from_axis(body.frame.origin, axis, x).ok_or(CutError::BadAxis(axis.x, axis.y, axis.z))
}

/// The harm of the half plane at an angle from the reference, radians.
fn slicing(body: &Body<'_>) -> impl Fn(f64) -> Harm {
    let vertices = body.canonical();
    let size = body.element_size();
    let plane = body.tolerance.on_plane().max(body.tolerance.detail());
    let stay = body.stay();
    move |angle| {
        let stays = |v: u32| stay[v as usize];
        sliced::harm(
            &vertices,
            &body.surface.triangles,
            angle,
            plane,
            (&size, stays),
        )
    }
}

/// The harm of a graph.
fn harm_of_graph(body: &Body<'_>, (vertices, stay): (&[DVec3], &[bool]), graph: &Graph) -> Harm {
    let step = f64::EPSILON.cbrt() * body.tolerance.extent().size();
    let cut = sliced::Surface {
        heights: vertices.iter().map(|p| graph.straighten(*p).y).collect(),
        normal: |p: DVec3| graph.normal(p, step),
        tolerance: body.tolerance.on_plane().max(body.tolerance.detail()),
        stays: |v: u32| stay[v as usize],
    };
    sliced::harm_of(vertices, &body.surface.triangles, cut, body.element_size())
}

/// Says that the place of a seam, as an angle (radians) and the harm there, is a bad one, if there is a much
/// better one.
///
/// # Errors
/// The same of a place that makes the mesh useless.
fn is_harmful(angle: f64, harm: Harm, best: (f64, Harm)) -> Result<Option<String>, CutError> {
    let (given, least) = (harm.kept(), best.1.kept());
    if given <= least + HARMFUL {
        return Ok(None);
    }
    // What a unit of harm costs.
    let model = CostModel::CALIBRATED;
    let elements = model.sliced * model.tetrahedra;
    let error = CutError::BadPlace {
        angle: number(angle.to_degrees()),
        elements: elements * given,
        better: number(best.0.to_degrees()),
        fewer: elements * least,
    };
    if given > USELESS {
        return Err(error);
    }
    Ok(Some(error.to_string()))
}
