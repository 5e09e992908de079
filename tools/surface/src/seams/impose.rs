//! Giving a template the refined face that another template shares with it.
//!
//! The face was refined where the other template was meshed. Each of its images replaces the triangles
//! that the template had there; triangles beside it are divided where its outline is.

use super::pairing::facing;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{Document, FixedSet, Gluing, Placed, RegionMap, Template, Triangle};

/// What a template that shares its face has become.
pub struct Other<'a> {
    /// The template as it is now.
    pub template: &'a Template,
    /// Its new vertex for each old one, `u32::MAX` for those that are gone.
    pub vertices: &'a [u32],
    /// Its triangles on the shared face.
    pub triangles: &'a [u32],
}

/// Replaces the faces that template `index` shares with `other`, its hub walls, by those that `other`
/// has now. The second members of the walls' pairs become the new numbers.
///
/// # Errors
/// A sentence about the place where the faces do not fit, which is an inconsistency.
pub fn impose(document: &Document, index: usize, other: &Other<'_>) -> Result<Template, String> {
    let template = &document.templates[index];
    let mut old = vec![false; other.template.vertices.len()];
    let kept = other.vertices.iter().filter(|&&v| v != u32::MAX);
    kept.for_each(|&v| old[v as usize] = true);
    let chains = chains(other, &old)?;
    let mut maker = Maker {
        new: Template {
            vertices: template.vertices.clone(),
            axis: template.axis.clone(),
            ..Template::default()
        },
        edges: FxHashMap::default(),
    };
    let mut on_wall = vec![false; template.triangles.len()];
    let mut gluings = template.gluings.clone();
    for gluing in gluings.iter_mut().filter(|g| g.other_than(index).is_some()) {
        for t in gluing.triangles_here() {
            on_wall[t as usize] = true;
        }
        let instance = document
            .instances
            .iter()
            .find(|i| i.template == gluing.other && i.isometry == gluing.step);
        let map = instance
            .and_then(|i| i.region_map.checked_sub(1))
            .and_then(|map| document.region_maps.get(map as usize));
        maker.image(gluing, other, &chains, map)?;
    }
    let high: FxHashSet<u32> = gluings
        .iter()
        .filter(|g| g.is_seam(index))
        .flat_map(Gluing::triangles_here)
        .collect();
    // The seam's faces come last: its high face is the image of what became of the low one.
    let mut pieces: Vec<Vec<u32>> = vec![Vec::new(); template.triangles.len()];
    for (t, triangle) in template.triangles.iter().enumerate() {
        if !on_wall[t] && !high.contains(&(t as u32)) {
            pieces[t] = maker.divide(*triangle);
        }
    }
    for gluing in &mut gluings {
        if gluing.is_mirror(index) {
            let triangles = gluing.triangles_here();
            let mut triangles: Vec<u32> =
                triangles.flat_map(|t| pieces[t as usize].clone()).collect();
            triangles.sort_unstable();
            gluing.triangle_pairs = triangles.into_iter().map(|t| [t, t]).collect();
            let projection = FixedSet::of(gluing.step);
            let old: Vec<u32> = gluing.vertices_here().collect();
            let added = maker.added_between(&old);
            for &v in &added {
                let p = &mut maker.new.vertices[v as usize];
                *p = projection.nearest(*p);
            }
            gluing
                .vertex_pairs
                .extend(added.into_iter().map(|v| [v, v]));
            gluing.vertex_pairs.sort_unstable();
        } else if gluing.is_seam(index) {
            maker.seam(gluing, template, &pieces)?;
        }
    }
    maker.new.gluings = gluings;
    Ok(maker.new)
}

/// Vertices along each divided edge of the outline of the other template's face, between vertices
/// that it had before, by these (lower one first).
type Chains = FxHashMap<[u32; 2], Vec<u32>>;

fn chains(other: &Other<'_>, old: &[bool]) -> Result<Chains, String> {
    // An edge inside of one facet has two triangles of the same kind.
    let mut uses: FxHashMap<[u32; 2], Vec<(u32, u32)>> = FxHashMap::default();
    let mut order = Vec::new();
    for &t in other.triangles {
        let t = &other.template.triangles[t as usize];
        let [a, b, c] = t.vertices;
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let key = [p.min(q), p.max(q)];
            let list = uses.entry(key).or_default();
            if list.is_empty() {
                order.push(key);
            }
            list.push((t.front, t.back));
        }
    }
    let mut next: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    let mut starts = Vec::new();
    for [a, b] in order {
        if !matches!(uses[&[a, b]].as_slice(), [x, y] if x == y) {
            for (p, q) in [(a, b), (b, a)] {
                let list = next.entry(p).or_default();
                if list.is_empty() && old[p as usize] {
                    starts.push(p);
                }
                list.push(q);
            }
        }
    }
    let mut chains = Chains::default();
    for start in starts {
        for &first in &next[&start] {
            let (mut before, mut here) = (start, first);
            let mut walked = Vec::new();
            while !old[here as usize] {
                walked.push(here);
                let onward = match next[&here].as_slice() {
                    [a, b] if *a == before => *b,
                    [a, b] if *b == before => *a,
                    _ => {
                        let p = other.template.vertices[here as usize];
                        return Err(format!("the shared face's outline forks near {p}"));
                    }
                };
                (before, here) = (here, onward);
            }
            if start < here && !walked.is_empty() {
                chains.insert([start, here], walked);
            }
        }
    }
    Ok(chains)
}

struct Maker {
    new: Template,
    /// New vertices along divided edges of the template, by its own ends, lower one first.
    edges: Chains,
}

impl Maker {
    fn add(&mut self, placed: &Placed, p: DVec3) -> u32 {
        self.new.vertices.push(placed.apply(p) + DVec3::ZERO);
        self.new.vertices.len() as u32 - 1
    }

    /// Adds the face as one of the hub walls has it.
    fn image(
        &mut self,
        hub: &mut Gluing,
        other: &Other<'_>,
        chains: &Chains,
        regions: Option<&RegionMap>,
    ) -> Result<(), String> {
        let placed = hub.step.placed();
        let mut here: FxHashMap<u32, u32> = FxHashMap::default();
        for pair in &hub.vertex_pairs {
            let there = other.vertices[pair[1] as usize];
            if there != u32::MAX {
                here.insert(there, pair[0]);
            }
        }
        let mut outline: Vec<_> = chains.iter().collect();
        outline.sort_unstable();
        for ([a, b], chain) in outline {
            let (Some(&p), Some(&q)) = (here.get(a), here.get(b)) else {
                let p = other.template.vertices[*a as usize];
                return Err(format!(
                    "the shared face has a corner without partner near {p}"
                ));
            };
            let key = [p.min(q), p.max(q)];
            if !self.edges.contains_key(&key) {
                let mut made: Vec<u32> = chain
                    .iter()
                    .map(|&v| self.add(&placed, other.template.vertices[v as usize]))
                    .collect();
                if p > q {
                    made.reverse();
                }
                self.edges.insert(key, made);
            }
            let made = &self.edges[&key];
            if made.len() != chain.len() {
                let p = other.template.vertices[*a as usize];
                return Err(format!("two images of the shared face differ near {p}"));
            }
            if p < q {
                here.extend(chain.iter().copied().zip(made.iter().copied()));
            } else {
                here.extend(chain.iter().copied().zip(made.iter().rev().copied()));
            }
        }
        hub.triangle_pairs.clear();
        let mut pairs = Vec::new();
        for &t in other.triangles {
            let triangle = other.template.triangles[t as usize];
            let vertices = triangle.vertices.map(|v| match here.get(&v) {
                Some(&known) => known,
                None => {
                    let new = self.add(&placed, other.template.vertices[v as usize]);
                    here.insert(v, new);
                    new
                }
            });
            pairs.extend(
                vertices
                    .into_iter()
                    .zip(triangle.vertices)
                    .map(|(a, b)| [a, b]),
            );
            hub.triangle_pairs
                .push([self.new.triangles.len() as u32, t]);
            let region = |r: u32| regions.map_or(r, |map| map.get(r));
            self.new.triangles.push(Triangle {
                vertices: facing(hub.step, vertices),
                front: region(triangle.front),
                back: region(triangle.back),
                ..triangle
            });
        }
        pairs.sort_unstable();
        pairs.dedup();
        hub.vertex_pairs = pairs;
        Ok(())
    }

    /// Adds a triangle, divided where its edges are; gives the pieces.
    fn divide(&mut self, triangle: Triangle) -> Vec<u32> {
        let mut parts = vec![triangle.vertices];
        let corners = triangle.vertices;
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let Some(chain) = self.edges.get(&[a.min(b), a.max(b)]) else {
                continue;
            };
            // One part has the whole edge: a fan from its opposite corner.
            let found = parts.iter().enumerate().find_map(|(i, part)| {
                let k = (0..3).find(|&k| part[k] == a && part[(k + 1) % 3] == b)?;
                Some((i, part[(k + 2) % 3]))
            });
            let Some((i, apex)) = found else { continue };
            parts.swap_remove(i);
            let mut last = a;
            let mut step = |v: u32| parts.push([std::mem::replace(&mut last, v), v, apex]);
            if a < b {
                chain.iter().for_each(|&v| step(v));
            } else {
                chain.iter().rev().for_each(|&v| step(v));
            }
            step(b);
        }
        let first = self.new.triangles.len() as u32;
        self.new
            .triangles
            .extend(parts.into_iter().map(|vertices| Triangle {
                vertices,
                ..triangle
            }));
        (first..self.new.triangles.len() as u32).collect()
    }

    /// New vertices on edges whose ends are both in an increasing list.
    fn added_between(&self, vertices: &[u32]) -> Vec<u32> {
        let on = |v: &u32| vertices.binary_search(v).is_ok();
        let mut added: Vec<u32> = self
            .edges
            .iter()
            .filter(|([a, b], _)| on(a) && on(b))
            .flat_map(|(_, chain)| chain.iter().copied())
            .collect();
        added.sort_unstable();
        added
    }

    /// Gives the seam its new vertices and triangles.
    fn seam(
        &mut self,
        seam: &mut Gluing,
        template: &Template,
        pieces: &[Vec<u32>],
    ) -> Result<(), String> {
        let placed = seam.step.placed();
        let mut image: FxHashMap<u32, u32> =
            seam.vertex_pairs.iter().map(|p| (p[1], p[0])).collect();
        let mut edges: Vec<[u32; 2]> = self.edges.keys().copied().collect();
        edges.sort_unstable();
        for [a, b] in edges {
            let (Some(&p), Some(&q)) = (image.get(&a), image.get(&b)) else {
                continue;
            };
            let key = [p.min(q), p.max(q)];
            if key == [a, b] {
                continue;
            }
            let (low, high) = (&self.edges[&[a, b]], self.edges.get(&key));
            let Some(high) = high.filter(|h| h.len() == low.len()) else {
                let p = self.new.vertices[a as usize];
                return Err(format!(
                    "the seam has a divided edge without image near {p}"
                ));
            };
            let mut high = high.clone();
            if p > q {
                high.reverse();
            }
            for (&v, w) in low.iter().zip(high) {
                image.insert(v, w);
                // To the bit, whatever image of the face this vertex came with.
                self.new.vertices[w as usize] = placed.apply(self.new.vertices[v as usize]);
                seam.vertex_pairs.push([w, v]);
            }
        }
        seam.vertex_pairs.sort_unstable();
        let mut pairs = Vec::new();
        for &[high, low] in &seam.triangle_pairs {
            let like = template.triangles[high as usize];
            for &piece in &pieces[low as usize] {
                let corners = self.new.triangles[piece as usize].vertices;
                let [Some(&a), Some(&b), Some(&c)] = corners.map(|v| image.get(&v)) else {
                    let p = self.new.vertices[corners[0] as usize];
                    return Err(format!("the seam has a vertex without image near {p}"));
                };
                pairs.push([self.new.triangles.len() as u32, piece]);
                self.new.triangles.push(Triangle {
                    vertices: facing(seam.step, [a, b, c]),
                    ..like
                });
            }
        }
        pairs.sort_unstable();
        seam.triangle_pairs = pairs;
        Ok(())
    }
}
