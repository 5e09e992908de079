//! Tubes around one another, as liners and coatings are, each cylinder drawn twice with different polygons.

use super::draw::{Circle, Drawing};
use crate::Dice;
use std::f64::consts::TAU;

/// A rod or a tube and up to four tubes around it.
pub fn draw(drawing: &mut Drawing, dice: &mut Dice) {
    let mut radius = dice.between(1.0, 2.0);
    let height = dice.between(1.0, 4.0);
    let mut outer = Circle::random(radius, dice);
    let mut last = [0.0, height];
    let solid = drawing.solid("ring0".to_owned());
    drawing.prism(&outer.corners(), glam::DVec2::ZERO, last);
    drawing.regions[solid].volume = drawing.body.volume(solid);
    let rings = dice.integer(1, 4);
    let mut offsets = Vec::new();
    for i in 1..=rings {
        let [below, above] = [
            dice.pick(&[0.0, 0.0, -0.5, 0.3]),
            dice.pick(&[0.0, 0.0, 0.7, -0.2]),
        ];
        let levels = [below, height + above];
        let mut inner = Circle::random(radius, dice);
        // Gaps and overlaps up to ten times of what facets leave open.
        let open = 0.5 * (inner.sagitta() + outer.sagitta());
        let off = dice.pick(&[0.0, 0.0, 0.0, 0.1, 0.5, 2.0, 10.0, -0.1, -0.5, -2.0]) * open;
        inner.radius += off;
        offsets.push(format!("{:.1}", off / open));
        radius = inner.radius.max(outer.radius) + dice.between(0.4, 0.5) * radius;
        let wider = Circle::random(radius, dice);
        let solid = drawing.solid(format!("ring{i}"));
        drawing.tube(&inner.corners(), &wider.corners(), levels);
        drawing.regions[solid].volume = drawing.body.volume(solid);
        let common = last[1].min(levels[1]) - last[0].max(levels[0]);
        let slack = TAU * inner.radius * common * (inner.sagitta() + outer.sagitta() + off.abs());
        drawing.regions[solid].slack += slack;
        drawing.regions[solid - 1].slack += slack;
        outer = wider;
        last = levels;
    }
    drawing
        .features
        .push(format!("{} rings, off by {}", rings + 1, offsets.join(" ")));
}
