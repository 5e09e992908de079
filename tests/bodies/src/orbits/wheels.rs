//! Wheels without mirror planes through the axis, whose upper and lower halves are images of each other.

use super::orbit::{Corners, orbit};
use crate::Body;
use glam::DVec3;
use tmesh::{Group, Isometry, Kind};

/// A wheel with saw teeth around it: its group is C_nh.
#[derive(Clone, Debug)]
pub struct SawWheel {
    /// Number of teeth.
    pub order: u32,
    /// Radius at the tips.
    pub radius: f64,
    /// Radius of the bore; 0 for none.
    pub bore: f64,
    /// Height, from -height / 2 to height / 2.
    pub height: f64,
}

/// A wheel with saw teeth on its faces, above and below by turns: its group is S_2n.
#[derive(Clone, Debug)]
pub struct AlternatingWheel {
    /// Number of teeth on either face.
    pub order: u32,
    /// Radius of the rim.
    pub radius: f64,
    /// Radius of the bore; 0 for none.
    pub bore: f64,
    /// Height between the faces beside the teeth.
    pub height: f64,
}

/// Where a wheel is cut by a half-plane from the axis, above z = 0.
#[derive(Clone, Copy)]
struct Column {
    /// Angle, in parts of the turn.
    part: i64,
    /// Radius of the rim.
    radius: f64,
    /// Height of the rim.
    height: f64,
}

/// What the columns of a wheel have in common.
struct Upper {
    /// Parts of a turn.
    parts: u32,
    /// Radius of the ring within which the face is level.
    level: f64,
    /// Whether the wheel is open within that ring.
    bored: bool,
    /// Height of that ring.
    height: f64,
}

impl Upper {
    /// The surface above z = 0 between the first column and the last.
    fn surface(&self, columns: &[Column]) -> Vec<Corners> {
        let mut triangles = Vec::new();
        for pair in columns.windows(2) {
            let at = |c: Column, radius: f64, z: f64| {
                Isometry::rotation(c.part, self.parts).apply(DVec3::new(radius, 0.0, z))
            };
            let [p, q] = [pair[0], pair[1]].map(|c| at(c, c.radius, 0.0));
            let [r, s] = [pair[1], pair[0]].map(|c| at(c, c.radius, c.height));
            let [t, u] = [pair[1], pair[0]].map(|c| at(c, self.level, self.height));
            triangles.extend([[p, q, r], [p, r, s], [s, r, t], [s, t, u]]);
            if self.bored {
                let [v, w] = [pair[1], pair[0]].map(|c| at(c, self.level, 0.0));
                triangles.extend([[u, t, v], [u, v, w]]);
            } else {
                triangles.push([u, t, DVec3::new(0.0, 0.0, self.height)]);
            }
        }
        triangles
    }
}

impl SawWheel {
    /// Radius at the roots, relative to the tips.
    pub const ROOT: f64 = 0.75;

    /// The body.
    pub fn build(&self) -> Body {
        let height = 0.5 * self.height;
        let bored = self.bore > 0.0;
        let upper = Upper {
            parts: 20 * self.order,
            level: if bored { self.bore } else { 0.5 * self.radius },
            bored,
            height,
        };
        let root = Self::ROOT * self.radius;
        let column = |(part, radius)| Column {
            part,
            radius,
            height,
        };
        let columns = [(0, self.radius), (3, root), (20, self.radius)].map(column);
        orbit(Group::new(Kind::Ch, self.order), &upper.surface(&columns))
    }
}

impl AlternatingWheel {
    /// Height of the teeth, relative to that of the wheel between its faces.
    pub const TOOTH: f64 = 0.5;
    /// Radius within which the faces are level where there is no bore, relative to the rim.
    const LEVEL: f64 = 0.4;

    /// The body.
    pub fn build(&self) -> Body {
        let height = 0.5 * self.height;
        let bored = self.bore > 0.0;
        // A tooth takes the first half of the pitch; in the other half its image stands below.
        let upper = Upper {
            parts: 8 * self.order,
            level: if bored {
                self.bore
            } else {
                Self::LEVEL * self.radius
            },
            bored,
            height,
        };
        let tip = height + Self::TOOTH * self.height;
        let radius = self.radius;
        let column = |(part, height)| Column {
            part,
            radius,
            height,
        };
        let columns = [(0, height), (3, tip), (4, height), (7, height), (8, height)].map(column);
        orbit(Group::new(Kind::S, self.order), &upper.surface(&columns))
    }
}
