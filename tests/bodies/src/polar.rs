//! Assemblies on a polar grid: rotors, magnets, stators, vias, as cells of one material each around the z axis.

use crate::{Body, Face, Material};
use glam::DVec3;
use std::collections::HashMap;
use tmesh::Group;

/// A cell: its sector, its ring and its layer, counted from 0.
pub type Cell = [usize; 3];

/// A grid of sectors, rings and layers.
#[derive(Clone, Debug)]
pub struct PolarGrid {
    /// Sectors of the turn.
    pub sectors: usize,
    /// Radii between rings, increasing; 0 may be the first.
    pub radii: Vec<f64>,
    /// Heights between layers, increasing.
    pub heights: Vec<f64>,
}

impl PolarGrid {
    /// The body of the cells that have a material, an index into `names`. Solids share their triangles, which are as
    /// symmetric as the cells are. `group` is what the caller knows of the shape.
    pub fn build(
        &self,
        names: &[&str],
        group: Group,
        material: impl Fn(Cell) -> Option<usize>,
    ) -> Body {
        let mut faces = Faces {
            grid: self,
            ids: HashMap::new(),
            body: Body {
                vertices: Vec::new(),
                faces: Vec::new(),
                materials: names
                    .iter()
                    .map(|&name| Material { name: name.into() })
                    .collect(),
                order: group.order,
                group,
            },
        };
        let (n, rings, layers) = (self.sectors, self.radii.len() - 1, self.heights.len() - 1);
        for i in 0..n {
            let next = (i + 1) % n;
            for j in 0..=rings {
                for k in 0..=layers {
                    let at = |i: usize, j: Option<usize>, k: Option<usize>| {
                        let (j, k) = (j.filter(|j| *j < rings)?, k.filter(|k| *k < layers)?);
                        material([i, j, k])
                    };
                    let (below, inner) = (k.checked_sub(1), j.checked_sub(1));
                    let here = at(i, Some(j), Some(k));
                    // The face below the cell, the one towards the axis, and the one towards the sector before.
                    if j < rings {
                        let low = [[i, j, k], [i, j + 1, k], [next, j + 1, k], [next, j, k]];
                        faces.add(low, here, at(i, Some(j), below));
                    }
                    if k < layers {
                        let wall = [[i, j, k], [next, j, k], [next, j, k + 1], [i, j, k + 1]];
                        faces.add(wall, here, at(i, inner, Some(k)));
                    }
                    if j < rings && k < layers {
                        let side = [[i, j, k], [i, j, k + 1], [i, j + 1, k + 1], [i, j + 1, k]];
                        faces.add(side, here, at((i + n - 1) % n, Some(j), Some(k)));
                    }
                }
            }
        }
        faces.body
    }
}

/// The body while faces are added.
struct Faces<'a> {
    grid: &'a PolarGrid,
    ids: HashMap<Cell, u32>,
    body: Body,
}

impl Faces<'_> {
    fn vertex(&mut self, [i, j, k]: Cell) -> u32 {
        let radius = self.grid.radii[j];
        let key = if radius == 0.0 { [0, j, k] } else { [i, j, k] };
        let vertices = &mut self.body.vertices;
        *self.ids.entry(key).or_insert_with(|| {
            let angle = std::f64::consts::TAU * i as f64 / self.grid.sectors as f64;
            let (sin, cos) = angle.sin_cos();
            vertices.push(DVec3::new(radius * cos, radius * sin, self.grid.heights[k]));
            vertices.len() as u32 - 1
        })
    }

    /// Adds the face with these corners, counter-clockwise seen from the front, where it separates anything.
    fn add(&mut self, corners: [Cell; 4], front: Option<usize>, back: Option<usize>) {
        if front == back {
            return;
        }
        let mut ids: Vec<u32> = corners.iter().map(|&c| self.vertex(c)).collect();
        ids.dedup();
        if ids.last() == ids.first() {
            ids.pop();
        }
        let mut triangle = |vertices| {
            self.body.faces.push(Face {
                vertices,
                front,
                back,
            });
        };
        match ids[..] {
            [a, b, c] => triangle([a, b, c]),
            [a, b, c, d] => {
                // Diagonals would lean to one side.
                let vertices = &mut self.body.vertices;
                let sum: DVec3 = ids.iter().map(|&v| vertices[v as usize]).sum();
                vertices.push(0.25 * sum);
                let middle = vertices.len() as u32 - 1;
                for [p, q] in [[a, b], [b, c], [c, d], [d, a]] {
                    triangle([p, q, middle]);
                }
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tmesh::Kind;

    #[test]
    fn cells_have_their_volumes_and_are_closed() {
        let grid = PolarGrid {
            sectors: 8,
            radii: vec![0.0, 1.0, 2.0],
            heights: vec![0.0, 1.0, 3.0],
        };
        let body = grid.build(&["shaft", "ring"], Group::new(Kind::Cv, 8), |[_, j, k]| {
            (k == 0 || j == 0).then_some(j)
        });
        let sector = 0.5 * std::f64::consts::FRAC_PI_4.sin();
        let volumes = [0, 1].map(|m| body.volume(m));
        assert!(
            (volumes[0] - 8.0 * sector * 3.0).abs() < 1e-12,
            "{volumes:?}"
        );
        assert!(
            (volumes[1] - 8.0 * sector * 3.0).abs() < 1e-12,
            "{volumes:?}"
        );
        for material in 0..2 {
            let mut edges: HashMap<[u32; 2], i32> = HashMap::new();
            for [a, b, c] in body.solid(material) {
                for [p, q] in [[a, b], [b, c], [c, a]] {
                    *edges.entry([p.min(q), p.max(q)]).or_default() += if p < q { 1 } else { -1 };
                }
            }
            assert!(edges.values().all(|n| *n == 0));
        }
    }
}
