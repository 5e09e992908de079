//! What the surface of a template that was remeshed stands on.

use crate::surface::same_size;
use glam::DVec3;
use improve::Shape;
use remesh::Ground;
use std::sync::Arc;
use tmesh::Template;

/// The shape behind the surface of a template, in the template's coordinates.
#[derive(Clone)]
pub struct Footing {
    /// The patches of the input, which other templates of the same group have, too.
    pub ground: Arc<Ground>,
    /// Patch of each triangle, `u32::MAX` for those of flat faces.
    pub patches: Vec<u32>,
    /// What volumes and areas are to stay, where nobody asked for a surface that is farther off than the input is off its symmetry.
    pub size: Option<Size>,
}

/// The template as it was given, and how far its surface may be off it by what its volumes and areas say, model units.
#[derive(Clone)]
pub struct Size {
    /// The template.
    pub of: Arc<Template>,
    /// At most so far, model units.
    pub drift: f64,
}

impl Footing {
    /// Whether what became of template number `index` has the size that it is to have.
    pub fn keeps_size(&self, index: usize, template: &Template) -> bool {
        let kept = |size: &Size| same_size((&size.of, index), template, size.drift).is_ok();
        self.size.as_ref().is_none_or(kept)
    }

    /// The shape for positions that are the template's times a power of two.
    pub fn shape(&self, scale: f64) -> Arc<dyn Shape> {
        let ground = self.ground.clone();
        Arc::new(Scaled { ground, scale })
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
