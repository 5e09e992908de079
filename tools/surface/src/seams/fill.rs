//! Triangulates the facets: those that stay, those that are as in the guide, those whose outline is new, and images.

use super::features::NONE;
use super::maker::Maker;
use super::pairing::facing;
use crate::SurfaceError;
use geom::cdt::{Frame, Patch};
use glam::{DVec2, DVec3};
use mesher::face_key;
use rustc_hash::FxHashMap;
use tmesh::{FixedSet, Triangle};

/// The outline of a facet in the new numbering.
#[derive(Default)]
struct Outline {
    /// Its edges, the facet to the left.
    edges: Vec<[u32; 2]>,
    /// Their vertices, and others inside that stay; increasing.
    fixed: Vec<u32>,
    /// Whether it is not the guide's.
    changed: bool,
}

/// A facet that is the master of a pairing.
#[derive(Clone, Copy)]
struct Master {
    /// Number of the pairing.
    pairing: usize,
    /// A triangle that says what its image is like.
    like: Triangle,
}

impl Maker<'_> {
    /// Triangulates all facets, and the images of masters.
    pub fn fill_facets(&mut self) -> Result<(), SurfaceError> {
        let facets = &self.guide.facets;
        let count = facets.facets.len();
        let mut old: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (t, &f) in facets.of_triangle.iter().enumerate() {
            old[f as usize].push(t as u32);
        }
        let mut fine: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (t, &f) in self.guide.facet.iter().enumerate() {
            fine[f as usize].push(t as u32);
        }
        let (masters, images) = self.masters()?;
        let mut to_turn: Vec<(u32, Master)> = Vec::new();
        for facet in 0..count {
            if images[facet] {
                continue;
            }
            let attributes = facets.facets[facet].attributes;
            let first = self.made.triangles.len() as u32;
            let triangles = if self.frozen[facet] {
                self.frozen_facet(&old[facet], first)
            } else {
                self.facet(facet, &old[facet], &fine[facet], masters[facet])?
            };
            let faces = std::iter::repeat_n(attributes.face, triangles.len());
            self.face_of.extend(faces);
            let same = std::iter::repeat_n(facet as u32, triangles.len());
            self.facet_of.extend(same);
            self.made
                .triangles
                .extend(triangles.into_iter().map(|vertices| Triangle {
                    vertices,
                    marker: attributes.marker,
                    front: attributes.front,
                    back: attributes.back,
                }));
            if let Some(master) = masters[facet] {
                to_turn.extend((first..self.made.triangles.len() as u32).map(|t| (t, master)));
            }
        }
        self.turn(&to_turn);
        Ok(())
    }

    /// Of each facet, what it is the master of, and whether it is an image.
    fn masters(&self) -> Result<(Vec<Option<Master>>, Vec<bool>), SurfaceError> {
        let facets = &self.guide.facets;
        let mut masters: Vec<Option<Master>> = vec![None; facets.facets.len()];
        let mut images = vec![false; facets.facets.len()];
        for (number, pairing) in self.pairings.iter().enumerate() {
            for &[a, b] in &pairing.triangles {
                let like = self.input.triangles[b as usize];
                let kind = |m: &Master| (m.pairing, m.like.marker, m.like.front, m.like.back);
                let master = Master {
                    pairing: number,
                    like,
                };
                let slot = &mut masters[facets.of_triangle[a as usize] as usize];
                if slot.is_some_and(|s| kind(&s) != kind(&master)) {
                    return Err(self.unmatched(self.input.triangles[a as usize].vertices[0]));
                }
                *slot = Some(master);
                images[facets.of_triangle[b as usize] as usize] = true;
            }
        }
        Ok((masters, images))
    }

    /// The triangles of a facet that stays.
    fn frozen_facet(&mut self, old: &[u32], first: u32) -> Vec<[u32; 3]> {
        for (new, &t) in (first..).zip(old) {
            self.of_triangle[t as usize] = new;
        }
        let corners = old
            .iter()
            .map(|&t| self.input.triangles[t as usize].vertices);
        corners
            .map(|t| t.map(|v| self.of_input[v as usize]))
            .collect()
    }

    /// Adds the images of triangles of masters.
    fn turn(&mut self, triangles: &[(u32, Master)]) {
        let mut images: Vec<FxHashMap<u32, u32>> = (self.pairs.iter())
            .map(|pairs| pairs.iter().map(|p| (p[0], p[1])).collect())
            .collect();
        for &(master, Master { pairing, like }) in triangles {
            let corners = self.made.triangles[master as usize].vertices;
            let step = self.pairings[pairing].step.placed();
            let corners = corners.map(|v| {
                *images[pairing].entry(v).or_insert_with(|| {
                    let w = self.made.vertices.len() as u32;
                    let p = self.made.vertices[v as usize];
                    self.made.vertices.push(step.apply(p));
                    self.pairs[pairing].push([v, w]);
                    w
                })
            });
            let image = self.made.triangles.len() as u32;
            self.triangle_pairs[pairing].push([master, image]);
            self.face_of
                .push(face_key(self.pairings[pairing].wall, true));
            self.facet_of.push(u32::MAX);
            self.made.triangles.push(Triangle {
                vertices: facing(self.pairings[pairing].step, corners),
                ..like
            });
        }
    }

    /// Triangles of one facet in the new numbering.
    fn facet(
        &mut self,
        facet: usize,
        old: &[u32],
        fine: &[u32],
        master: Option<Master>,
    ) -> Result<Vec<[u32; 3]>, SurfaceError> {
        let outline = self.outline(old);
        let guide = self.guide;
        let mut inner: Vec<u32> = fine
            .iter()
            .flat_map(|&t| guide.triangles[t as usize])
            .collect();
        inner.sort_unstable();
        inner.dedup();
        inner.retain(|&v| !self.features.on[v as usize] && self.of_guide[v as usize] == NONE);
        let level = self.level(old);
        let attributes = guide.facets.facets[facet].attributes;
        let projection = self.projection(attributes.face, old, master);
        let settle = |p: DVec3| {
            let p = level.map_or(p, |z| DVec3::new(p.x, p.y, z));
            projection.map_or(p, |plane| plane.nearest(p))
        };
        // The guide's points on straight edges are on one line up to rounding only, and so may be all three corners
        // of a triangle.
        let is_flat = |&t: &u32| {
            let [a, b, c] = guide.triangles[t as usize].map(|v| guide.vertices[v as usize]);
            let (u, v) = (b - a, c - a);
            let longest = u.length().max(v.length());
            u.cross(v).length() <= guide.rounding * longest
        };
        if master.is_some() || outline.changed || fine.iter().any(is_flat) {
            let normal = guide.facets.facets[facet].normal;
            return self.triangulate(&Frame::new(normal), &outline, &inner, settle);
        }
        for &v in &inner {
            let new = self.add(settle(guide.vertices[v as usize]));
            self.of_guide[v as usize] = new;
        }
        let corners = fine.iter().map(|&t| guide.triangles[t as usize]);
        Ok(corners
            .map(|t| t.map(|v| self.of_guide[v as usize]))
            .collect())
    }

    /// The new outline of a facet.
    fn outline(&self, old: &[u32]) -> Outline {
        let mut outline = Outline::default();
        for &t in old {
            let corners = self.input.triangles[t as usize].vertices;
            for i in 0..3 {
                let [a, b] = [corners[i], corners[(i + 1) % 3]];
                let new = self.of_input[a as usize];
                if new != NONE {
                    outline.fixed.push(new);
                }
                let Some((edge, reversed)) = self.features.find(a, b) else {
                    continue;
                };
                let chain = &self.chains[edge];
                outline.changed |= chain.changed;
                let mut last = self.of_input[a as usize];
                let mut step = |v: u32| outline.edges.push([std::mem::replace(&mut last, v), v]);
                if reversed {
                    chain.vertices.iter().rev().for_each(|&v| step(v));
                } else {
                    chain.vertices.iter().for_each(|&v| step(v));
                }
                step(self.of_input[b as usize]);
                outline.fixed.extend(&chain.vertices);
            }
        }
        outline.fixed.sort_unstable();
        outline.fixed.dedup();
        outline
    }

    /// Triangulates a facet anew, with some of the guide's vertices inside. `settle` puts new points exactly where they
    /// belong.
    fn triangulate(
        &mut self,
        plane: &Frame,
        outline: &Outline,
        inner: &[u32],
        settle: impl Fn(DVec3) -> DVec3,
    ) -> Result<Vec<[u32; 3]>, SurfaceError> {
        let guide = self.guide;
        let mut local: FxHashMap<u32, u32> = FxHashMap::default();
        let mut points: Vec<DVec2> = Vec::with_capacity(outline.fixed.len() + inner.len());
        for &v in &outline.fixed {
            local.insert(v, points.len() as u32);
            points.push(plane.project(self.made.vertices[v as usize]));
        }
        let offset = points.len();
        let given = inner.iter().map(|&v| guide.vertices[v as usize]);
        points.extend(given.map(|p| plane.project(p)));
        let heights = outline.fixed.iter();
        let height = heights
            .map(|&v| plane.normal.dot(self.made.vertices[v as usize]))
            .sum::<f64>()
            / outline.fixed.len() as f64;
        let mut patch = Patch {
            points,
            fixed: offset,
            outline: (outline.edges.iter())
                .map(|e| e.map(|v| local[&v]))
                .collect(),
            rounding: guide.rounding,
            largest: f64::INFINITY,
        };
        let triangles = patch.triangulate().map_err(|broken| {
            let p = patch.points[broken.0 as usize];
            SurfaceError::Facet {
                template: self.index,
                place: plane.lift(p, height),
            }
        })?;
        let mut number: Vec<u32> = outline.fixed.clone();
        number.resize(patch.points.len(), NONE);
        let mut vertex = |i: u32| {
            let i = i as usize;
            if number[i] == NONE {
                let p = match inner.get(i - offset) {
                    Some(&v) => guide.vertices[v as usize],
                    None => plane.lift(patch.points[i], height),
                };
                number[i] = self.add(settle(p));
            }
            number[i]
        };
        Ok(triangles.into_iter().map(|t| t.map(&mut vertex)).collect())
    }

    /// The plane of a wall's face that points have to be on.
    fn projection(&self, face: u32, old: &[u32], master: Option<Master>) -> Option<FixedSet> {
        if let Some(master) = master {
            let plane = FixedSet::of_master(self.pairings[master.pairing].step);
            let corners = old
                .iter()
                .flat_map(|&t| self.input.triangles[t as usize].vertices);
            let points = corners.map(|v| self.input.vertices[v as usize]);
            let near = |p: DVec3| (plane.nearest(p) - p).length() <= self.guide.rounding;
            return points.clone().all(near).then_some(plane);
        }
        let wall = (face.checked_sub(1)? / 2) as usize;
        let gluing = self.input.gluings.get(wall)?;
        (gluing.is_mirror(self.index)).then(|| FixedSet::of(gluing.step))
    }

    /// Height of a facet that is exactly horizontal.
    fn level(&self, old: &[u32]) -> Option<f64> {
        let mut heights = old
            .iter()
            .flat_map(|&t| self.input.triangles[t as usize].vertices)
            .map(|v| self.input.vertices[v as usize].z);
        let z = heights.next()?;
        heights.all(|other| other == z).then_some(z)
    }
}
