//! Axes beside the main one.

use crate::budget::LISTED;
use crate::group::{Found, forward};
use crate::rotation::{Query, Rotation};
use crate::shape::Motion;
use crate::verify::Depth;
use glam::{DMat3, DVec3};
use tmesh::{Isometry, OtherAxis};

impl Query<'_> {
    /// Further axes: half turns across the main one, and those of a polyhedral group.
    pub fn other_axes(&self, found: &Found, rotations: &[Rotation]) -> Vec<OtherAxis> {
        let z = found.frame.rotation.z_axis;
        let mut axes: Vec<OtherAxis> = Vec::new();
        let mut add = |d: DVec3, order: u32, residual: f64| {
            let same = |a: &OtherAxis| self.same_axis(DVec3::from_array(a.direction), d);
            if !axes.iter().any(same) && !self.same_axis(d, z) && axes.len() < LISTED {
                axes.push(OtherAxis {
                    direction: forward(d).to_array(),
                    order,
                    residual,
                });
            }
        };
        let mut others: Vec<&Rotation> = rotations.iter().filter(|r| r.distinct).collect();
        others.sort_by_key(|r| std::cmp::Reverse(r.order));
        for r in others {
            let residual = r.deviation.value / found.radius;
            add(r.frame.rotation.z_axis, r.order, residual);
        }
        let Some(first) = found.group.half_turn_axis() else {
            return axes;
        };
        let n = found.group.order;
        let residual = found.verified.deviation.value / found.radius;
        for k in 0..n {
            let turn = Isometry::rotation(i64::from(k), 2 * n).compose(first);
            add(found.frame.rotation * turn.apply(DVec3::X), 2, residual);
        }
        axes
    }

    /// Name of the polyhedral group, if axes of order three or more point in several directions.
    pub fn polyhedral(&self, found: &Found, axes: &[OtherAxis]) -> Option<String> {
        let high: Vec<u32> = axes.iter().map(|a| a.order).filter(|&n| n >= 3).collect();
        if high.is_empty() || found.group.order < 3 || found.axisymmetric {
            return None;
        }
        let highest = high.iter().copied().max()?.max(found.group.order);
        let letter = match highest {
            3 => "T",
            4 => "O",
            5 => "I",
            _ => return None,
        };
        let bound = self.limits.bound(found.radius);
        let inversion = Motion::new(&found.frame, -DMat3::IDENTITY);
        let inverted = self.shape.verify_one(inversion, bound, Depth::Quick);
        let suffix = if inverted.is_ok() {
            "h"
        } else if found.group.has_vertical_mirrors() && letter == "T" {
            "d"
        } else {
            ""
        };
        Some(format!("{letter}{suffix}"))
    }
}
