//! Whether a group that holds within what facets hide is that of the body.

use crate::budget::QUICK;
use crate::group::found::Found;
use crate::rotation::Query;
use crate::shape::{Motion, Target};
use crate::verify::golden_turns;
use glam::DMat3;

impl Query<'_> {
    /// Whether facets hide anything.
    pub fn facets_hide_something(&self) -> bool {
        self.shape.smooth().largest() > self.shape.precision
    }

    /// Whether the group of the shape behind the facets of a drawing is more than that of the drawing, and meant.
    ///
    /// It is more if it has all operations of the drawing's. A drawing that has a rotation, of a body that any rotation
    /// takes to itself within its facets, is drawn as it was meant.
    pub fn is_behind(&self, found: &Found, drawn: Option<&Found>) -> bool {
        let is_more = drawn.is_none_or(|drawn| {
            let [a, b] = [found, drawn].map(|f| f.frame.rotation.z_axis);
            let has_all = !self.same_axis(a, b) || drawn.group.is_subgroup_of(found.group);
            let is_round = found.axisymmetric && drawn.group.order > 1;
            found.group.size() > drawn.group.size() && has_all && !is_round
        });
        is_more && self.is_meant(found)
    }

    /// Whether the drawing differs from a group because it was drawn with other facets: then the shape behind them
    /// explains most of how far images are beyond the tolerance (half of the sum of squares or more, a coefficient of
    /// determination). Of a feature that is there once, in a drawing that is the same everywhere else, it explains next
    /// to nothing, however coarse the facets are.
    pub fn is_meant(&self, found: &Found) -> bool {
        let (shape, limit) = (self.shape, self.limits.tolerance * found.radius);
        let matrices: Vec<DMat3> = match found.axisymmetric {
            true => golden_turns(1).collect(),
            false => (found.group.generators().into_iter())
                .map(|g| g.matrix())
                .collect(),
        };
        let within = limit + 2.0 * shape.smooth().largest();
        let beyond = |distance: f64| (distance - limit).max(0.0).powi(2);
        let (mut raw, mut left) = (0.0, 0.0);
        for matrix in matrices {
            let motion = Motion::new(&found.frame, matrix);
            for sample in shape.samples.mixed.iter().take(QUICK) {
                let image = motion.apply(sample.point);
                if let Some(hit) = shape.nearest(image, sample.triangle, &Target::Any, within)
                    && let Some(apart) = shape.apart(sample, &motion, &hit)
                {
                    raw += beyond(apart.facets.abs());
                    left += beyond(apart.gap);
                }
            }
        }
        2.0 * left <= raw
    }
}
