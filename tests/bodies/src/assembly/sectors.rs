//! Pieces around a hub, as poles and magnets are, that touch in half planes and on the hub's cylinder.

use super::draw::{Circle, Drawing};
use crate::Dice;
use glam::DVec2;
use std::f64::consts::TAU;

/// A hub and pieces around it, all alike or each with arcs of its own.
pub fn draw(drawing: &mut Drawing, dice: &mut Dice) {
    let pieces = dice.integer(3, 9);
    let alike = dice.chance(0.6);
    let radius = dice.between(1.0, 2.0);
    let outer = radius * dice.between(1.3, 2.0);
    let height = dice.between(0.5, 3.0);
    // All of the sector, or a magnet with air on either side.
    let share = dice.pick(&[1.0, 1.0, 0.7]);
    let hub = Circle {
        sides: pieces * dice.integer(3, 9),
        ..Circle::random(radius, dice)
    };
    let solid = drawing.solid("hub".to_owned());
    let sides = if dice.chance(0.7) {
        [0.0, height]
    } else {
        [-0.5, height + 0.5]
    };
    drawing.prism(&hub.corners(), DVec2::ZERO, sides);
    drawing.regions[solid].volume = drawing.body.volume(solid);
    let steps = |dice: &mut Dice| [dice.integer(3, 12), dice.integer(3, 12)];
    let same = steps(dice);
    for i in 0..pieces {
        let [within, without] = if alike { same } else { steps(dice) };
        let middle = TAU * i as f64 / pieces as f64;
        let half = 0.5 * share * TAU / pieces as f64;
        let arc = |radius: f64, count: usize| {
            (0..=count).map(move |k| {
                let angle = middle - half + 2.0 * half * k as f64 / count as f64;
                DVec2::from_angle(angle) * radius
            })
        };
        let (inside, outside): (Vec<DVec2>, Vec<DVec2>) =
            (arc(radius, within).collect(), arc(outer, without).collect());
        let piece = drawing.solid(format!("piece{i}"));
        drawing.slab(&inside, &outside, [0.0, height]);
        drawing.regions[piece].volume = drawing.body.volume(piece);
        let sagitta = radius * (1.0 - (half / within as f64).cos());
        let slack = 2.0 * half * radius * (sagitta + hub.sagitta());
        drawing.regions[piece].slack += slack * height;
        // A facet of the hub that is bent to the piece slopes from there to the ends of the hub.
        drawing.regions[solid].slack += slack * (sides[1] - sides[0]);
    }
    if alike {
        drawing.order = pieces;
    }
    let how = if alike { "alike" } else { "not alike" };
    drawing.features.push(format!(
        "{pieces} pieces {how} around a hub of {} sides",
        hub.sides
    ));
}
