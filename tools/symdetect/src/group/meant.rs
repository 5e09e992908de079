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

    /// Whether the drawing itself has a group, within the tolerance.
    pub fn is_drawn(&self, found: &Found) -> bool {
        found.verified.deviation.value <= self.limits.tolerance * found.radius
    }

    /// Whether a group has the rotation that the drawing itself has about its axis. The features of a body are in its
    /// drawing, with all rotations of them: a drawing of order 7 is not one of order 321, however far facets reach.
    pub fn has_drawn_rotation(&self, found: &Found) -> bool {
        let mut search = self.search(2..=self.params.max_order);
        search.limits.facets = false;
        let drawn = search.find(found.frame.origin, found.frame.rotation.z_axis, false);
        drawn.is_none_or(|own| !own.distinct || found.group.order.is_multiple_of(own.order))
    }

    /// Whether the drawing itself has a group within the tolerance, or differs from it because it was drawn with other
    /// facets: then the shape behind them explains most of how far images are beyond the tolerance (half of the sum of
    /// squares or more, a coefficient of determination). Of a feature that is there once, in a drawing that is the same
    /// everywhere else, it explains next to nothing, however coarse the facets are.
    pub fn is_meant(&self, found: &Found) -> bool {
        if self.is_drawn(found) {
            return true;
        }
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
