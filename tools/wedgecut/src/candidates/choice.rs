//! The order in which candidates are tried: what is cheapest to mesh first.

use super::groups::Groups;
use super::places::{HARMFUL, Places};
use crate::body::Body;
use crate::cell::{angle, hub_order, may_have_hub};
use crate::cutting::{Candidate, Cut};
use crate::params::{Domain, Hub};
use estimate::{Bounds, CostModel, Estimate, Hubs, Way, Ways};
use tmesh::{Group, Kind};

/// Candidates, and why they are in this order.
pub struct Choice {
    /// The candidates, best first; each way to mesh with fewer and fewer planes.
    pub list: Vec<Candidate>,
    /// Those among them that cost few elements, without what fewer planes would make of them.
    pub accepted: Vec<Candidate>,
    /// The reason for the first.
    pub why: String,
}

/// Elements over those of the usual planes for which half turns, rotary reflections or mirror planes are given up: what they
/// halve the wedge by. Estimates of one body differ by less.
const MUCH_LESS: f64 = 0.5;

/// Kinds of wedges with the ways to mesh them.
struct Ranking {
    kinds: Vec<Group>,
    /// The best way of each order.
    all: Vec<Way>,
    /// The same, best first; at least one.
    ways: Vec<Way>,
    /// How many of these have no more elements than are accepted; they come first.
    accepted: usize,
}

impl Ranking {
    fn new(kinds: Vec<Group>, ways: &Ways<'_>) -> Option<Self> {
        let ranked = ways.ranked();
        let accepted = ranked.iter().take_while(|way| ways.is_accepted(way));
        let accepted = accepted.count();
        (!ranked.is_empty()).then(|| Self {
            kinds,
            all: ways.list.clone(),
            ways: ranked,
            accepted,
        })
    }
}

/// Orders what is left of the groups by the cost that a first wedge tells.
pub fn choose(body: &Body<'_>, groups: &Groups, orders: &[u32], first: &Cut) -> Option<Choice> {
    // What a seam slices is measured as it is drawn, and then so is all that this is compared with.
    let is_sliced = !first.candidate.group.has_vertical_mirrors();
    let feature = body.feature().filter(|_| !is_sliced);
    // What gets edges of a length costs nothing, however narrow it is drawn.
    let needles = match body.takes_lengths() {
        true => 0.0,
        false => estimate::needles(body.surface, body.element_size(), feature),
    };
    let mut wedge = estimate::Wedge::new(&first.templates[0], 0, first.wedges);
    wedge.layers = f64::from(body.document.wishes.layers_across.unwrap_or(1));
    wedge.asked = body
        .asked(&first.templates[0])
        .filter(|asked| asked.has_lengths() || !is_sliced);
    let max_volume = |region| body.max_volume(region);
    let model = CostModel::CALIBRATED;
    let estimate = Estimate::new(model, &wedge, needles, max_volume, body.params.threads);
    // Half turns and rotary reflections are used wherever they can be without slicing the surface to slivers; only a
    // narrow wedge may do better with a hub.
    let may_choose = body.params.order.is_none() || body.params.hub != Hub::Auto;
    let kinds_of = |order: u32| {
        let clean = |g: &Group| g.kind == groups.plain || harm(body, *g, first) <= HARMFUL;
        let kinds: Vec<Group> = groups.at(order).into_iter().filter(clean).collect();
        let last = kinds.last().copied();
        let wanted = |g: &Group| {
            let hub = may_choose && may_have_hub(*g) && estimate.is_narrow(angle(*g));
            Some(*g) == last || !groups.has_half_turns_or_rotary_reflections() || hub
        };
        kinds.into_iter().filter(wanted).collect::<Vec<Group>>()
    };
    let hubs = match body.params.hub {
        Hub::Radius(radius) => Hubs::Radius(radius),
        Hub::None => Hubs::None,
        Hub::Auto => Hubs::Free,
    };
    let ranked_with = |kinds: Vec<Group>, hubs: Hubs| {
        let cuts: Vec<estimate::Cut> = kinds.iter().map(|&g| describe(body, g, first)).collect();
        let radius_edge = body.document.wishes.radius_edge();
        let bounds = Bounds { radius_edge, hubs };
        Ranking::new(kinds, &Ways::new(&estimate, &cuts, bounds))
    };
    let ranked = |kinds: Vec<Group>| ranked_with(kinds, hubs);
    let usual: Vec<Group> = orders.iter().flat_map(|&n| kinds_of(n)).collect();
    let mut ranking = ranked(usual.clone())?;
    // A hub divides what would get edges of a length: of 43 parts from CAD kernels at a tenth and a twentieth of the diagonal, the two that
    // have a hub without this get 1.5 to 1.9 times the elements.
    let has_hub_of_ours = body.params.hub == Hub::Auto && ranking.ways[0].hub.is_some();
    if has_hub_of_ours && body.takes_lengths() {
        let without = ranked_with(usual, Hubs::None);
        ranking = without.filter(|r| r.accepted > 0).unwrap_or(ranking);
    }
    // Where planes that nobody asked for cost much, fewer of them may do better, if the larger wedges take no longer.
    let is_free = body.params.domain == Domain::Auto && body.params.order.is_none();
    if ranking.accepted == 0 && is_free {
        let usual = ranking.ways[0];
        let other = ranked(orders.iter().flat_map(|&n| groups.all_at(n)).collect())?;
        let way = other.ways[0];
        if way.meshed <= usual.meshed && way.elements <= MUCH_LESS * usual.elements {
            ranking = other;
        }
    }
    let Ranking {
        kinds,
        ways,
        accepted,
        ..
    } = &ranking;
    let chosen = &ways[0];
    let planes = |way: &Way| {
        let hub = way.hub.map(|r| format!(" with a hub of {r:.3}"));
        hub.unwrap_or_default() + turning_over(kinds[way.cut])
    };
    let list: Vec<String> = (ranking.all.iter())
        .map(|way| {
            let order = kinds[way.cut].order;
            format!("{order}{} {:.2}", planes(way), way.elements)
        })
        .collect();
    let why = format!(
        "order {} of {}{}: the fastest that costs few elements; estimated elements over those of the whole body by \
         order: {}",
        kinds[chosen.cut].order,
        body.symmetry.group.order,
        planes(chosen),
        list.join(", "),
    );
    let list = (ways.iter())
        .flat_map(|way| with_fewer_planes(body, groups, kinds[way.cut], way.hub))
        .collect();
    let candidate = |way: &Way| Candidate {
        group: kinds[way.cut],
        hub: way.hub,
    };
    let accepted = ways[..*accepted].iter().map(candidate).collect();
    Some(Choice {
        list,
        accepted,
        why,
    })
}

/// A way to mesh, and the same without the operations that turn the axis over, and without a hub unless it was asked
/// for: a plane that nobody asked for must not be in the way.
fn with_fewer_planes(
    body: &Body<'_>,
    groups: &Groups,
    group: Group,
    hub: Option<f64>,
) -> Vec<Candidate> {
    let plain = Group::new(groups.plain, group.order);
    let mut list = vec![Candidate { group, hub }, Candidate { group: plain, hub }];
    if body.params.hub == Hub::Auto {
        list.extend([group, plain].map(|group| Candidate { group, hub: None }));
    }
    list.dedup();
    list
}

/// What a group adds to the kind that leaves the axis its direction, in words.
fn turning_over(group: Group) -> &'static str {
    match group.kind {
        Kind::C | Kind::Cv => "",
        Kind::Ch | Kind::Dh => " halved",
        Kind::D | Kind::Dd => " halved by half turns",
        Kind::S => " halved by rotary reflections",
    }
}

/// What the faces of a group's wedge do to the surface that they slice, for each copy. A seam costs at any order what it
/// costs at the order of the first wedge.
fn harm(body: &Body<'_>, group: Group, first: &Cut) -> f64 {
    let least = || {
        Places::new(body, group)
            .ok()?
            .list
            .first()
            .map(|place| place.harm)
    };
    match group.kind {
        Kind::C | Kind::Ch if !first.candidate.group.has_vertical_mirrors() => first.place.harm,
        Kind::Cv | Kind::Dh => 0.0,
        _ => least().unwrap_or(0.0),
    }
}

/// A group's wedge, as the estimate sees it.
fn describe(body: &Body<'_>, group: Group, first: &Cut) -> estimate::Cut {
    let angle = angle(group);
    let mirrors = group.has_vertical_mirrors();
    let copies = f64::from(group.size());
    estimate::Cut {
        order: group.order,
        angle,
        copies,
        hub_copies: copies / f64::from(group.order) * f64::from(hub_order(group)),
        reach: 1.0
            / if mirrors {
                angle.cos()
            } else {
                (0.5 * angle).cos()
            },
        free: matches!(group.kind, Kind::Cv | Kind::Dh),
        across: group.has_horizontal_mirror(),
        harm: harm(body, group, first) * f64::from(group.order),
        hub: may_have_hub(group),
    }
}
