//! Pieces between a hub and a sleeve that fill all there is, as windings and magnets do: next to all of their surface touches.

use super::draw::{Circle, Drawing};
use crate::Dice;
use glam::DVec2;
use std::f64::consts::TAU;

/// A hub, pieces all alike around it, and a sleeve around these.
pub fn draw(drawing: &mut Drawing, dice: &mut Dice) {
    let pieces = dice.integer(5, 20);
    let radius = dice.between(1.0, 2.0);
    let outer = radius * dice.between(1.2, 1.6);
    let levels = [0.0, dice.between(1.0, 8.0)];
    let [within, without] = [dice.integer(1, 4), dice.integer(1, 4)];
    let arc = |piece: usize, radius: f64, count: usize| {
        (0..=count).map(move |k| {
            let corner = (piece * count + k) % (pieces * count);
            DVec2::from_angle(TAU * corner as f64 / (pieces * count) as f64) * radius
        })
    };
    let circle = |radius: f64, count: usize| -> Vec<DVec2> {
        let arcs = (0..pieces).flat_map(|piece| arc(piece, radius, count).take(count));
        arcs.collect()
    };
    let mut solid = |name: String, draw: &mut dyn FnMut(&mut Drawing)| {
        let solid = drawing.solid(name);
        draw(drawing);
        drawing.regions[solid].volume = drawing.body.volume(solid);
    };
    solid("hub".to_owned(), &mut |drawing| {
        drawing.prism(&circle(radius, within), DVec2::ZERO, levels);
    });
    for piece in 0..pieces {
        let inside: Vec<DVec2> = arc(piece, radius, within).collect();
        let outside: Vec<DVec2> = arc(piece, outer, without).collect();
        solid(format!("piece{piece}"), &mut |drawing| {
            drawing.slab(&inside, &outside, levels);
        });
    }
    let around = Circle {
        radius: outer * 1.4,
        sides: 2 * pieces,
        phase: 0.0,
    };
    solid("sleeve".to_owned(), &mut |drawing| {
        drawing.tube(&circle(outer, without), &around.corners(), levels);
    });
    drawing.order = pieces;
    let feature = format!("{pieces} pieces between hub and sleeve");
    drawing.features.push(feature);
}
