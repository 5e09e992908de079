//! Which cells of a grid are of which material.

use super::grid::Grid;
use super::group::Motion;
use crate::Dice;

/// Material of each cell, `None` for none: the same throughout each orbit of the group.
pub fn fill(
    grid: &Grid,
    motions: &[Motion],
    materials: usize,
    dice: &mut Dice,
) -> Vec<Option<usize>> {
    let table: Vec<Vec<usize>> = match dice.below(4) {
        0 => vec![vec![0; grid.rings]; grid.levels],
        1 => {
            let of_level: Vec<_> = (0..grid.levels).map(|_| dice.below(materials)).collect();
            of_level.iter().map(|&m| vec![m; grid.rings]).collect()
        }
        2 => {
            let of_ring: Vec<_> = (0..grid.rings).map(|_| dice.below(materials)).collect();
            vec![of_ring; grid.levels]
        }
        _ => (0..grid.levels)
            .map(|_| (0..grid.rings).map(|_| dice.below(materials)).collect())
            .collect(),
    };
    // From which ring on there are teeth, with gaps in which sectors.
    let toothed = dice.chance(0.5);
    let foot = dice.integer(usize::from(grid.rings > 1), grid.rings);
    let gap: Vec<bool> = (0..grid.sectors).map(|_| dice.chance(0.5)).collect();
    let scattered = if dice.chance(0.4) {
        dice.between(0.0, 0.5)
    } else {
        0.0
    };
    let hollow = dice.between(0.0, 1.0);
    for attempt in 0.. {
        // Where nothing is left in the end, there are no gaps.
        let toothed = toothed && attempt < 3;
        let mut filling = vec![None; grid.cell_count()];
        let mut done = vec![false; grid.cell_count()];
        for cell in 0..grid.cell_count() {
            if done[cell] {
                continue;
            }
            let [i, k, j] = grid.cell_place(cell);
            let mut material = Some(table[j][i]);
            if toothed && i >= foot && gap[k] {
                material = None;
            }
            if dice.chance(scattered) {
                let other = dice.below(materials);
                material = (!dice.chance(hollow)).then_some(other);
            }
            for &motion in motions {
                let image = grid.cell_image(cell, motion);
                filling[image] = material;
                done[image] = true;
            }
        }
        if filling.iter().any(Option::is_some) {
            return filling;
        }
    }
    unreachable!("cells that are not all scattered away come up in time")
}
