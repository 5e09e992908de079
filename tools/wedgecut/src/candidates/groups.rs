//! The subgroups that are wanted.

use super::places::Places;
use crate::body::Body;
use crate::cell::{has_room_for_hub, may_have_hub};
use crate::cutting::Candidate;
use crate::error::CutError;
use crate::graph::Parity;
use crate::names;
use crate::params::{Domain, Hub, Params, Seam};
use glam::DVec3;
use tmesh::{Group, Kind};

/// The subgroups to choose from, at each order first the one without operations that turn the axis over.
pub struct Groups {
    /// The kind of subgroup that leaves the axis its direction.
    pub plain: Kind,
    /// The kind with operations that turn the axis over, where there is one and it is wanted.
    pub over: Option<Kind>,
    /// Orders, increasing.
    pub orders: Vec<u32>,
    found: Group,
}

impl Groups {
    /// What the parameters allow of the group found.
    ///
    /// # Errors
    /// An order that does not divide the order found; mirror walls without mirror planes; a hub of a wedge that is
    /// too wide.
    pub fn new(body: &Body<'_>) -> Result<Self, CutError> {
        let (found, params) = (body.symmetry.group, body.params);
        let divisors = divisors(found.order);
        if let Some(asked) = params.order
            && !divisors.contains(&asked)
        {
            return Err(not_a_divisor(body, asked, &divisors));
        }
        let mirrors = match params.domain {
            Domain::Auto => found.has_vertical_mirrors(),
            Domain::Rotation => false,
            Domain::Mirror if found.has_vertical_mirrors() => true,
            Domain::Mirror => return Err(CutError::NoMirror(found.symbol())),
        };
        if let (Seam::Graph(_), true) = (&params.seam, mirrors) {
            return Err(CutError::NoSeam(
                "a wedge between mirror planes has no seam; add --domain rotation",
            ));
        }
        if let (Hub::Radius(radius), Some(order)) = (params.hub, params.order) {
            check_hub(radius, order)?;
        }
        let mut groups = Self {
            plain: if mirrors { Kind::Cv } else { Kind::C },
            over: over(found.kind, mirrors, params.domain)
                .filter(|kind| *kind != Kind::D || Places::has_half_turn(body))
                .filter(|kind| keeps_seam(body, *kind))
                .filter(|_| keeps_names(body)),
            orders: Vec::new(),
            found,
        };
        if found.has_horizontal_mirror() && !params.level {
            groups.over = None;
        }
        // A mesh without symmetry is not what a symmetric body is cut for.
        let is_wanted = |order: &u32| match params.hub {
            _ if found.order == 1 => true,
            Hub::Radius(_) => has_room_for_hub(*order),
            Hub::Auto | Hub::None => mirrors || *order > 1,
        };
        groups.orders = match params.order {
            Some(order) => vec![order],
            None => divisors.into_iter().filter(is_wanted).collect(),
        };
        // Of some divisors there are no rotary reflections: these would give up half of the elements found.
        if params.order.is_none() && groups.has_half_turns_or_rotary_reflections() {
            let has_over = |n: &u32| groups.at(*n).len() > 1;
            let with_over: Vec<u32> = groups.orders.iter().copied().filter(has_over).collect();
            if !with_over.is_empty() {
                groups.orders = with_over;
            }
        }
        Ok(groups)
    }

    /// Whether what turns the axis over is no mirror plane.
    pub fn has_half_turns_or_rotary_reflections(&self) -> bool {
        matches!(self.over, Some(Kind::S | Kind::D | Kind::Dd))
    }

    /// The subgroups of an order.
    pub fn at(&self, order: u32) -> Vec<Group> {
        let kinds = [Some(self.plain), self.over].into_iter().flatten();
        let groups = kinds.map(|kind| Group::new(kind, order));
        // Half a turn between the faces of a seam is left whole: three walls in two planes.
        let is_cut = |g: &Group| *g != Group::new(Kind::Ch, 2) && *g != Group::new(Kind::Ch, 1);
        groups
            .filter(|g| g.is_subgroup_of(self.found) && is_cut(g))
            .collect()
    }

    /// The subgroups of an order, and its rotations by themselves where they are not among them.
    pub fn all_at(&self, order: u32) -> Vec<Group> {
        let rotations = Group::new(Kind::C, order);
        let is_more = self.plain != rotations.kind && !rotations.is_trivial();
        let rotations = is_more.then_some(rotations);
        rotations.into_iter().chain(self.at(order)).collect()
    }

    /// Wedges between planes that are no mirror planes, the most copies first: none where there are no others, and where mirror planes, the
    /// place of one or a hub were asked for.
    pub fn without_mirrors(&self, params: &Params) -> Vec<Candidate> {
        let is_free = params.domain == Domain::Auto && params.start_angle.is_none();
        if !is_free || matches!(params.hub, Hub::Radius(_)) || self.plain != Kind::Cv {
            return Vec::new();
        }
        let kinds = |order: u32| {
            let across = self.over.is_some() && self.found.has_horizontal_mirror();
            let across = (across && order > 2).then_some(Kind::Ch);
            let kinds = across.into_iter().chain([Kind::C]);
            kinds.map(move |kind| Group::new(kind, order))
        };
        let groups = self.orders.iter().rev().flat_map(|&order| kinds(order));
        let wedges = groups.filter(|g| !g.is_trivial());
        wedges.map(|group| Candidate { group, hub: None }).collect()
    }

    /// The subgroups of an order without a hub, or with one of the radius asked for, as they are tried where nothing is chosen: the
    /// most copies first.
    pub fn unchosen(&self, order: u32, hub: Hub) -> Vec<Candidate> {
        let radius = match hub {
            Hub::Radius(radius) => Some(radius),
            Hub::Auto | Hub::None => None,
        };
        let groups = self.at(order).into_iter().rev();
        let groups = groups.filter(|g| radius.is_none() || may_have_hub(*g));
        groups
            .map(|group| Candidate { group, hub: radius })
            .collect()
    }
}

/// The kind with operations that turn the axis over as well.
fn over(found: Kind, mirrors: bool, domain: Domain) -> Option<Kind> {
    match (found, mirrors) {
        (Kind::Dh, true) | (Kind::Dd, true) => Some(found),
        (Kind::Dh | Kind::Ch, false) => Some(Kind::Ch),
        (Kind::S | Kind::D, false) if domain == Domain::Auto => Some(found),
        _ => None,
    }
}

/// Whether what turns the axis over takes the seam that was asked for onto itself or its image.
fn keeps_seam(body: &Body<'_>, kind: Kind) -> bool {
    let Some(graph) = &body.graph else {
        return true;
    };
    match kind {
        Kind::D => graph.parity() == Parity::Odd && body.params.start_angle.is_none(),
        Kind::S => graph.parity() == Parity::Even,
        _ => true,
    }
}

/// Whether boundary pieces have their own names in both halves of the body.
fn keeps_names(body: &Body<'_>) -> bool {
    let [origin, axis] = [body.symmetry.axis.point, body.symmetry.axis.direction].map(DVec3::from);
    names::keeps_names(body.surface, origin, axis)
}

fn check_hub(radius: f64, order: u32) -> Result<(), CutError> {
    if has_room_for_hub(order) {
        return Ok(());
    }
    Err(CutError::BadHub {
        radius,
        reason: format!(
            "the wedge of order {order} is too wide for one; orders from 3 can have a hub"
        ),
    })
}

fn not_a_divisor(body: &Body<'_>, asked: u32, divisors: &[u32]) -> CutError {
    let divisors: Vec<_> = divisors.iter().map(u32::to_string).collect();
    CutError::NotADivisor {
        asked,
        found: body.symmetry.group.order,
        divisors: divisors.join(", "),
        hint: match body.symmetry.axisymmetric {
            true => {
                format!("; of a body of revolution, symdetect --order {asked} verifies another one")
            }
            false => String::new(),
        },
    }
}

/// All divisors, increasing.
fn divisors(n: u32) -> Vec<u32> {
    (1..=n).filter(|d| n.is_multiple_of(*d)).collect()
}
