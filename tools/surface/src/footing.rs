//! What the surface of a template that was remeshed stands on.

use crate::apart::apart;
use crate::seams::same_size;
use glam::DVec3;
use improve::{NO_PATCH, Point, Shape};
use mesher::Plc;
use remesh::{Ground, Sample};
use std::sync::Arc;
use tmesh::Template;

/// Triangles of an uneven facet, at most, all of whose corners are looked at in pairs: folds of a fraction of a degree add up to what can be seen, so
/// that facets of what bends have few.
const LOOKED_AT: usize = 64;

/// The shape behind the surface of a template, in the template's coordinates.
#[derive(Clone)]
pub struct Footing {
    /// The patches of the input, which other templates of the same group have, too.
    pub ground: Arc<Ground>,
    /// Patch of each triangle, `u32::MAX` for those of flat faces.
    pub patches: Vec<u32>,
    /// Of each triangle, whether it is in no uneven facet, in which other triangles would be farther from the input than they may be.
    pub apart: Vec<bool>,
    /// Points of the input that each triangle is near to.
    pub points: Vec<Vec<Point>>,
    /// The template as it was given.
    pub given: Arc<Template>,
    /// How far its surface may be off that by what volumes and areas say, model units, where nobody asked for a surface that is farther off than the
    /// input is off its symmetry.
    pub drift: Option<f64>,
    /// How far its surface may be off that by its envelope, model units, where only the document says so.
    pub deviation: Option<f64>,
}

impl Footing {
    /// Whether what became of template number `index` has the size that it is to have.
    pub fn keeps_size(&self, index: usize, template: &Template) -> bool {
        let given = (&*self.given, index);
        self.drift
            .is_none_or(|drift| same_size(given, template, drift).is_ok())
    }

    /// That of a surface with other triangles, each of which is a part of the given one: the first as many are in the place of those that were
    /// there.
    pub fn with_parts(&self, parents: &[u32]) -> Self {
        let mut points = self.points.clone();
        points.resize(parents.len(), Vec::new());
        Self {
            patches: parents.iter().map(|&t| self.patches[t as usize]).collect(),
            apart: parents.iter().map(|&t| self.apart[t as usize]).collect(),
            points,
            ..self.clone()
        }
    }

    /// That of a surface with other triangles in the same facets: of each triangle that is there, and of each that was, the facet; none for those that
    /// stand for no patch. What a facet is near to, is known to one of its triangles.
    pub fn with_facets(&self, [after, before]: &[Vec<u32>; 2]) -> Self {
        let count = before.iter().max().map_or(0, |&last| last as usize + 1);
        let mut patches: Vec<Option<u32>> = vec![None; count];
        let mut apart = vec![false; count];
        let mut points: Vec<Vec<Point>> = vec![Vec::new(); count];
        for (t, &facet) in before.iter().enumerate() {
            let facet = facet as usize;
            let patch = patches[facet].get_or_insert(self.patches[t]);
            if *patch != self.patches[t] {
                *patch = NO_PATCH;
            }
            apart[facet] |= self.apart[t];
            points[facet].extend_from_slice(&self.points[t]);
        }
        let patch = |f: &u32| patches.get(*f as usize).copied().flatten();
        let mut taken = |f: &u32| points.get_mut(*f as usize).map(std::mem::take);
        Self {
            patches: after.iter().map(|f| patch(f).unwrap_or(NO_PATCH)).collect(),
            apart: after
                .iter()
                .map(|f| apart.get(*f as usize) == Some(&true))
                .collect(),
            points: after.iter().map(|f| taken(f).unwrap_or_default()).collect(),
            ..self.clone()
        }
    }

    /// Notes which triangles of the template, as the mesher has it, are in uneven facets that might leave the envelope of the shape that they stand
    /// for: the mesher puts triangles of its own between the corners of a facet, and with them edges from any corner to any other one. What is flat
    /// is not farther from the input's than that is uneven.
    pub fn tell_apart(&mut self, plc: &Plc, template: &Template) {
        let uneven = plc.relief.uneven();
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); uneven.len()];
        for (t, &facet) in (0..).zip(&plc.facets.of_triangle) {
            if uneven[facet as usize] {
                members[facet as usize].push(t);
            }
        }
        for members in members {
            let is_flat = |t: &u32| self.patches[*t as usize] == NO_PATCH;
            if !members.iter().all(is_flat) && !self.holds_all(&members, template) {
                for t in members {
                    self.apart[t as usize] = true;
                }
            }
        }
    }

    /// Whether all edges that there can be between the corners of some triangles are near enough to the one patch that these stand for.
    fn holds_all(&self, triangles: &[u32], template: &Template) -> bool {
        let patch = self.patches[triangles[0] as usize];
        if triangles.iter().any(|&t| self.patches[t as usize] != patch)
            || triangles.len() > LOOKED_AT
        {
            return false;
        }
        let ids = triangles
            .iter()
            .flat_map(|&t| template.triangles[t as usize].vertices);
        let mut ids: Vec<u32> = ids.collect();
        ids.sort_unstable();
        ids.dedup();
        let at = |v: &u32| template.vertices[*v as usize];
        ids.iter().enumerate().all(|(i, v)| {
            let mut others = ids[..i].iter();
            others.all(|w| self.ground.spans(patch, [at(v), at(w)]))
        })
    }

    /// How far a surface is from the given one, measured at some places, and by how much it may be farther than the remeshed one is: what is
    /// measured, and what the envelope leaves. Model units. n log n.
    pub fn farther(&self, surface: &Template, remeshed: &Template) -> [f64; 2] {
        let [there, here] = [surface, remeshed].map(|other| apart(&self.given, other));
        let most = there.max(self.deviation.unwrap_or(0.0));
        [there, (most - here).max(0.0)]
    }

    /// Whether nobody said how far the surface may be.
    pub fn is_noted(&self) -> bool {
        self.deviation.is_some()
    }

    /// The shape for positions that are the template's times a power of two.
    pub fn shape(&self, scale: f64) -> Arc<dyn Shape> {
        let ground = self.ground.clone();
        Arc::new(Scaled { ground, scale })
    }
}

/// A point of the input, as who improves elements takes it.
pub fn point(sample: &Sample) -> Point {
    Point {
        at: sample.point,
        reach: sample.reach,
    }
}

/// The same in other units.
struct Scaled {
    ground: Arc<Ground>,
    scale: f64,
}

impl Shape for Scaled {
    fn nearest(&self, patch: u32, p: DVec3) -> Option<(DVec3, DVec3)> {
        let (at, normal) = self.ground.nearest(patch, p / self.scale)?;
        Some((at * self.scale, normal))
    }

    fn holds(&self, patch: u32, corners: [DVec3; 3]) -> bool {
        self.ground.holds(patch, corners.map(|p| p / self.scale))
    }
}
