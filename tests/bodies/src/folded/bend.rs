//! Bending of flat facets, the same in all images.

use super::images::{Image, images};
use crate::random_solid::slender;
use crate::{Body, Dice, Face};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Sine of the angle within which triangles are in one plane.
const FLAT: f64 = 1e-9;

/// Share of the distance to anything else by which a vertex is moved at most, so that nothing comes to cross.
const CLEAR: f64 = 0.1;

/// What was bent.
pub struct Bent {
    /// Vertices moved off the planes that they were on.
    pub vertices: usize,
    /// Largest angle that a facet beside one of them was turned by, radians.
    pub angle: f64,
}

/// Bends a body drawn about the z axis, about its flat facets: by points put into them or on edges across them, or by all corners
/// moved, so that facets fold along their diagonals. Facets are turned by up to `angle`, radians.
pub fn bend(body: &mut Body, sectors: u32, angle: f64, dice: &mut Dice) -> Bent {
    if dice.chance(0.25) {
        return corners(body, sectors, angle, dice);
    }
    let few = dice.integer(1, 6);
    for _ in 0..few {
        let all = images(body, sectors);
        match dice.chance(0.5) {
            true => split_faces(body, &all, dice),
            false => split_edges(body, &all, dice),
        }
    }
    inside(body, sectors, angle, dice)
}

/// Moves vertices inside of flat faces off their planes, none of them beside another one.
fn inside(body: &mut Body, sectors: u32, angle: f64, dice: &mut Dice) -> Bent {
    let all = images(body, sectors);
    let around = around(body);
    let mut bent = Bent {
        vertices: 0,
        angle: 0.0,
    };
    let mut beside = BTreeSet::new();
    for v in 0..body.vertices.len() as u32 {
        let Some(normal) = flat_normal(body, &around[v as usize]) else {
            continue;
        };
        let orbit = orbit(&all, v);
        let neighbours: BTreeSet<u32> = (around[v as usize].iter())
            .flat_map(|&f| body.faces[f].vertices)
            .collect();
        let meets = |w: &u32| *w != v && orbit.contains_key(w);
        if beside.contains(&v) || neighbours.iter().any(meets) || dice.chance(0.2) {
            continue;
        }
        // What keeps the vertex in place keeps its way, too.
        let up = fixed(&all, v, |image| image.motion.apply(normal));
        let turn = angle * dice.between(0.3, 1.0) * dice.pick(&[-1.0, 1.0]);
        if up.length() < 0.5 {
            continue;
        }
        let width = width(body, v, &around[v as usize]);
        let most = CLEAR * clearance(body, v);
        let height = (width * libm::tan(turn)).clamp(-most, most);
        bent.angle = bent.angle.max(libm::atan(height.abs() / width));
        bent.vertices += orbit.len();
        for (&w, &image) in &orbit {
            body.vertices[w as usize] += height * all[image].motion.apply(up.normalize());
            let faces = around[w as usize].iter();
            beside.extend(faces.flat_map(|&f| body.faces[f].vertices));
        }
    }
    bent
}

/// Moves all vertices at random.
fn corners(body: &mut Body, sectors: u32, angle: f64, dice: &mut Dice) -> Bent {
    let all = images(body, sectors);
    let around = around(body);
    let mut moves: BTreeMap<u32, DVec3> = BTreeMap::new();
    let mut largest = 0.0_f64;
    for v in 0..body.vertices.len() as u32 {
        if moves.contains_key(&v) {
            continue;
        }
        let random = DVec3::new(dice.signed(), dice.signed(), dice.signed());
        let step = fixed(&all, v, |image| image.motion.apply(random));
        let width = width(body, v, &around[v as usize]);
        let most = CLEAR * clearance(body, v);
        // A cube's corner is at a distance of the root of three.
        let length = (width * libm::tan(angle) / f64::sqrt(3.0)).min(most);
        largest = largest.max(libm::atan(length * step.length() / width));
        for (w, image) in orbit(&all, v) {
            moves.insert(w, length * all[image].motion.apply(step));
        }
    }
    for (v, step) in &moves {
        body.vertices[*v as usize] += *step;
    }
    Bent {
        vertices: moves.len(),
        angle: largest,
    }
}

/// Puts a point into a triangle, and into its images.
fn split_faces(body: &mut Body, all: &[Image], dice: &mut Dice) {
    let face = dice.below(body.faces.len());
    let corners = body.faces[face].vertices;
    let [p, q, r] = corners.map(|v| body.vertices[v as usize]);
    let weights = [(); 3].map(|()| dice.between(0.2, 1.0));
    let sum: f64 = weights.iter().sum();
    let point = (weights[0] * p + weights[1] * q + weights[2] * r) / sum;
    let at = kept(all, &corners, point);
    if slender(p, q, at) || slender(q, r, at) || slender(r, p, at) {
        return;
    }
    let of_face: HashMap<[u32; 3], usize> = (0..body.faces.len())
        .map(|f| (sorted(body.faces[f].vertices), f))
        .collect();
    let mut done = BTreeSet::new();
    for image in all {
        let target = of_face[&sorted(corners.map(|v| image.of[v as usize]))];
        if done.insert(target) {
            let new = body.vertices.len() as u32;
            body.vertices.push(image.motion.apply(at));
            let old = body.faces[target];
            let [a, b, c] = old.vertices;
            let piece = |vertices| Face { vertices, ..old };
            body.faces[target] = piece([a, b, new]);
            body.faces.extend([piece([b, c, new]), piece([c, a, new])]);
        }
    }
}

/// Puts a point on an edge across a flat face, and on its images; not where two of these are sides of one triangle.
fn split_edges(body: &mut Body, all: &[Image], dice: &mut Dice) {
    let face = dice.below(body.faces.len());
    let corner = dice.below(3);
    let vertices = body.faces[face].vertices;
    let ends = [vertices[corner], vertices[(corner + 1) % 3]];
    let has = |f: &Face, [u, v]: [u32; 2]| f.vertices.contains(&u) && f.vertices.contains(&v);
    let beside: Vec<usize> = (0..body.faces.len())
        .filter(|&f| has(&body.faces[f], ends))
        .collect();
    if beside.len() != 2 || flat_normal(body, &beside).is_none() {
        return;
    }
    let [p, q] = ends.map(|v| body.vertices[v as usize]);
    let at = kept(all, &ends, p.lerp(q, dice.between(0.3, 0.7)));
    let third = |f: usize| {
        body.faces[f]
            .vertices
            .into_iter()
            .find(|v| !ends.contains(v))
    };
    let apexes = beside.iter().filter_map(|&f| third(f));
    if apexes
        .map(|v| body.vertices[v as usize])
        .any(|apex| slender(p, at, apex) || slender(at, q, apex))
    {
        return;
    }
    let mut edges: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    for (i, image) in all.iter().enumerate() {
        let [u, v] = ends.map(|v| image.of[v as usize]);
        edges.entry([u.min(v), u.max(v)]).or_insert(i);
    }
    let sides = |f: &Face| {
        let [a, b, c] = f.vertices;
        let sides = [[a, b], [b, c], [c, a]];
        let of_orbit = sides
            .iter()
            .filter(|[u, v]| edges.contains_key(&[*u.min(v), *u.max(v)]));
        of_orbit.count()
    };
    if body.faces.iter().any(|f| sides(f) > 1) {
        return;
    }
    for ([u, v], image) in edges {
        let new = body.vertices.len() as u32;
        body.vertices.push(all[image].motion.apply(at));
        for f in 0..body.faces.len() {
            let old = body.faces[f];
            if has(&old, [u, v]) {
                let with = |from: u32| Face {
                    vertices: old.vertices.map(|w| if w == from { new } else { w }),
                    ..old
                };
                body.faces[f] = with(u);
                body.faces.push(with(v));
            }
        }
    }
}

/// A point moved to where the images that take these vertices to each other leave it.
fn kept(all: &[Image], vertices: &[u32], p: DVec3) -> DVec3 {
    let stays = |image: &&Image| {
        let mut there = vertices.iter().map(|v| image.of[*v as usize]);
        there.all(|v| vertices.contains(&v))
    };
    let places: Vec<DVec3> = (all.iter().filter(stays))
        .map(|image| image.motion.apply(p))
        .collect();
    places.iter().sum::<DVec3>() / places.len() as f64
}

/// The mean of a vector over the images that leave a vertex in place.
fn fixed(all: &[Image], v: u32, of: impl Fn(&Image) -> DVec3) -> DVec3 {
    let staying = all.iter().filter(|image| image.of[v as usize] == v);
    let vectors: Vec<DVec3> = staying.map(of).collect();
    vectors.iter().sum::<DVec3>() / vectors.len() as f64
}

/// The images of a vertex, each with the number of what takes it there.
fn orbit(all: &[Image], v: u32) -> BTreeMap<u32, usize> {
    let mut orbit = BTreeMap::new();
    for (i, image) in all.iter().enumerate() {
        orbit.entry(image.of[v as usize]).or_insert(i);
    }
    orbit
}

/// Faces around each vertex.
fn around(body: &Body) -> Vec<Vec<usize>> {
    let mut around = vec![Vec::new(); body.vertices.len()];
    for (f, face) in body.faces.iter().enumerate() {
        face.vertices
            .iter()
            .for_each(|&v| around[v as usize].push(f));
    }
    around
}

/// The normal that faces have in common, if they are in one plane with the same materials on both sides.
fn flat_normal(body: &Body, faces: &[usize]) -> Option<DVec3> {
    let first = body.faces[*faces.first()?];
    let normal = |f: &Face| {
        let [a, b, c] = f.vertices.map(|v| body.vertices[v as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let same = |&f: &usize| {
        let face = &body.faces[f];
        let turned = normal(face);
        let alike = match (face.front, face.back) {
            sides if sides == (first.front, first.back) => turned,
            sides if sides == (first.back, first.front) => -turned,
            _ => DVec3::ZERO,
        };
        alike.dot(normal(&first)) > 0.5 && alike.cross(normal(&first)).length() <= FLAT
    };
    faces.iter().all(same).then(|| normal(&first))
}

/// The least distance of a vertex from the sides opposite to it.
fn width(body: &Body, v: u32, around: &[usize]) -> f64 {
    let heights = around.iter().map(|&f| {
        let [a, b, c] = body.faces[f].vertices.map(|v| body.vertices[v as usize]);
        let opposite = match body.faces[f].vertices.iter().position(|&w| w == v) {
            Some(0) => c - b,
            Some(1) => a - c,
            _ => b - a,
        };
        (b - a).cross(c - a).length() / opposite.length()
    });
    heights.fold(f64::INFINITY, f64::min)
}

/// Distance of a vertex from triangles that it is no corner of.
fn clearance(body: &Body, v: u32) -> f64 {
    let p = body.vertices[v as usize];
    let others = body.faces.iter().filter(|f| !f.vertices.contains(&v));
    let distances = others.map(|f| distance(p, f.vertices.map(|v| body.vertices[v as usize])));
    distances.fold(f64::INFINITY, f64::min)
}

/// Distance of a point from a triangle.
fn distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let inside = [(a, b), (b, c), (c, a)]
        .into_iter()
        .all(|(u, v)| (v - u).cross(p - u).dot(normal) >= 0.0);
    let side = |u: DVec3, v: DVec3| {
        let along = v - u;
        let share = ((p - u).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        p.distance(u + share * along)
    };
    match inside {
        true => (p - a).dot(normal).abs(),
        false => side(a, b).min(side(b, c)).min(side(c, a)),
    }
}

fn sorted(mut corners: [u32; 3]) -> [u32; 3] {
    corners.sort_unstable();
    corners
}
