//! The antiprism.

use super::orbit::{Corners, orbit};
use crate::Body;
use glam::DVec3;
use tmesh::{Group, Isometry, Kind};

/// An antiprism over a regular polygon: its group is D_nd.
#[derive(Clone, Debug)]
pub struct Antiprism {
    /// Corners of either end.
    pub order: u32,
    /// Circumradius of the ends.
    pub radius: f64,
    /// Circumradius of a bore that is an antiprism itself, with corners at the same angles; 0 for none.
    pub bore: f64,
    /// Height, from -height / 2 to height / 2.
    pub height: f64,
}

impl Antiprism {
    /// The body.
    pub fn build(&self) -> Body {
        let z = 0.5 * self.height;
        // In steps of half a side: the upper end has its corners at even numbers, the lower at odd ones.
        let corner = |step: i64, radius: f64, z: f64| {
            Isometry::rotation(step, 2 * self.order).apply(DVec3::new(radius, 0.0, z))
        };
        let ends = |radius| {
            [
                corner(0, radius, z),
                corner(2, radius, z),
                corner(1, radius, -z),
            ]
        };
        let [a, b, foot] = ends(self.radius);
        let mut patch: Vec<Corners> = vec![[a, foot, b]];
        if self.bore > 0.0 {
            let [d, c, foot] = ends(self.bore);
            patch.push([d, c, foot]);
            // Around the middle, so that the mirror planes map the triangles onto each other.
            let middle = 0.25 * (a + b + c + d);
            patch.extend([[a, b], [b, c], [c, d], [d, a]].map(|[p, q]| [p, q, middle]));
        } else {
            patch.push([a, b, DVec3::new(0.0, 0.0, z)]);
        }
        let body = orbit(Group::new(Kind::S, self.order), &patch);
        Body {
            group: Group::new(Kind::Dd, self.order),
            ..body
        }
    }
}
