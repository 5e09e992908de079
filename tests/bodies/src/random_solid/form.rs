//! Where the nodes of a grid are: rings and levels, deformed as the group allows.

use super::grid::{Face, Grid};
use super::group::Motion;
use crate::Dice;
use glam::DVec3;
use tmesh::Isometry;

/// How much of the clearance of a cell has to be left by a deformation.
const LEFT: f64 = 0.3;

/// Sizes and deformations, in units of the outer radius.
#[derive(Clone, Debug)]
pub struct Form {
    /// Radii of the rings of nodes, from 0 or the bore's to 1.
    pub radii: Vec<f64>,
    /// Heights of the levels of nodes, symmetric about 0 where the group turns the axis over.
    pub heights: Vec<f64>,
    /// Largest shares by which the radius of a level differs from 1.
    pub profile: f64,
    /// Turn from the lowest to the highest level, radians.
    pub twist: f64,
    /// Largest rise of a ring, in units of the height.
    pub dish: f64,
    /// Random displacements, in shares of the width of the neighbouring cells.
    pub roughness: f64,
    /// Random displacements around the axis of the lines of nodes, in shares of a sector.
    pub unevenness: f64,
}

impl Form {
    /// Places of the nodes, Cartesian, and the share of the deformation that leaves all cells
    /// star-shaped.
    pub fn places(
        &self,
        grid: &Grid,
        faces: &[Face],
        motions: &[Motion],
        dice: &mut Dice,
    ) -> (Vec<DVec3>, f64) {
        let offsets = symmetric(grid, motions, &self.offsets(grid, dice));
        let at_rest = grid.clearances(faces, &self.deformed(grid, &offsets, 0.0));
        let mut share = 1.0;
        loop {
            let places = self.deformed(grid, &offsets, share);
            let clear = grid.clearances(faces, &places);
            if share == 0.0 || clear.iter().zip(&at_rest).all(|(c, r)| *c > LEFT * r) {
                return (places, share);
            }
            share = if share > 0.1 { 0.5 * share } else { 0.0 };
        }
    }

    /// Displacements of the nodes: radius, angle, height.
    fn offsets(&self, grid: &Grid, dice: &mut Dice) -> Vec<DVec3> {
        let height = self.heights[grid.levels] - self.heights[0];
        let profile: Vec<f64> = self.heights.iter().map(|_| dice.signed()).collect();
        let dish: Vec<f64> = self.radii.iter().map(|_| dice.signed()).collect();
        let uneven: Vec<f64> = (0..grid.sectors).map(|_| dice.signed()).collect();
        let sector = std::f64::consts::TAU / grid.sectors as f64;
        (0..grid.node_count())
            .map(|id| {
                let [i, k, j] = grid.node_place(id);
                let rough =
                    self.roughness * DVec3::new(dice.signed(), dice.signed(), dice.signed());
                let share = (self.heights[j] - self.heights[0]) / height;
                DVec3::new(
                    self.radii[i] * self.profile * profile[j] + rough.x * spacing(&self.radii, i),
                    self.twist * share + sector * (self.unevenness * uneven[k] + rough.y),
                    self.dish * height * dish[i] + rough.z * spacing(&self.heights, j),
                )
            })
            .collect()
    }

    fn deformed(&self, grid: &Grid, offsets: &[DVec3], share: f64) -> Vec<DVec3> {
        (0..grid.node_count())
            .map(|id| {
                let [i, k, j] = grid.node_place(id);
                let d = share * offsets[id];
                let (c, s) = Isometry::rotation(k as i64, grid.sectors as u32).cos_sin();
                let (tc, ts) = (libm::cos(d.y), libm::sin(d.y));
                let r = match i == 0 && !grid.bored {
                    true => 0.0,
                    false => self.radii[i] + d.x,
                };
                DVec3::new(
                    r * (c * tc - s * ts),
                    r * (s * tc + c * ts),
                    self.heights[j] + d.z,
                )
            })
            .collect()
    }
}

/// The lesser of the distances of a value from its neighbours.
fn spacing(values: &[f64], index: usize) -> f64 {
    let below = index.checked_sub(1).map(|b| values[index] - values[b]);
    let above = values.get(index + 1).map(|a| a - values[index]);
    let least = below.unwrap_or(f64::INFINITY);
    least.min(above.unwrap_or(f64::INFINITY))
}

/// Offsets that the group maps onto themselves: each orbit follows its first node.
fn symmetric(grid: &Grid, motions: &[Motion], offsets: &[DVec3]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; offsets.len()];
    let mut counts = vec![0_u32; offsets.len()];
    for id in 0..offsets.len() {
        let [i, k, _] = grid.node_place(id);
        let idle = i == 0 && !grid.bored && k > 0;
        if counts[id] > 0 || idle {
            continue;
        }
        for &motion in motions {
            let image = grid.node_image(id, motion);
            let mut d = offsets[id];
            if motion.mirror {
                d.y = -d.y;
            }
            if motion.flip {
                d.z = -d.z;
            }
            sums[image] += d;
            counts[image] += 1;
        }
    }
    sums.iter()
        .zip(&counts)
        .map(|(sum, &count)| *sum / f64::from(count.max(1)))
        .collect()
}
