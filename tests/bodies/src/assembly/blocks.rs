//! Boxes that touch in planes, overlap, lie in one another or leave gaps.

use super::draw::Drawing;
use crate::Dice;
use glam::DVec3;

/// Up to eight boxes between a few places along each axis.
pub fn draw(drawing: &mut Drawing, dice: &mut Dice) {
    let count = dice.integer(2, 8);
    let axis = |dice: &mut Dice| -> Vec<f64> {
        let mut places = vec![0.0];
        for _ in 0..dice.integer(2, 4) {
            let last: f64 = *places.last().expect("there is one");
            places.push(last + dice.between(0.3, 1.5));
        }
        // Places that are nearly others.
        if dice.chance(0.2) {
            let near = dice.pick(&places) + dice.log_between(1e-3, 1e-1);
            places.push(near);
        }
        places.sort_by(f64::total_cmp);
        places.dedup();
        places
    };
    let axes = [axis(dice), axis(dice), axis(dice)];
    let mut boxes: Vec<[DVec3; 2]> = Vec::new();
    for _ in 0..count {
        let mut low = DVec3::ZERO;
        let mut high = DVec3::ZERO;
        for (a, places) in axes.iter().enumerate() {
            let i = dice.below(places.len() - 1);
            let j = dice.integer(i + 1, (i + 2).min(places.len() - 1));
            (low[a], high[a]) = (places[i], places[j]);
        }
        if !boxes.contains(&[low, high]) {
            boxes.push([low, high]);
        }
    }
    // A box that others cover has nothing left; later ones of the same place are left out.
    loop {
        let volumes = volumes(&boxes, &axes);
        match volumes.iter().position(|&v| v <= 0.0) {
            Some(empty) => {
                boxes.remove(empty);
            }
            None => {
                for (i, ([low, high], volume)) in boxes.iter().zip(volumes).enumerate() {
                    let solid = drawing.solid(format!("block{i}"));
                    drawing.block(*low, *high, dice);
                    drawing.regions[solid].volume = volume;
                }
                break;
            }
        }
    }
    drawing.features.push(format!("{} blocks", boxes.len()));
}

/// What each box has: of those in a cell, the one that lies in all others, or else the last one.
fn volumes(boxes: &[[DVec3; 2]], axes: &[Vec<f64>; 3]) -> Vec<f64> {
    let lies_in = |a: usize, b: usize| {
        boxes[b][0].cmple(boxes[a][0]).all() && boxes[a][1].cmple(boxes[b][1]).all()
    };
    let mut volumes = vec![0.0; boxes.len()];
    let [xs, ys, zs] = axes;
    for x in xs.windows(2) {
        for y in ys.windows(2) {
            for z in zs.windows(2) {
                let (low, high) = (DVec3::new(x[0], y[0], z[0]), DVec3::new(x[1], y[1], z[1]));
                let here = (0..boxes.len())
                    .filter(|&b| boxes[b][0].cmple(low).all() && high.cmple(boxes[b][1]).all());
                let winner = here.reduce(|a, b| if lies_in(a, b) { a } else { b });
                if let Some(winner) = winner {
                    volumes[winner] += (high - low).element_product();
                }
            }
        }
    }
    volumes
}
