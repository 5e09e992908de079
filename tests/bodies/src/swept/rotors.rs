//! Bodies with toothed or bladed sections: gear, ratchet, impeller.

use super::Tessellation;
use super::sweep::Sweep;
use crate::Body;
use glam::DVec3;
use tmesh::{Group, Isometry, Kind};

/// A point of a section: its place within the pitch, in `parts` of it, and its radius.
#[derive(Clone, Copy)]
struct Point {
    part: i64,
    radius: f64,
}

/// A section: its corners, each as direction (cosine and sine of the angle) and radius.
pub struct Section {
    order: u32,
    corners: Vec<((f64, f64), f64)>,
}

/// A section's place in an extrusion.
#[derive(Clone, Copy)]
pub struct Level {
    /// Height.
    pub z: f64,
    /// Angle by which the section is turned, radians.
    pub twist: f64,
    /// Factor on its radii.
    pub scale: f64,
}

/// How a section is extruded.
pub struct Extrusion<'a> {
    /// Radius at the corners of the bore, which lie at the angles of the section's; 0 for none.
    pub bore: f64,
    /// Thickness at the corners of a second material that lines the bore; 0 for none.
    pub coating: f64,
    /// The section's places, from the bottom up.
    pub levels: &'a [Level],
    /// Kind of the body's group.
    pub kind: Kind,
    /// How flat parts are split.
    pub tessellation: Tessellation,
}

impl Section {
    /// A section with these corners, counter-clockwise.
    pub fn of_corners(order: u32, corners: Vec<((f64, f64), f64)>) -> Self {
        Self { order, corners }
    }

    /// The section of one tooth, repeated `order` times; angles are exact fractions of a turn.
    fn of_tooth(order: u32, parts: u32, points: &[Point]) -> Self {
        let teeth = 0..i64::from(order);
        let corners = teeth.flat_map(|tooth| {
            points.iter().map(move |p| {
                let part = tooth * i64::from(parts) + p.part;
                let direction = Isometry::rotation(part, parts * order).cos_sin();
                (direction, p.radius)
            })
        });
        Self::of_corners(order, corners.collect())
    }

    /// The ring at a level, with radii as `radius` makes them.
    fn ring(&self, level: Level, radius: impl Fn(f64) -> f64) -> Vec<DVec3> {
        let (tc, ts) = (libm::cos(level.twist), libm::sin(level.twist));
        let corner = |&((c, s), r): &((f64, f64), f64)| {
            let r = radius(r);
            DVec3::new(r * (c * tc - s * ts), r * (s * tc + c * ts), level.z)
        };
        self.corners.iter().map(corner).collect()
    }

    /// One material between this section and the bore, or the axis, and the second one that lines the bore.
    pub fn extrude(&self, extrusion: &Extrusion) -> Body {
        let Extrusion {
            bore,
            coating,
            levels,
            kind,
            tessellation,
        } = *extrusion;
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
        for (i, &level) in levels.iter().enumerate() {
            outer.push(sweep.ring(self.ring(level, |r| r * level.scale)));
            if bore > 0.0 {
                inner.push(sweep.ring(self.ring(level, |_| bore + coating)));
                if coated {
                    lining.push(sweep.ring(self.ring(level, |_| bore)));
                }
            } else if i == 0 || i + 1 == levels.len() {
                inner.push(sweep.axis(level.z));
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
            .all(|level| level.twist == 0.0 && level.scale == 1.0);
        sweep.build(Group::new(kind, self.order), flat, tessellation)
    }
}

/// A body without twist or taper, from z = 0 up.
fn upright(section: &Section, height: f64, extrusion: Extrusion) -> Body {
    let levels = [0.0, height].map(|z| Level {
        z,
        twist: 0.0,
        scale: 1.0,
    });
    section.extrude(&Extrusion {
        levels: &levels,
        ..extrusion
    })
}

/// The section of a gear with straight-flanked teeth; mirror planes run through teeth and gaps.
pub fn tooth(order: u32, radius: f64) -> Section {
    let root = Gear::ROOT * radius;
    let points = [(-7, root), (-4, radius), (4, radius), (7, root)];
    let points = points.map(|(part, radius)| Point { part, radius });
    Section::of_tooth(order, 20, &points)
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
        let extrusion = Extrusion {
            bore: self.bore,
            coating: 0.0,
            levels: &[],
            kind: Kind::Dh,
            tessellation: self.tessellation,
        };
        upright(&tooth(self.order, self.radius), self.height, extrusion)
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
        let points = points.map(|(part, radius)| Point { part, radius });
        let extrusion = Extrusion {
            bore: self.bore,
            coating: self.coating,
            levels: &[],
            kind: Kind::Ch,
            tessellation: self.tessellation,
        };
        let section = Section::of_tooth(self.order, 20, &points);
        upright(&section, self.height, extrusion)
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
        let points = points.map(|(part, radius)| Point { part, radius });
        let section = Section::of_tooth(self.order, 40, &points);
        let levels: Vec<_> = (0..=self.layers)
            .map(|k| {
                let share = f64::from(k) / f64::from(self.layers);
                Level {
                    z: self.height * share,
                    twist: self.twist * share,
                    scale: 1.0 - (1.0 - Self::TOP) * share,
                }
            })
            .collect();
        section.extrude(&Extrusion {
            bore: self.bore,
            coating: 0.0,
            levels: &levels,
            kind: if self.twist == 0.0 { Kind::Cv } else { Kind::C },
            tessellation: self.tessellation,
        })
    }
}
