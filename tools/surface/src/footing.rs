//! What the surface of a template that was remeshed stands on.

use crate::apart::apart;
use crate::seams::same_size;
use glam::DVec3;
use improve::{Point, Shape};
use remesh::{Ground, Sample};
use std::sync::Arc;
use tmesh::Template;

/// The shape behind the surface of a template, in the template's coordinates.
#[derive(Clone)]
pub struct Footing {
    /// The patches of the input, which other templates of the same group have, too.
    pub ground: Arc<Ground>,
    /// Patch of each triangle, `u32::MAX` for those of flat faces.
    pub patches: Vec<u32>,
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
            points,
            ..self.clone()
        }
    }

    /// By how much a surface may be farther from the given one than the remeshed one is, model units: what is measured at some places, and what
    /// the envelope leaves. n log n.
    pub fn farther(&self, surface: &Template, remeshed: &Template) -> f64 {
        let [there, here] = [surface, remeshed].map(|other| apart(&self.given, other));
        (there.max(self.deviation.unwrap_or(0.0)) - here).max(0.0)
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
