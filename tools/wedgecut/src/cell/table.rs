//! Which cell a group has: the one table from the kind of a group to faces and joins.

use super::bounds::Cell;
use super::face::{Face, Role};
use super::join::Join;
use super::part::Part;
use estimate::CostModel;
use std::f64::consts::TAU;
use tmesh::{Group, Isometry, Kind};

/// The order of the rotation that the hub of a wedge keeps: the largest divisor for which its own wedge is a wide one.
pub fn hub_order(group: Group) -> u32 {
    let is_wide = |&order: &u32| angle(Group::new(group.kind, order)) >= CostModel::CALIBRATED.wide;
    let divisors = (1..=group.order).filter(|h| group.order.is_multiple_of(*h));
    divisors.rev().find(is_wide).unwrap_or(1)
}

/// Whether wedges of a group can have a hub.
pub fn may_have_hub(group: Group) -> bool {
    let kinds = [Kind::C, Kind::Cv, Kind::Ch, Kind::Dh];
    kinds.contains(&group.kind) && has_room_for_hub(group.order)
}

/// Whether the sides of the wedges of an order are less than half a turn apart, or mirror planes less than a quarter, so
/// that the plane of a hub crosses both.
pub fn has_room_for_hub(order: u32) -> bool {
    order > 2
}

/// The angle of a group's wedge as a turn; the identity for a full one.
pub fn opening(group: Group) -> Isometry {
    let n = group.order;
    match group.kind {
        Kind::C | Kind::Ch => Isometry::rotation(1, n),
        Kind::Cv | Kind::S | Kind::D | Kind::Dh => Isometry::rotation(1, 2 * n),
        Kind::Dd => Isometry::rotation(1, 4 * n),
    }
}

/// The angle of a group's wedge, radians.
pub fn angle(group: Group) -> f64 {
    let turn = opening(group);
    match turn.k() {
        0 => TAU,
        k => TAU * f64::from(k) / f64::from(turn.n()),
    }
}

/// How a side is joined, by its angle as a number of half turns of the plane: to itself by the reflection in it, to
/// itself by the half turn about the radial line in it, or to the other side.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Mirror(Isometry),
    HalfTurn(Isometry),
    Partner,
}

/// What the wedge of a group ends at, without the hub. `tolerance` and `axis`: distances up to which points count as
/// on a face and on the axis, model units; `hub`: inscribed radius of the hub, model units.
pub fn of_group(group: Group, tolerance: f64, axis: f64, hub: Option<f64>) -> Cell {
    let n = group.order;
    let turn = opening(group);
    // The half turn about the radial line at the angle pi k / m, and the reflection in the plane there.
    let half_turn = |k, m| Side::HalfTurn(Isometry::new(k, m, true, true));
    let mirror = |k, m| Side::Mirror(Isometry::reflection(k, m));
    let sides = match group.kind {
        Kind::C | Kind::Ch | Kind::S => [Side::Partner; 2],
        Kind::Cv | Kind::Dh => [mirror(0, 1), mirror(1, n)],
        Kind::D => [half_turn(0, 1), half_turn(1, n)],
        Kind::Dd => [mirror(0, 1), half_turn(1, 2 * n)],
    };
    let names = [["wall-a", "turn-a"], ["wall-b", "turn-b"]];
    let turns = [Isometry::IDENTITY, turn];
    // Both sides of half of space lie in one plane.
    let is_half = turn == Isometry::rotation(1, 2);
    let is_full = turn == Isometry::IDENTITY;
    let count = match (is_full, is_half) {
        (true, _) => 0,
        (_, true) => 1,
        _ => 2,
    };
    let mut faces = Vec::new();
    let mut joins = Vec::new();
    for i in 0..count {
        let face = Face::radial(names[i][0], turns[i], i == 0);
        match sides[i] {
            Side::Mirror(step) => {
                faces.push(face);
                joins.push(mirror_wall(names[i][0], i, step));
            }
            Side::HalfTurn(step) => {
                faces.push(face.divided_at(1));
                joins.push(halves(names[i][1], i, 1, step));
            }
            Side::Partner if is_half => faces.push(face.divided_at(0)),
            Side::Partner => faces.push(face),
        }
    }
    if sides[0] == Side::Partner && count > 0 {
        let step = match group.kind {
            Kind::S => Isometry::new(1, 2 * n, false, true),
            _ => turn,
        };
        joins.push(match is_half {
            true => halves("seam", 0, 0, step),
            false => {
                let there = Part::whole(0);
                let here = Part::whole(1).image_of(&there, step);
                Join {
                    name: "seam",
                    here,
                    there,
                    step,
                }
            }
        });
    }
    if let Some(radius) = hub {
        // Orthogonal to the first mirror wall, where it is half a side of the hub's polygon, or to the middle of
        // the wedge.
        let across = match group.has_vertical_mirrors() {
            true => Isometry::IDENTITY,
            false => Isometry::rotation(i64::from(turn.k()), 2 * turn.n()),
        };
        faces.push(Face::chord("the hub", across, radius));
    }
    match group.kind {
        Kind::Ch | Kind::Dh => {
            joins.push(mirror_wall(LEVEL_WALL, faces.len(), Isometry::FLIP));
            faces.push(Face::across(LEVEL_WALL, Role::Wall));
        }
        Kind::D | Kind::Dd => faces.push(Face::across("the plane across the axis", Role::Fold)),
        Kind::C | Kind::Cv | Kind::S => {}
    }
    Cell::new(faces, joins, tolerance, axis)
}

/// Name of the wall in the plane z = 0.
pub const LEVEL_WALL: &str = "wall-level";

fn mirror_wall(name: &'static str, face: usize, step: Isometry) -> Join {
    let part = Part::whole(face);
    Join {
        name,
        here: part,
        there: part,
        step,
    }
}

/// The half of a face where a coordinate is negative as the image of the other half.
fn halves(name: &'static str, face: usize, coordinate: usize, step: Isometry) -> Join {
    let there = Part::half(face, coordinate, true);
    let here = Part::half(face, coordinate, false).image_of(&there, step);
    Join {
        name,
        here,
        there,
        step,
    }
}
