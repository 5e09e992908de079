//! Small bodies within cells: inclusions, voids, islands.

use super::grid::Grid;
use super::group::Motion;
use crate::Dice;
use crate::{Body, Face};
use glam::{DMat3, DQuat, DVec3};

/// Share of the room in a cell that an inclusion takes.
const FILLED: f64 = 0.6;

/// A polyhedron about the origin, within the unit sphere, triangles counter-clockwise from outside.
struct Polyhedron {
    points: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
}

fn octahedron() -> Polyhedron {
    let mut triangles = Vec::new();
    for corner in 0..8 {
        let [x, y, z] = [corner & 1, 2 + (corner >> 1 & 1), 4 + (corner >> 2)];
        let even = (corner & 1) + (corner >> 1 & 1) + (corner >> 2);
        triangles.push(if even % 2 == 0 { [x, y, z] } else { [x, z, y] });
    }
    let points = [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .flat_map(|axis| [axis, -axis])
        .collect();
    Polyhedron { points, triangles }
}

fn cuboid(half: DVec3) -> Polyhedron {
    let half = half.normalize();
    let points = (0..8)
        .map(|c| half * DVec3::new(sign(c & 1), sign(c >> 1 & 1), sign(c >> 2)))
        .collect();
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    Polyhedron { points, triangles }
}

fn tetrahedron() -> Polyhedron {
    let points = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
        .map(|p| DVec3::from_array(p.map(f64::from)).normalize());
    Polyhedron {
        points: points.to_vec(),
        triangles: vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
    }
}

fn sign(bit: usize) -> f64 {
    if bit == 1 { 1.0 } else { -1.0 }
}

/// Puts polyhedra of other materials, or of none, into all cells of some orbits. Returns for
/// each cell that got one the first cell of its orbit.
pub fn include(
    body: &mut Body,
    grid: &Grid,
    motions: &[Motion],
    filling: &[Option<usize>],
    middles: &[DVec3],
    clearances: &[f64],
    dice: &mut Dice,
) -> Vec<Option<usize>> {
    let mut origins = vec![None; filling.len()];
    let mut done = vec![false; filling.len()];
    let share = dice.between(0.05, 0.5);
    for cell in 0..filling.len() {
        if done[cell] {
            continue;
        }
        let images: Vec<usize> = motions.iter().map(|m| grid.cell_image(cell, *m)).collect();
        images.iter().for_each(|&image| done[image] = true);
        if !dice.chance(share) {
            continue;
        }
        let other = dice.below(body.materials.len() + 1).checked_sub(1);
        if other == filling[cell] {
            continue;
        }
        let alone = images.iter().filter(|&&image| image == cell).count() == 1;
        let (solid, turn) = inclusion(alone, dice);
        for (&motion, &image) in motions.iter().zip(&images) {
            if origins[image].is_some() {
                continue;
            }
            origins[image] = Some(cell);
            let radial = DVec3::new(middles[image].x, middles[image].y, 0.0).normalize();
            let frame = DMat3::from_cols(radial, DVec3::Z.cross(radial), DVec3::Z);
            let size = FILLED * clearances[image];
            let first = body.vertices.len() as u32;
            for &p in &solid.points {
                let mut p = turn * p;
                if motion.mirror {
                    p.y = -p.y;
                }
                if motion.flip {
                    p.z = -p.z;
                }
                body.vertices.push(middles[image] + size * (frame * p));
            }
            for &[a, b, c] in &solid.triangles {
                let [b, c] = if motion.reverses() { [c, b] } else { [b, c] };
                body.faces.push(Face {
                    vertices: [a, b, c].map(|v| first + v as u32),
                    front: filling[image],
                    back: other,
                });
            }
        }
    }
    origins
}

/// A polyhedron for a cell: turned at random where the cell is mapped onto itself by nothing but the
/// identity, else one that has the mirror planes of its frame.
fn inclusion(alone: bool, dice: &mut Dice) -> (Polyhedron, DMat3) {
    let half = DVec3::new(
        dice.between(0.2, 1.0),
        dice.between(0.2, 1.0),
        dice.between(0.2, 1.0),
    );
    let turned = alone && dice.chance(0.7);
    let turn = if turned {
        let [x, y, z, w] = [(); 4].map(|()| dice.signed());
        DMat3::from_quat(DQuat::from_xyzw(x, y, z, w + 1e-3).normalize())
    } else {
        DMat3::IDENTITY
    };
    match dice.below(if alone { 3 } else { 2 }) {
        0 => (octahedron(), turn),
        1 => (cuboid(half), turn),
        _ => (tetrahedron(), turn),
    }
}
