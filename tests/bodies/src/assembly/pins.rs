//! Plates with a bore and a pin through it, and posts on plates.

use super::draw::{Circle, Drawing};
use crate::Dice;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A stack of plates with a pin, or a plate with posts.
pub fn draw(drawing: &mut Drawing, dice: &mut Dice) {
    if dice.chance(0.5) {
        stack(drawing, dice);
    } else {
        posts(drawing, dice);
    }
}

/// Plates that a pin passes through.
fn stack(drawing: &mut Drawing, dice: &mut Dice) {
    let radius = dice.between(0.5, 1.5);
    let count = dice.integer(1, 3);
    let pin = Circle::random(radius, dice);
    let levels = [
        -dice.pick(&[0.0, 1.0]),
        count as f64 + dice.pick(&[0.0, 1.0, -0.25]),
    ];
    let solid = drawing.solid("pin".to_owned());
    drawing.prism(&pin.corners(), DVec2::ZERO, levels);
    drawing.regions[solid].volume = drawing.body.volume(solid);
    for i in 0..count {
        let bore = Circle::random(radius, dice);
        let wide = dice.between(1.4, 3.0) * radius;
        let outer = match dice.chance(0.5) {
            true => Circle::random(wide, dice).corners(),
            false => {
                let long = wide * dice.between(1.0, 1.5);
                [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
                    .map(|(x, y)| DVec2::new(x * wide, y * long))
                    .to_vec()
            }
        };
        let between = [i as f64, (i + 1) as f64];
        let plate = drawing.solid(format!("plate{i}"));
        drawing.tube(&bore.corners(), &outer, between);
        drawing.regions[plate].volume = drawing.body.volume(plate);
        let slack = TAU * radius * (bore.sagitta() + pin.sagitta());
        drawing.regions[plate].slack += slack;
        // Facets of the pin that are bent to a plate slope from there to the ends of the pin.
        let long = (levels[1] - levels[0]) / count as f64;
        drawing.regions[solid].slack += slack * long.max(1.0);
    }
    drawing.features.push(format!("pin in {count} plates"));
}

/// Posts on a plate or sunk into it, blocks and cylinders, apart from each other.
fn posts(drawing: &mut Drawing, dice: &mut Dice) {
    let solid = drawing.solid("plate".to_owned());
    drawing.block(DVec3::new(-5.0, -5.0, 0.0), DVec3::new(5.0, 5.0, 1.0), dice);
    drawing.regions[solid].volume = drawing.body.volume(solid);
    let mut count = 0;
    for x in [-3.4, 0.0, 3.4] {
        for y in [-3.4, 0.0, 3.4] {
            if !dice.chance(0.5) {
                continue;
            }
            let place =
                DVec2::new(x, y) + DVec2::new(dice.between(-0.4, 0.4), dice.between(-0.4, 0.4));
            let wide = dice.between(0.5, 1.1);
            let sunk = dice.pick(&[0.0, 0.0, 0.0, 0.5, 0.2]);
            let levels = [1.0 - sunk, 1.0 + dice.between(0.5, 2.0)];
            let post = drawing.solid(format!("post{count}"));
            if dice.chance(0.5) {
                let (low, high) = (place - DVec2::splat(wide), place + DVec2::splat(wide));
                drawing.block(low.extend(levels[0]), high.extend(levels[1]), dice);
            } else {
                let circle = Circle::random(wide, dice);
                let corners: Vec<DVec2> = circle.corners().iter().map(|&p| p + place).collect();
                drawing.prism(&corners, place, levels);
            }
            let volume = drawing.body.volume(post);
            drawing.regions[post].volume = volume;
            // The later one has what both claim.
            drawing.regions[solid].volume -= volume * sunk / (levels[1] - levels[0]);
            count += 1;
        }
    }
    drawing.features.push(format!("{count} posts"));
}
