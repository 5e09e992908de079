//! Cutting the surface at the faces of a cell, one after the other.
//!
//! A flat patch that a face crosses is cut as one polygon and triangulated afresh, so the cut
//! depends on the shape and not on how its flat faces happened to be triangulated. Crossing points
//! are made once per edge and shared by all patches around it.

use super::cutter::{Cut, Cutter};
use super::shared::Shared;
use crate::cell::{Cell, Class, Role};
use crate::surface::Surface;
use rustc_hash::FxHashMap;
use tmesh::Triangle;

/// Keeps the part of the surface within all walls of a cell. Faces that lie in a wall go too; the caps replace them. So
/// do faces that a cut leaves in another wall, where it passes a point on the axis or near it.
pub fn clip(surface: &mut Surface, cell: &Cell) {
    let walls = cell.clips();
    let keeps = |face: usize, classes: [Class; 3]| {
        let lies_in = |wall: &usize| classes.iter().all(|c| c.of(*wall) == 0);
        classes.iter().all(|c| c.of(face) >= 0) && !walls.iter().any(lies_in)
    };
    let mut done = 0;
    for (i, &face) in walls.iter().enumerate() {
        let cut = Cut {
            face,
            done,
            outer: false,
            next: walls.get(i + 1).copied(),
        };
        divide(surface, cell, cut, |classes| keeps(face, classes));
        done |= 1 << face;
    }
}

/// Divides the surface at the hub's plane, if there is one, so that no face has points on both sides of it. Faces
/// that lie in the plane go; the caps replace them.
pub fn divide_at_hub(surface: &mut Surface, cell: &Cell) {
    let Some(face) = cell.hub() else {
        return;
    };
    let walls = cell.which(|f| f.role == Role::Wall);
    let cut = Cut {
        face,
        done: walls.fold(0, |bits, f| bits | 1 << f),
        outer: true,
        next: None,
    };
    divide(surface, cell, cut, |classes| {
        classes.iter().any(|c| c.of(face) != 0)
    });
}

/// Divides all patches that cross a face, and keeps the faces whose points have the right classes.
fn divide(surface: &mut Surface, cell: &Cell, cut: Cut, wanted: impl Fn([Class; 3]) -> bool) {
    let mut members: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    let mut cutter = Cutter::new(cell, cut);
    let faces = std::mem::take(&mut surface.faces);
    let patches = std::mem::take(&mut surface.patches);
    let count = patches.iter().map(|p| p + 1).max().unwrap_or(0) as usize;
    // Per patch: whether it has points beyond, and on the cell's side, and passes a line that divides the face.
    let mut reach = vec![(false, false, false); count];
    for (face, &patch) in faces.iter().zip(&patches) {
        let r = &mut reach[patch as usize];
        for k in 0..3 {
            let (v, w) = (face.vertices[k], face.vertices[(k + 1) % 3]);
            let class = surface.classes[v as usize].of(cut.face);
            r.0 |= class < 0;
            r.1 |= class > 0;
            r.2 |= cutter.passes_fold(surface, v, w);
        }
    }
    let keeps = |surface: &Surface, face: &Triangle| {
        wanted(face.vertices.map(|v| surface.classes[v as usize]))
    };
    for (i, (face, &patch)) in faces.iter().zip(&patches).enumerate() {
        match reach[patch as usize] {
            (true, true, _) | (_, true, true) => members.entry(patch).or_default().push(i as u32),
            _ if keeps(surface, face) => {
                surface.faces.push(*face);
                surface.patches.push(patch);
            }
            _ => {}
        }
    }
    let shared = Shared::new(&faces, &patches, surface.points.len());
    let mut crossed: Vec<_> = members.into_iter().collect();
    crossed.sort_unstable_by_key(|(patch, _)| *patch);
    for (patch, members) in crossed {
        let part: Vec<Triangle> = members.iter().map(|&i| faces[i as usize]).collect();
        let cut = cutter
            .cut_flat(surface, &part, &shared)
            .unwrap_or_else(|| cutter.cut_singly(surface, &part));
        for face in cut {
            if keeps(surface, &face) {
                surface.faces.push(face);
                surface.patches.push(patch);
            }
        }
    }
}
