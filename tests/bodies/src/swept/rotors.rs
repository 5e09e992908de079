//! Bodies with toothed or bladed sections: gear, ratchet, impeller.

use super::Tessellation;
use super::sweep::Sweep;
use crate::Body;
use glam::DVec3;
use tmesh::Isometry;

/// A point of a section: its place within the pitch, in `parts` of it, and its radius.
#[derive(Clone, Copy)]
struct Point {
    part: i64,
    radius: f64,
}

/// The section of one tooth, repeated `order` times; angles are exact fractions of a turn.
struct Section<'a> {
    order: u32,
    parts: u32,
    points: &'a [Point],
}

impl Section<'_> {
    /// The ring at height `z`, turned by `twist` radians, with radii as `radius` makes them.
    fn ring(&self, z: f64, twist: f64, radius: impl Fn(f64) -> f64) -> Vec<DVec3> {
        let (tc, ts) = (libm::cos(twist), libm::sin(twist));
        let mut ring = Vec::new();
        for tooth in 0..i64::from(self.order) {
            for p in self.points {
                let part = tooth * i64::from(self.parts) + p.part;
                let (c, s) = Isometry::rotation(part, self.parts * self.order).cos_sin();
                let r = radius(p.radius);
                ring.push(DVec3::new(r * (c * tc - s * ts), r * (s * tc + c * ts), z));
            }
        }
        ring
    }

    /// One material between this section (placed at each level by `levels`: height, twist, scale
    /// of the radii) and a bore whose corners lie at the same angles, or the axis. A second one
    /// lines the bore where `coating`, its thickness at the corners, is not 0.
    fn extrude(
        &self,
        bore: f64,
        coating: f64,
        levels: &[(f64, f64, f64)],
        mirror: bool,
        tessellation: Tessellation,
    ) -> Body {
        let coated = coating > 0.0 && bore > 0.0;
        let names: &[&str] = if coated {
            &["body", "coating"]
        } else {
            &["body"]
        };
        let mut sweep = Sweep::new(names.iter().copied());
        let mut outer = Vec::new();
        let mut inner = Vec::new();
        let mut lining = Vec::new();
        for (i, &(z, twist, scale)) in levels.iter().enumerate() {
            outer.push(sweep.ring(self.ring(z, twist, |r| r * scale)));
            if bore > 0.0 {
                inner.push(sweep.ring(self.ring(z, twist, |_| bore + coating)));
                if coated {
                    lining.push(sweep.ring(self.ring(z, twist, |_| bore)));
                }
            } else if i == 0 || i + 1 == levels.len() {
                inner.push(sweep.axis(z));
            }
        }
        let last = |rings: &[_]| rings[rings.len() - 1];
        sweep.strip(inner[0], outer[0], Some(0), None);
        sweep.strip(last(&outer), last(&inner), Some(0), None);
        for pair in outer.windows(2) {
            sweep.strip(pair[0], pair[1], Some(0), None);
        }
        if bore > 0.0 {
            for pair in inner.windows(2) {
                sweep.strip(pair[0], pair[1], coated.then_some(1), Some(0));
            }
        }
        if coated {
            sweep.strip(lining[0], inner[0], Some(1), None);
            sweep.strip(last(&inner), last(&lining), Some(1), None);
            for pair in lining.windows(2) {
                sweep.strip(pair[0], pair[1], None, Some(1));
            }
        }
        let flat = levels
            .iter()
            .all(|&(_, twist, scale)| twist == 0.0 && scale == 1.0);
        sweep.build(self.order, mirror, flat, tessellation)
    }
}

/// A spur gear with straight-flanked teeth; mirror planes run through teeth and gaps.
#[derive(Clone, Debug)]
pub struct Gear {
    /// Number of teeth.
    pub order: u32,
    /// Radius at the tips.
    pub radius: f64,
    /// Radius of the bore; 0 for none.
    pub bore: f64,
    /// Height.
    pub height: f64,
    /// How flat parts are split.
    pub tessellation: Tessellation,
}

impl Gear {
    /// Radius at the roots, relative to the tips.
    pub const ROOT: f64 = 0.8;

    /// The body.
    pub fn build(&self) -> Body {
        let root = Self::ROOT * self.radius;
        let points = [(-7, root), (-4, self.radius), (4, self.radius), (7, root)];
        let section = Section {
            order: self.order,
            parts: 20,
            points: &points.map(|(part, radius)| Point { part, radius }),
        };
        let levels = [(0.0, 0.0, 1.0), (self.height, 0.0, 1.0)];
        section.extrude(self.bore, 0.0, &levels, true, self.tessellation)
    }
}

/// A ratchet wheel with saw teeth: rotations only, no mirror contains the axis.
#[derive(Clone, Debug)]
pub struct Ratchet {
    /// Number of teeth.
    pub order: u32,
    /// Radius at the tips.
    pub radius: f64,
    /// Radius of the bore; 0 for none.
    pub bore: f64,
    /// Thickness at its corners of a second material that lines the bore; 0 for none.
    pub coating: f64,
    /// Height.
    pub height: f64,
    /// How flat parts are split.
    pub tessellation: Tessellation,
}

impl Ratchet {
    /// Radius at the roots, relative to the tips.
    pub const ROOT: f64 = 0.75;

    /// The body.
    pub fn build(&self) -> Body {
        let points = [(0, self.radius), (3, Self::ROOT * self.radius)];
        let section = Section {
            order: self.order,
            parts: 20,
            points: &points.map(|(part, radius)| Point { part, radius }),
        };
        let levels = [(0.0, 0.0, 1.0), (self.height, 0.0, 1.0)];
        section.extrude(self.bore, self.coating, &levels, false, self.tessellation)
    }
}

/// A hub with blades that twist with the height and narrow towards the top: rotations only.
#[derive(Clone, Debug)]
pub struct Impeller {
    /// Number of blades.
    pub order: u32,
    /// Radius at the blade tips, at the bottom.
    pub radius: f64,
    /// Radius of the bore; 0 for none.
    pub bore: f64,
    /// Height.
    pub height: f64,
    /// Twist from bottom to top, radians.
    pub twist: f64,
    /// Levels of facets over the height.
    pub layers: u32,
    /// How flat parts are split.
    pub tessellation: Tessellation,
}

impl Impeller {
    /// Radius of the hub, relative to the blade tips.
    pub const HUB: f64 = 0.4;
    /// Size of the top section relative to the bottom one.
    pub const TOP: f64 = 0.75;

    /// The body.
    pub fn build(&self) -> Body {
        let (tip, hub) = (self.radius, Self::HUB * self.radius);
        let points = [
            (-5, hub),
            (-3, tip),
            (3, tip),
            (5, hub),
            (15, hub),
            (25, hub),
        ];
        let section = Section {
            order: self.order,
            parts: 40,
            points: &points.map(|(part, radius)| Point { part, radius }),
        };
        let levels: Vec<_> = (0..=self.layers)
            .map(|k| {
                let share = f64::from(k) / f64::from(self.layers);
                let scale = 1.0 - (1.0 - Self::TOP) * share;
                (self.height * share, self.twist * share, scale)
            })
            .collect();
        section.extrude(
            self.bore,
            0.0,
            &levels,
            self.twist == 0.0,
            self.tessellation,
        )
    }
}
