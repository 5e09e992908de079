//! Other triangles for the same shape: edges split, points put into flat faces, diagonals of flat
//! quadrilaterals exchanged.

use crate::Dice;
use crate::{Body, Face};
use glam::DVec3;
use std::collections::HashMap;

/// Largest distance from a plane of what counts as flat, in units of the outer radius.
const FLAT: f64 = 1e-12;

/// Least height of a triangle made here, relative to its longest edge.
const SLENDER: f64 = 0.02;

/// Changes triangles at random, `splits` and `flips` times; the shape stays what it is.
pub fn change(body: &mut Body, splits: usize, flips: usize, dice: &mut Dice) {
    for _ in 0..splits {
        let face = dice.below(body.faces.len());
        if dice.chance(0.5) {
            split_edge(body, face, dice);
        } else {
            split_face(body, face, dice);
        }
    }
    for _ in 0..flips {
        let face = dice.below(body.faces.len());
        flip(body, face, dice.below(3));
    }
}

fn split_face(body: &mut Body, face: usize, dice: &mut Dice) {
    let Face {
        vertices: [a, b, c],
        front,
        back,
    } = body.faces[face];
    let [p, q, r] = [a, b, c].map(|v| body.vertices[v as usize]);
    let weights = [(); 3].map(|()| dice.between(0.2, 1.0));
    let sum: f64 = weights.iter().sum();
    let at = (weights[0] * p + weights[1] * q + weights[2] * r) / sum;
    if slender(p, q, at) || slender(q, r, at) || slender(r, p, at) {
        return;
    }
    let new = body.vertices.len() as u32;
    body.vertices.push(at);
    for (k, vertices) in [[a, b, new], [b, c, new], [c, a, new]]
        .into_iter()
        .enumerate()
    {
        let piece = Face {
            vertices,
            front,
            back,
        };
        match k {
            0 => body.faces[face] = piece,
            _ => body.faces.push(piece),
        }
    }
}

fn split_edge(body: &mut Body, face: usize, dice: &mut Dice) {
    let corner = dice.below(3);
    let u = body.faces[face].vertices[corner];
    let v = body.faces[face].vertices[(corner + 1) % 3];
    let share = dice.between(0.3, 0.7);
    let at = body.vertices[u as usize].lerp(body.vertices[v as usize], share);
    let around: Vec<usize> = (0..body.faces.len())
        .filter(|&f| body.faces[f].vertices.contains(&u) && body.faces[f].vertices.contains(&v))
        .collect();
    let splits = around.iter().any(|&f| {
        let third = third(body.faces[f].vertices, u, v);
        let p = body.vertices[third as usize];
        slender(body.vertices[u as usize], at, p) || slender(at, body.vertices[v as usize], p)
    });
    if splits {
        return;
    }
    let new = body.vertices.len() as u32;
    body.vertices.push(at);
    for f in around {
        let old = body.faces[f];
        let with = |from: u32| old.vertices.map(|w| if w == from { new } else { w });
        body.faces[f].vertices = with(u);
        body.faces.push(Face {
            vertices: with(v),
            ..old
        });
    }
}

fn flip(body: &mut Body, face: usize, corner: usize) {
    let this = body.faces[face];
    let (u, v) = (this.vertices[corner], this.vertices[(corner + 1) % 3]);
    let others: Vec<usize> = (0..body.faces.len())
        .filter(|&f| {
            let w = &body.faces[f].vertices;
            f != face && w.contains(&u) && w.contains(&v)
        })
        .collect();
    let [other] = others[..] else { return };
    let that = body.faces[other];
    // The same orientation, so the edge runs the other way.
    let turned = directed(that.vertices, v, u);
    if !turned || (that.front, that.back) != (this.front, this.back) {
        return;
    }
    let (s, t) = (third(this.vertices, u, v), third(that.vertices, u, v));
    let [pu, pv, ps, pt] = [u, v, s, t].map(|w| body.vertices[w as usize]);
    let normal = (pv - pu).cross(ps - pu).normalize_or_zero();
    if normal.dot(pt - pu).abs() > FLAT || slender(ps, pt, pv) || slender(pt, ps, pu) {
        return;
    }
    let ahead = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a).dot(normal) > 0.0;
    if !ahead(ps, pt, pv) || !ahead(pt, ps, pu) || joined(body, s, t) {
        return;
    }
    body.faces[face].vertices = [s, t, v];
    body.faces[other].vertices = [t, s, u];
}

fn joined(body: &Body, s: u32, t: u32) -> bool {
    body.faces
        .iter()
        .any(|f| f.vertices.contains(&s) && f.vertices.contains(&t))
}

fn directed([a, b, c]: [u32; 3], from: u32, to: u32) -> bool {
    [(a, b), (b, c), (c, a)].contains(&(from, to))
}

fn third(vertices: [u32; 3], u: u32, v: u32) -> u32 {
    vertices[0] ^ vertices[1] ^ vertices[2] ^ u ^ v
}

/// Whether a triangle is narrower than those that are made here.
pub(crate) fn slender(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    (b - a).cross(c - a).length() < SLENDER * longest * longest
}

/// Least height of the body's triangles.
pub fn least_height(body: &Body) -> f64 {
    let heights = body.faces.iter().map(|face| {
        let [a, b, c] = face.vertices.map(|v| body.vertices[v as usize]);
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        (b - a).cross(c - a).length() / longest
    });
    heights.fold(f64::INFINITY, f64::min)
}

/// Whether solids touch in edges or vertices alone: an edge with more than two triangles that have
/// nothing on one side.
pub fn touches(body: &Body) -> bool {
    let mut outer: HashMap<[u32; 2], u32> = HashMap::new();
    for face in body
        .faces
        .iter()
        .filter(|f| f.front.is_none() || f.back.is_none())
    {
        let [a, b, c] = face.vertices;
        for (u, v) in [(a, b), (b, c), (c, a)] {
            *outer.entry([u.min(v), u.max(v)]).or_default() += 1;
        }
    }
    outer.values().any(|&count| count > 2)
}
