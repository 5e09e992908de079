//! The first candidate that can be cut.

use super::choice::choose;
use super::groups::Groups;
use super::places::Places;
use super::refusals::Refusals;
use crate::body::Body;
use crate::cutting::{Candidate, Cut, cut};
use crate::error::CutError;
use crate::params::{Hub, Seam};
use estimate::CostModel;
use tmesh::{Group, Template, Wishes};

/// What was found.
pub struct Found {
    /// The wedge.
    pub cut: Cut,
    /// Why it was chosen and what was refused before, in sentences.
    pub notes: Vec<String>,
    /// That the cut is at a bad place, and where a better one is.
    pub warning: Option<String>,
}

/// Cuts the best candidate that can be cut.
///
/// # Errors
/// Parameters that the body does not allow; why the first candidate could not be cut, if none can.
pub fn search(body: &Body<'_>) -> Result<Found, CutError> {
    let groups = Groups::new(body)?;
    let mut refusals = Refusals::default();
    let highest = groups.orders.last().copied().unwrap_or(1);
    let unchosen = |order| groups.unchosen(order, body.params.hub);
    if !body.params.chooses() || highest == 1 && unchosen(1).iter().all(|c| c.group.is_trivial()) {
        let order = body.params.order.unwrap_or(body.symmetry.group.order);
        let found = first_of(body, unchosen(order), None, &mut refusals)?;
        return finish(found, refusals, None);
    }
    // What the others are estimated by: a wedge of the highest order that can be cut, without any plane that could
    // be left out.
    let plain = |&order: &u32| Candidate {
        group: Group::new(groups.plain, order),
        hub: None,
    };
    let is_wedge = |c: &Candidate| !c.group.is_trivial();
    let probes = groups.orders.iter().rev().map(plain).filter(is_wedge);
    let Some((first, _)) = first_of(body, probes.collect(), None, &mut refusals)? else {
        let rest = groups
            .orders
            .iter()
            .rev()
            .flat_map(|&order| unchosen(order));
        let found = first_of(body, rest.collect(), None, &mut refusals)?;
        return finish(found, refusals, None);
    };
    let is_left = |order: &u32| !refusals.has(plain(order)) || plain(order) == first.candidate;
    let left: Vec<u32> = groups.orders.iter().copied().filter(is_left).collect();
    let Some(choice) = choose(body, &groups, &left, &first) else {
        let order = body.params.order.unwrap_or(first.candidate.group.order);
        let found = first_of(body, unchosen(order), Some(first), &mut refusals)?;
        return finish(found, refusals, None);
    };
    let found = first_of(body, choice.list, Some(first), &mut refusals)?;
    let found = match found {
        Some(found) if body.params.hub == Hub::Auto => {
            Some(without_corners(body, found, &mut refusals)?)
        }
        found => found,
    };
    let found = match found {
        Some(found) if body.params.order.is_none() => {
            let others = choice.accepted.into_iter();
            let others = others.chain(groups.without_mirrors(body.params));
            Some(without_sharp(body, found, others, &mut refusals)?)
        }
        found => found,
    };
    finish(found, refusals, Some(choice.why))
}

fn finish(
    found: Option<(Cut, Option<String>)>,
    refusals: Refusals,
    why: Option<String>,
) -> Result<Found, CutError> {
    match found {
        Some((cut, warning)) => {
            let mut notes = refusals.notes(cut.candidate);
            notes.extend(why);
            Ok(Found {
                cut,
                notes,
                warning,
            })
        }
        None => Err(refusals.into_first()),
    }
}

/// Cuts the first of a list that can be cut, and says what is bad about its place; `known` has been cut already.
///
/// # Errors
/// What holds of any candidate.
fn first_of(
    body: &Body<'_>,
    list: Vec<Candidate>,
    mut known: Option<Cut>,
    refusals: &mut Refusals,
) -> Result<Option<(Cut, Option<String>)>, CutError> {
    for candidate in list {
        let places = Places::new(body, candidate.group)?;
        if let Some(known) = known.take_if(|known| known.candidate == candidate) {
            return Ok(Some((known, places.warning)));
        }
        if refusals.has(candidate) {
            continue;
        }
        // A seam that nobody asked for comes first, and has to be better than a plane.
        let mut between = None;
        for place in places.list {
            let is_found = place.graph.is_some() && body.params.seam == Seam::Auto;
            match cut(body, candidate, place) {
                Ok(cut) if is_found => between = Some(cut),
                Ok(cut) => return Ok(Some((better(body, between, cut), places.warning))),
                Err(error) if error.is_of_the_shape() => refusals.add(candidate, error),
                Err(error) => return Err(error),
            }
        }
        if let Some(cut) = between {
            return Ok(Some((cut, places.warning)));
        }
    }
    Ok(None)
}

/// Where a wedge has edges on the axis at which no element can have the angle asked for, the first of `others` that has none there
/// and in all copies fewer elsewhere, if there is one: what of the angle on the axis a copy has is decided by the order, and by
/// whether mirror planes halve it.
///
/// # Errors
/// What holds of any candidate.
fn without_sharp(
    body: &Body<'_>,
    found: (Cut, Option<String>),
    others: impl Iterator<Item = Candidate>,
    refusals: &mut Refusals,
) -> Result<(Cut, Option<String>), CutError> {
    let asked = body.document.wishes.min_dihedral();
    let sharp = Sharp::of(&found.0, asked);
    if sharp.on_axis == 0 {
        return Ok(found);
    }
    for candidate in others {
        if candidate == found.0.candidate {
            continue;
        }
        let Some((mut cut, warning)) = first_of(body, vec![candidate], None, refusals)? else {
            continue;
        };
        let left = Sharp::of(&cut, asked);
        if left.on_axis == 0 && left.all < sharp.all {
            cut.notes.push(format!(
                "{} leaves no edges on the axis with angles below {asked} degrees, {} leaves {}",
                cut.candidate.group.symbol(),
                found.0.candidate.group.symbol(),
                sharp.on_axis
            ));
            return Ok((cut, warning));
        }
    }
    Ok(found)
}

/// Where the corners of a hub take at least twice the elements that there are without it, and none of the angles on the axis is below that of good
/// elements, the same wedge without a hub. Corners do not count where sizes that are asked for take more elements: the choice was made by these.
///
/// # Errors
/// What holds of any candidate.
fn without_corners(
    body: &Body<'_>,
    found: (Cut, Option<String>),
    refusals: &mut Refusals,
) -> Result<(Cut, Option<String>), CutError> {
    let Candidate { group, hub } = found.0.candidate;
    let Some(radius) = hub else {
        return Ok(found);
    };
    let whole = vec![Candidate { group, hub: None }];
    let Some((mut cut, warning)) = first_of(body, whole, None, refusals)? else {
        return Ok(found);
    };
    let [with, without] = [&found.0, &cut].map(least_elements);
    // What improvement brings elements to, where nothing stands in its way.
    let wishes = &body.document.wishes;
    let good = wishes.optimize().map_or(0.0, Wishes::smallest_beside);
    let good = good.max(wishes.min_dihedral());
    let by_sizes = body.least_by_sizes();
    let take = |by_corners: usize| by_sizes.max(by_corners as f64);
    if 2.0 * take(without) > take(with) || Sharp::of(&cut, good).on_axis > 0 {
        return Ok(found);
    }
    cut.notes.push(format!(
        "no hub of {radius:.3}: its corners ask for {with} elements, those without it for {without}"
    ));
    Ok((cut, warning))
}

/// The least elements of all copies that have no vertices but the corners of the surface, where that is a ball's: a tetrahedron has four,
/// and each further one adds one.
fn least_elements(cut: &Cut) -> usize {
    let instances = cut.copies.instances.iter();
    let corners = instances.map(|i| cut.templates[i.template as usize].vertices.len());
    corners.map(|n| n.saturating_sub(3)).sum()
}

/// How many edges with angles below the one asked for there are.
struct Sharp {
    /// On the axis, of the wedge and its hub.
    on_axis: usize,
    /// Of all copies.
    all: usize,
}

impl Sharp {
    fn of(cut: &Cut, asked: f64) -> Self {
        let mut sharp = Self { on_axis: 0, all: 0 };
        for (index, template) in cut.templates.iter().enumerate() {
            let edges = kit::sharp_edges((index, template), asked);
            let instances = cut.copies.instances.iter();
            let copies = instances.filter(|i| i.template as usize == index).count();
            sharp.on_axis += edges.iter().filter(|edge| edge.is_on_axis()).count();
            sharp.all += copies * edges.len();
        }
        sharp
    }
}

/// Of a wedge along a seam between the blades, if there is one, and one between planes the one whose surface costs fewer
/// elements; planes if both cost the same, or where the seam leaves more edges at which no element has the angle asked for: at
/// these refinement may come to no end.
fn better(body: &Body<'_>, between: Option<Cut>, planes: Cut) -> Cut {
    let Some(between) = between else {
        return planes;
    };
    let asked = body.document.wishes.min_dihedral();
    let sharp = |cut: &Cut| {
        let templates = cut.templates.iter().enumerate();
        let counts = templates.map(|template| kit::sharp_edges(template, asked).len());
        counts.sum::<usize>()
    };
    let feature = body.feature();
    let cost = |cut: &Cut| {
        let needles = |t: &Template| estimate::needles(t, body.element_size(), feature);
        let narrow: f64 = cut.templates.iter().map(needles).sum();
        narrow + CostModel::CALIBRATED.sliced * cut.place.harm
    };
    let both = [&between, &planes];
    let ([along, plane], sharp) = (both.map(cost), both.map(sharp));
    let why = match sharp[0] > sharp[1] {
        true => format!(
            "its wedge has {} edge(s) with angles below {asked} degrees, {} between planes",
            sharp[0], sharp[1]
        ),
        false => format!(
            "narrow faces of its wedge and what it slices cost {along:.0} elements of the estimate, {plane:.0} between planes"
        ),
    };
    let (mut chosen, what) = match sharp[0] <= sharp[1] && along < plane {
        true => (between, "taken"),
        false => (planes, "not taken"),
    };
    chosen
        .notes
        .push(format!("a seam between the blades is {what}: {why}"));
    chosen
}
