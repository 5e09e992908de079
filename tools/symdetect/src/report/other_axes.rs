//! Axes beside the main one.

use crate::budget::LISTED;
use crate::group::{Found, forward};
use crate::rotation::{Query, Rotation};
use crate::shape::Motion;
use crate::verify::Depth;
use glam::{DMat3, DVec3};
use tmesh::{Isometry, OtherAxis};

impl Query<'_> {
    /// Further axes, those of a polyhedral group and half turns across the main one, up to [`LISTED`]; and how many
    /// there are in all.
    pub fn other_axes(&self, found: &Found, rotations: &[Rotation]) -> (Vec<OtherAxis>, usize) {
        let axis = |d: DVec3, order: u32, residual: f64| OtherAxis {
            direction: forward(d).to_array(),
            order,
            residual,
        };
        let is_among = |axes: &[OtherAxis], d: DVec3| {
            let mut axes = axes.iter();
            axes.any(|a| self.same_axis(DVec3::from_array(a.direction), d))
        };
        let mut axes: Vec<OtherAxis> = Vec::new();
        let mut others: Vec<&Rotation> = rotations.iter().filter(|r| r.distinct).collect();
        others.sort_by_key(|r| std::cmp::Reverse(r.order));
        for r in others {
            let d = r.frame.rotation.z_axis;
            let is_main = self.same_axis(d, found.frame.rotation.z_axis);
            if !is_main && !is_among(&axes, d) {
                axes.push(axis(d, r.order, r.deviation.value / found.radius));
            }
        }
        if let Some(first) = found.group.half_turn_axis() {
            let n = found.group.order;
            let residual = found.verified.deviation.value / found.radius;
            let known = axes.len();
            // They differ from each other.
            for k in 0..n {
                let turn = Isometry::rotation(i64::from(k), 2 * n).compose(first);
                let d = found.frame.rotation * turn.apply(DVec3::X);
                if !is_among(&axes[..known], d) {
                    axes.push(axis(d, 2, residual));
                }
            }
        }
        let count = axes.len();
        axes.truncate(LISTED);
        (axes, count)
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
