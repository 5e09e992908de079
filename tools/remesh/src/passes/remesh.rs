//! The whole of it.

use super::collapse::collapse;
use super::flip::flip;
use super::relocate::relocate;
use super::rows::Rows;
use super::split::split;
use super::worth::{LONG, SHORT};
use crate::input::{Rules, Surface};
use crate::mesh::{Images, Mesh, NONE};
use crate::shape::{Allowance, Curves, Envelope, Patches};
use geom::contacts::contacts;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// A surface that was remeshed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remeshed {
    /// The surface.
    pub surface: Surface,
    /// New vertex of each vertex of the input, or `u32::MAX`.
    pub vertices: Vec<u32>,
    /// New triangle of each triangle of the input that stayed as it was, or `u32::MAX`.
    pub triangles: Vec<u32>,
    /// The planes and lines that each new vertex is on.
    pub bound: Vec<u32>,
    /// Of each link, the new vertices with their images.
    pub links: Vec<Vec<[u32; 2]>>,
    /// What was done.
    pub told: Told,
}

/// What was done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Told {
    /// Edges collapsed.
    pub collapsed: usize,
    /// Edges split.
    pub split: usize,
    /// Edges flipped.
    pub flipped: usize,
    /// Vertices moved.
    pub moved: usize,
}

impl Told {
    /// Whether anything was done.
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

/// Sharpest corner of a facet, degrees, below which a patch is remeshed: what the mesher keeps of a corner between segments is
/// an angle of elements, and below 20 degrees that is less than what they get elsewhere.
const SHARP: f64 = 20.0;
/// Edges shorter than this, relative to the length wanted, go even where a patch is not remeshed: what a cut leaves of
/// a facet.
const DETAIL: f64 = 0.25;
/// Rounds of splitting, collapsing, flipping and moving: vertices settle within five (Botsch and Kobbelt).
const ROUNDS: usize = 6;
/// Attempts at a surface without self-intersections, each with more around those of the one before left as it was.
const ATTEMPTS: u32 = 4;

/// Remeshes a surface within the rules. `None` where there is nothing to do, or nothing that could be done.
pub fn remesh(surface: &Surface, rules: &Rules<'_>) -> Option<Remeshed> {
    if rules.links.len() > Images::MOST {
        return None;
    }
    let mut held = rules.held.to_vec();
    for attempt in 0..ATTEMPTS {
        let rules = Rules {
            held: &held,
            ..*rules
        };
        let remeshed = once(surface, &rules)?;
        let crossing = crossings(&remeshed.surface);
        if crossing.is_empty() {
            return Some(remeshed);
        }
        let grows = f64::from(1 << attempt);
        for (place, size) in crossing {
            for (held, p) in held.iter_mut().zip(&surface.points) {
                *held |= p.distance(place) <= grows * size;
            }
        }
    }
    None
}

/// Places where triangles meet that should not, with their size.
fn crossings(surface: &Surface) -> Vec<(DVec3, f64)> {
    let mut found = Vec::new();
    contacts(
        &surface.points,
        &surface.triangles,
        |t| t,
        |contact| {
            let sides = contact.triangles.into_iter().flat_map(|t| {
                let [a, b, c] = surface.corners(t);
                [a.distance(b), b.distance(c), c.distance(a)]
            });
            found.push((contact.point, sides.fold(0.0, f64::max)));
            true
        },
    );
    found
}

fn once(surface: &Surface, rules: &Rules<'_>) -> Option<Remeshed> {
    let patches = Patches::new(surface, rules);
    let curves = Curves::new(surface, rules, &patches);
    let allowance = Allowance::new(surface, rules, &patches, &curves);
    let envelope = Envelope::new(surface, &patches, &curves, &allowance);
    let mut mesh = Mesh::new(
        surface,
        *rules,
        (&patches, &curves),
        (&envelope, &allowance),
    );
    let mut told = Told::default();
    // What a cut leaves of facets is gone first; then there may be nothing else to do.
    let none = vec![false; patches.planes.len()];
    told.collapsed += collapse_all(&mut mesh, &none, [DETAIL, DETAIL], Rows::unknown());
    let is_sized = rules.sizes.are_asked();
    let rows = |mesh: &Mesh<'_>| match is_sized {
        true => Rows::new(mesh),
        false => Rows::unknown(),
    };
    let mut active = sharp(&mesh);
    for (&patch, &label) in patches.of.iter().zip(&surface.labels) {
        let is_curved = mesh.planes[patch as usize].is_none();
        active[patch as usize] |= is_curved && rules.sizes.are_asked_at(label);
    }
    told.flipped += flip_all(&mut mesh, &active);
    for round in 0..ROUNDS {
        if round + 2 < ROUNDS {
            // Lengths that are asked for may be many halvings away.
            loop {
                let known = rows(&mesh);
                let split = split_all(&mut mesh, &active, known);
                told.split += split;
                if split == 0 || !is_sized {
                    break;
                }
            }
        }
        let known = rows(&mesh);
        told.collapsed += collapse_all(&mut mesh, &active, [SHORT, DETAIL], known);
        told.flipped += flip_all(&mut mesh, &active);
        told.moved += move_all(&mut mesh, &active);
    }
    told.flipped += flip_all(&mut mesh, &active);
    (!told.is_nothing()).then(|| taken(surface, mesh, told))
}

/// Whether each patch is to be remeshed: whether it has facets with sharp corners.
fn sharp(mesh: &Mesh<'_>) -> Vec<bool> {
    let facets = mesh.facets();
    let there = || (0..mesh.triangles.len()).filter(|&t| mesh.is_there(t as u32));
    let mut angles: FxHashMap<(u32, u32), f64> = FxHashMap::default();
    for t in there() {
        let corners = mesh.triangles[t];
        let points = corners.map(|v| mesh.points[v as usize]);
        for i in 0..3 {
            let [p, q, r] = [0, 1, 2].map(|k| points[(i + k) % 3]);
            *angles.entry((facets[t], corners[i])).or_default() += (q - p).angle_between(r - p);
        }
    }
    let mut active = vec![false; mesh.planes.len()];
    for t in there() {
        let patch = mesh.patch[t] as usize;
        let is_sharp = |v: u32| angles[&(facets[t], v)].to_degrees() < SHARP;
        active[patch] |=
            mesh.planes[patch].is_none() && mesh.triangles[t].into_iter().any(is_sharp);
    }
    active
}

/// Whether an edge is in or beside a patch that is remeshed.
fn is_active(mesh: &Mesh<'_>, active: &[bool], [a, b]: [u32; 2]) -> bool {
    let at_edge = mesh.at_edge(a, b);
    at_edge
        .iter()
        .any(|&t| active[mesh.patch[t as usize] as usize])
}

/// Edges by what `wanted` makes of them, least first.
fn ordered(mesh: &Mesh<'_>, wanted: impl Fn([u32; 2]) -> Option<f64>) -> Vec<[u32; 2]> {
    let edges = mesh.edges().into_iter();
    let mut found: Vec<(f64, [u32; 2])> = edges.filter_map(|e| Some((wanted(e)?, e))).collect();
    found.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    found.into_iter().map(|f| f.1).collect()
}

fn collapse_all(
    mesh: &mut Mesh<'_>,
    active: &[bool],
    [short, detail]: [f64; 2],
    mut rows: Rows,
) -> usize {
    let is_short = |mesh: &Mesh<'_>, rows: &Rows, [a, b]: [u32; 2]| {
        let (limit, relative) = match is_active(mesh, active, [a, b]) {
            true => (short, mesh.relative([a, b])),
            false => (detail, mesh.relative_to_drawn([a, b])),
        };
        let curve = mesh.curve(a, b).filter(|_| relative < 1.0);
        let spare = curve.is_some_and(|curve| rows.has_too_many(curve));
        (spare || relative < limit).then_some((relative, spare))
    };
    let edges = ordered(mesh, |e| Some(is_short(mesh, &rows, e)?.0));
    let mut done = 0;
    for [a, b] in edges {
        if mesh.at_edge(a, b).is_empty() {
            continue;
        }
        let Some((_, spare)) = is_short(mesh, &rows, [a, b]) else {
            continue;
        };
        let curve = mesh.curve(a, b);
        if collapse(mesh, [a, b], spare) || collapse(mesh, [b, a], spare) {
            done += 1;
            curve.iter().for_each(|&curve| rows.change(curve, -1.0));
        }
    }
    done
}

fn split_all(mesh: &mut Mesh<'_>, active: &[bool], mut rows: Rows) -> usize {
    // Of a curve that has enough edges, those are moved that are not twice as long as they should be.
    let is_long = |mesh: &Mesh<'_>, rows: &Rows, [a, b]: [u32; 2], relative: f64| {
        let enough = mesh.curve(a, b).is_some_and(|curve| rows.has_enough(curve));
        relative > if enough { 2.0 } else { LONG }
    };
    let edges = ordered(mesh, |e| {
        let relative = mesh.relative(e);
        (is_long(mesh, &rows, e, relative) && is_active(mesh, active, e)).then_some(-relative)
    });
    let mut done = 0;
    for [a, b] in edges {
        if mesh.at_edge(a, b).is_empty() || !is_long(mesh, &rows, [a, b], mesh.relative([a, b])) {
            continue;
        }
        let curve = mesh.curve(a, b);
        if split(mesh, [a, b]) {
            done += 1;
            curve.iter().for_each(|&curve| rows.change(curve, 1.0));
        }
    }
    done
}

fn flip_all(mesh: &mut Mesh<'_>, active: &[bool]) -> usize {
    let mut done = 0;
    let edges = ordered(mesh, |[a, b]| {
        let at_edge = mesh.at_edge(a, b);
        let inner = mesh.curve(a, b).is_none();
        (inner && is_active(mesh, active, [a, b])).then(|| mesh.worst(&at_edge))
    });
    for edge in edges {
        done += usize::from(flip(mesh, edge));
    }
    done
}

fn move_all(mesh: &mut Mesh<'_>, active: &[bool]) -> usize {
    let mut done = 0;
    for v in 0..mesh.points.len() as u32 {
        let around = mesh.around(v).iter();
        let wanted = around
            .clone()
            .any(|&t| active[mesh.patch[t as usize] as usize]);
        done += usize::from(wanted && relocate(mesh, v));
    }
    done
}

/// The surface that is left, numbered anew.
fn taken(surface: &Surface, mesh: Mesh<'_>, told: Told) -> Remeshed {
    let mut vertices = vec![NONE; mesh.points.len()];
    let mut remeshed = Remeshed {
        told,
        triangles: vec![NONE; surface.triangles.len()],
        ..Remeshed::default()
    };
    for (v, new) in vertices.iter_mut().enumerate() {
        if !mesh.around(v as u32).is_empty() {
            *new = remeshed.surface.points.len() as u32;
            remeshed.surface.points.push(mesh.points[v]);
            remeshed.bound.push(mesh.bound[v]);
        }
    }
    // All triangles of a patch have one label.
    let mut label_of: FxHashMap<u32, u32> = FxHashMap::default();
    for (t, label) in surface.labels.iter().enumerate() {
        label_of.insert(mesh.patch[t], *label);
    }
    for t in 0..mesh.triangles.len() {
        if mesh.is_there(t as u32) {
            if let Some(new) = remeshed.triangles.get_mut(t) {
                *new = remeshed.surface.triangles.len() as u32;
            }
            let corners = mesh.triangles[t].map(|v| vertices[v as usize]);
            remeshed.surface.triangles.push(corners);
            remeshed.surface.labels.push(label_of[&mesh.patch[t]]);
        }
    }
    remeshed.links = (0..mesh.rules.links.len())
        .map(|link| {
            let pairs = mesh.images.pairs(link).into_iter();
            pairs.map(|p| p.map(|v| vertices[v as usize])).collect()
        })
        .collect();
    vertices.truncate(surface.points.len());
    remeshed.vertices = vertices;
    remeshed
}
