//! Joining vertices of a surface that were moved to the same place.

use super::remeshed::{Remeshed, Told};
use crate::input::{Place, Rules, Surface};
use crate::mesh::NONE;
use crate::shape::Patches;
use geom::edges::Edges;
use geom::measure::double_area_vector;
use geom::sets::DisjointSets;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// How far a vertex may be from where an isometry takes the one that it is the image of, over the largest coordinate of all: what rounding makes of
/// several isometries one after the other.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Vertices around which something is wrong.
pub type Around = Vec<u32>;

/// Moves the vertices of a surface, joins those along edges that have no length then, and takes out triangles that have no area. The topology
/// stays, as do labels, what is held, and what is linked. n log n.
///
/// # Errors
/// Vertices around which it cannot be done.
pub fn contracted(
    surface: &Surface,
    rules: &Rules<'_>,
    patches: &Patches,
    places: &[DVec3],
) -> Result<Remeshed, Around> {
    let mut contraction = Contraction {
        rules,
        places: places.to_vec(),
        is_moved: (surface.points.iter().zip(places))
            .map(|(old, new)| old != new)
            .collect(),
        of: (0..surface.points.len() as u32).collect(),
        triangles: surface.triangles.iter().copied().map(Some).collect(),
        labels: surface.labels.clone(),
    };
    contraction.join(&patches.edges)?;
    contraction.align_images();
    contraction.keep_links()?;
    contraction.drop_flat()?;
    contraction.keep_topology(surface, &patches.edges)?;
    contraction.keep_sides(surface, patches)?;
    Ok(contraction.taken(surface))
}

/// A surface of which vertices are joined.
struct Contraction<'a> {
    rules: &'a Rules<'a>,
    places: Vec<DVec3>,
    is_moved: Vec<bool>,
    /// The vertex that each one became.
    of: Vec<u32>,
    /// What is left of each triangle, and then those that are new.
    triangles: Vec<Option<[u32; 3]>>,
    labels: Vec<u32>,
}

impl Contraction<'_> {
    fn length(&self, [a, b]: [u32; 2]) -> f64 {
        self.places[a as usize].distance(self.places[b as usize])
    }

    /// Joins the ends of edges without a length.
    fn join(&mut self, edges: &Edges) -> Result<(), Around> {
        let mut sets = DisjointSets::new(self.places.len());
        let mut joined: FxHashSet<u32> = FxHashSet::default();
        for &[a, b] in &edges.ends {
            let moves = self.is_moved[a as usize] || self.is_moved[b as usize];
            if moves && self.length([a, b]) <= self.rules.flat && sets.join(a, b) {
                joined.extend([a, b]);
            }
        }
        let mut joined: Vec<u32> = joined.into_iter().collect();
        joined.sort_unstable();
        let mut members: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for &v in &joined {
            members.entry(sets.find(v)).or_default().push(v);
        }
        let mut wrong = Vec::new();
        for v in joined {
            let Some(all) = members.remove(&sets.find(v)) else {
                continue;
            };
            let bound = |v: u32| self.rules.bound[v as usize];
            let held = |v: u32| self.rules.held[v as usize];
            let every = all.iter().fold(0, |bits, &v| bits | bound(v));
            // What stays as it is before what is only where the others are.
            let first = all.iter().filter(|&&v| bound(v) == every);
            let first = first.min_by_key(|&&v| (!held(v), self.is_moved[v as usize], v));
            let keeps_held = |first: u32| all.iter().all(|&v| v == first || !held(v));
            match first {
                Some(&first) if keeps_held(first) => {
                    all.iter().for_each(|&v| self.of[v as usize] = first);
                }
                _ => wrong.extend(all),
            }
        }
        for t in &mut self.triangles {
            let [a, b, c] = t.unwrap_or_default().map(|v| self.of[v as usize]);
            *t = (a != b && b != c && c != a).then_some([a, b, c]);
        }
        none(wrong)
    }

    /// Puts what was moved exactly where its images say, of which those that were not moved stay but for rounding.
    fn align_images(&mut self) {
        self.align_to_kept();
        self.align_forth();
    }

    /// Puts what was moved where the images of what was not moved say, there or back, or those of the first that was.
    fn align_to_kept(&mut self) {
        let mut beside: BTreeMap<u32, Vec<(u32, &Place)>> = BTreeMap::new();
        for link in self.rules.links {
            for pair in &link.pairs {
                let [v, w] = pair.map(|v| self.of[v as usize]);
                beside.entry(v).or_default().push((w, &link.image));
                beside.entry(w).or_default().push((v, &link.back));
            }
        }
        let mut is_put: Vec<bool> = self.is_moved.iter().map(|moved| !moved).collect();
        let put = beside.keys().copied().filter(|&v| is_put[v as usize]);
        let mut open: Vec<u32> = put.collect();
        for &first in beside.keys() {
            if open.is_empty() && !is_put[first as usize] {
                is_put[first as usize] = true;
                open.push(first);
            }
            while let Some(v) = open.pop() {
                for (w, place) in &beside[&v] {
                    if !is_put[*w as usize] {
                        is_put[*w as usize] = true;
                        self.places[*w as usize] = place(self.places[v as usize]);
                        open.push(*w);
                    }
                }
            }
        }
    }

    /// Puts images of what was moved, and what was moved if it is one, where links say to the bit: an image of what goes back
    /// need not be where it was.
    fn align_forth(&mut self) {
        let mut forth: BTreeMap<u32, Vec<(u32, &Place)>> = BTreeMap::new();
        let mut is_image = vec![false; self.places.len()];
        for link in self.rules.links {
            for pair in &link.pairs {
                let [v, w] = pair.map(|v| self.of[v as usize]);
                if v != w {
                    forth.entry(v).or_default().push((w, &link.image));
                    is_image[w as usize] = true;
                }
            }
        }
        let firsts = forth.keys().filter(|&&v| !is_image[v as usize]);
        let mut open: Vec<u32> = firsts.copied().collect();
        let mut is_put = vec![false; self.places.len()];
        let mut moves = self.is_moved.clone();
        while let Some(v) = open.pop() {
            for (w, place) in forth.get(&v).into_iter().flatten() {
                let [from, to] = [v, *w].map(|v| v as usize);
                if std::mem::replace(&mut is_put[to], true) {
                    continue;
                }
                if moves[from] || moves[to] {
                    moves[to] = true;
                    self.places[to] = place(self.places[from]);
                }
                open.push(*w);
            }
        }
    }

    /// Whether every vertex still has one image by each link, and is one of one, where it was moved to.
    fn keep_links(&self) -> Result<(), Around> {
        let mut wrong = Vec::new();
        let each = self.places.iter().map(|p| p.abs().max_element());
        let size = each.fold(0.0, f64::max);
        for link in self.rules.links {
            let mut maps = [FxHashMap::default(), FxHashMap::default()];
            for pair in &link.pairs {
                let [v, w] = pair.map(|v| self.of[v as usize]);
                let moves = pair.iter().any(|&v| self.is_moved[v as usize]);
                let image = (link.image)(self.places[v as usize]);
                let off = image.distance(self.places[w as usize]);
                let is_there = !moves || off <= ROUNDING * size;
                let is_one =
                    *maps[0].entry(v).or_insert(w) == w && *maps[1].entry(w).or_insert(v) == v;
                if !is_there || !is_one {
                    wrong.extend(pair);
                }
            }
        }
        none(wrong)
    }

    /// Takes out triangles without an area: their longest side is divided in the triangles beyond it.
    fn drop_flat(&mut self) -> Result<(), Around> {
        let all = 0..self.triangles.len();
        let mut flat: Vec<usize> = all.filter(|&t| self.is_flat(t)).collect();
        if flat.is_empty() {
            return Ok(());
        }
        let mut at: FxHashMap<[u32; 2], Vec<usize>> = FxHashMap::default();
        for (t, corners) in self.triangles.iter().enumerate() {
            for key in corners.iter().flat_map(sides) {
                at.entry(key).or_default().push(t);
            }
        }
        let links = self.rules.links.iter();
        let linked: FxHashSet<u32> = links.flat_map(|link| &link.labels).copied().collect();
        // Each round divides beside what is not flat, from the outside of what is.
        while !flat.is_empty() {
            let before = flat.len();
            let mut left = Vec::new();
            for t in flat {
                let Some(corners) = self.triangles[t] else {
                    continue;
                };
                let [a, b, middle] = self.longest_first(corners);
                let mut beyond = at.get(&key(a, b)).cloned().unwrap_or_default();
                beyond.retain(|&u| u != t);
                if beyond.iter().any(|&u| self.is_flat(u)) {
                    left.push(t);
                    continue;
                }
                let all = beyond.iter().chain([&t]);
                let is_linked = all.clone().any(|&t| linked.contains(&self.labels[t]));
                let mut apexes = beyond.iter().filter_map(|&u| self.triangles[u]).flatten();
                if beyond.is_empty() || is_linked || apexes.any(|v| v == middle) {
                    return Err(corners.to_vec());
                }
                let divided = beyond
                    .iter()
                    .filter_map(|&u| Some((self.triangles[u]?, self.labels[u])));
                let divided: Vec<([u32; 3], u32)> = divided.collect();
                for &gone in all {
                    for key in self.triangles[gone].take().iter().flat_map(sides) {
                        at.entry(key).or_default().retain(|&t| t != gone);
                    }
                }
                for (corners, label) in divided {
                    for end in [a, b] {
                        let half = corners.map(|v| if v == end { middle } else { v });
                        for key in sides(&half) {
                            at.entry(key).or_default().push(self.triangles.len());
                        }
                        self.triangles.push(Some(half));
                        self.labels.push(label);
                    }
                }
            }
            if left.len() == before {
                let corners = left.iter().filter_map(|&t| self.triangles[t]);
                return Err(corners.flatten().collect());
            }
            flat = left;
        }
        Ok(())
    }

    /// Whether a triangle at a vertex that was moved has no area.
    fn is_flat(&self, t: usize) -> bool {
        self.triangles[t].is_some_and(|corners| {
            let [a, b, c] = self.longest_first(corners);
            let [p, q, r] = [a, b, c].map(|v| self.places[v as usize]);
            let moves = corners.iter().any(|&v| self.is_moved[v as usize]);
            moves && double_area_vector(p, q, r).length() <= self.rules.flat * p.distance(q)
        })
    }

    /// The corners of a triangle, the ends of its longest side first.
    fn longest_first(&self, corners: [u32; 3]) -> [u32; 3] {
        let turned = [0, 1, 2].map(|i| [0, 1, 2].map(|k| corners[(i + k) % 3]));
        let length = |[a, b, _]: &[u32; 3]| self.length([*a, *b]);
        let [first, second, third] = turned;
        let longer = |x: [u32; 3], y: [u32; 3]| if length(&y) > length(&x) { y } else { x };
        longer(longer(first, second), third)
    }

    /// Whether the surface is still what it was: its Euler characteristic, how many triangles there are at each edge, that no two have the same
    /// corners, and that no label is gone.
    fn keep_topology(&self, surface: &Surface, edges: &Edges) -> Result<(), Around> {
        let there: Vec<[u32; 3]> = self.triangles.iter().flatten().copied().collect();
        let labels = self.triangles.iter().zip(&self.labels);
        let labels = labels.filter_map(|(t, label)| t.map(|_| *label));
        let labels: FxHashSet<u32> = labels.collect();
        let mut wrong = Vec::new();
        for (corners, label) in surface.triangles.iter().zip(&surface.labels) {
            if !labels.contains(label) {
                wrong.extend(corners);
            }
        }
        let mut before: FxHashMap<[u32; 2], usize> = FxHashMap::default();
        for (edge, ends) in edges.ends.iter().enumerate() {
            let [a, b] = ends.map(|v| self.of[v as usize]);
            let most = before.entry(key(a, b)).or_default();
            *most = edges.around(edge).len().max(*most);
        }
        let now = Edges::new(&there);
        for (edge, &ends) in now.ends.iter().enumerate() {
            let (count, old) = (now.around(edge).len(), before.get(&ends).copied());
            if count > old.unwrap_or(0).max(2) || count < old.unwrap_or(2).min(2) {
                wrong.extend(ends);
            }
        }
        let mut corners: Vec<[u32; 3]> = there.clone();
        corners.iter_mut().for_each(|t| t.sort_unstable());
        corners.sort_unstable();
        let twins = corners.windows(2).filter(|pair| pair[0] == pair[1]);
        wrong.extend(twins.flat_map(|pair| pair[0]));
        none(wrong)?;
        let euler = |triangles: &[[u32; 3]], edges: &Edges| {
            let mut vertices: Vec<u32> = triangles.iter().flatten().copied().collect();
            vertices.sort_unstable();
            vertices.dedup();
            (vertices.len() + triangles.len()) as i64 - edges.len() as i64
        };
        match euler(&there, &now) == euler(&surface.triangles, edges) {
            true => Ok(()),
            false => {
                let moved = (0..).zip(&self.is_moved).filter(|m| *m.1);
                Err(moved.map(|m| m.0).collect())
            }
        }
    }

    /// Whether triangles of faces that are as wide as before still face the same side.
    fn keep_sides(&self, surface: &Surface, patches: &Patches) -> Result<(), Around> {
        let mut wrong = Vec::new();
        let all = self.triangles.iter().zip(&surface.triangles).enumerate();
        for (t, (now, before)) in all {
            let (Some(now), true) = (now, before.iter().any(|&v| self.is_moved[v as usize])) else {
                continue;
            };
            let [a, b, c] = now.map(|v| self.places[v as usize]);
            if double_area_vector(a, b, c).dot(patches.normals[t]) < 0.0 {
                wrong.extend(before);
            }
        }
        none(wrong)
    }

    /// The surface that is left, numbered anew.
    fn taken(&self, surface: &Surface) -> Remeshed {
        let mut number = vec![NONE; self.places.len()];
        let mut remeshed = Remeshed {
            triangles: vec![NONE; surface.triangles.len()],
            ..Remeshed::default()
        };
        let mut is_used = vec![false; self.places.len()];
        let corners = self.triangles.iter().flatten().flatten();
        corners.for_each(|&v| is_used[v as usize] = true);
        for v in (0..self.places.len()).filter(|&v| is_used[v]) {
            number[v] = remeshed.surface.points.len() as u32;
            remeshed.surface.points.push(self.places[v]);
            remeshed.bound.push(self.rules.bound[v]);
        }
        for (t, (corners, &label)) in self.triangles.iter().zip(&self.labels).enumerate() {
            let Some(corners) = corners else {
                continue;
            };
            let moves = corners.iter().any(|&v| self.is_moved[v as usize]);
            let is_as_before = !moves && surface.triangles.get(t) == Some(corners);
            if is_as_before {
                remeshed.triangles[t] = remeshed.surface.triangles.len() as u32;
            }
            let new = corners.map(|v| number[v as usize]);
            remeshed.surface.triangles.push(new);
            remeshed.surface.labels.push(label);
            remeshed.patches.push(NONE);
            remeshed.samples.push(Vec::new());
        }
        let left = |v: u32| number[self.of[v as usize] as usize];
        let pairs = |link: &crate::input::Link| {
            let mut pairs: Vec<[u32; 2]> = link.pairs.iter().map(|pair| pair.map(left)).collect();
            pairs.sort_unstable();
            pairs.dedup();
            pairs
        };
        remeshed.links = self.rules.links.iter().map(pairs).collect();
        remeshed.vertices = (0..self.places.len() as u32).map(left).collect();
        remeshed.told = Told {
            collapsed: (0..).zip(&self.of).filter(|(v, of)| v != *of).count(),
            ..Told::default()
        };
        remeshed
    }
}

/// Whether there are none around which something is wrong.
fn none(wrong: Around) -> Result<(), Around> {
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(wrong),
    }
}

/// The sides of a triangle, lower vertex first.
fn sides([a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [key(*a, *b), key(*b, *c), key(*c, *a)]
}

/// An edge, lower vertex first.
fn key(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
