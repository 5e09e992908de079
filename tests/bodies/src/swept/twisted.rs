//! Sections with mirror planes, twisted evenly about the axis: half turns about axes across it are what is
//! left of the mirrors, so the groups are D_n.

use super::Tessellation;
use super::rotors::{Extrusion, Level, Section, tooth};
use crate::Body;
use tmesh::Kind;

/// A bar of rectangular section, twisted: its group is D_2, that of a square one D_4.
#[derive(Clone, Debug)]
pub struct TwistedBar {
    /// Radius of the corners.
    pub radius: f64,
    /// Width across the axis relative to the depth; 1 for a square.
    pub aspect: f64,
    /// Radius of the bore at its four corners; 0 for none.
    pub bore: f64,
    /// Height, from -height / 2 to height / 2.
    pub height: f64,
    /// Twist from bottom to top, radians.
    pub twist: f64,
    /// Levels of facets over the height.
    pub layers: u32,
}

/// A gear with straight-flanked teeth, twisted: its group is D_n.
#[derive(Clone, Debug)]
pub struct HelicalGear {
    /// Number of teeth.
    pub order: u32,
    /// Radius at the tips.
    pub radius: f64,
    /// Radius of the bore; 0 for none.
    pub bore: f64,
    /// Height, from -height / 2 to height / 2.
    pub height: f64,
    /// Twist from bottom to top, radians.
    pub twist: f64,
    /// Levels of facets over the height.
    pub layers: u32,
}

impl TwistedBar {
    /// The body.
    pub fn build(&self) -> Body {
        let order = if self.aspect == 1.0 { 4 } else { 2 };
        let (x, y) = (self.aspect, 1.0);
        let length = x.hypot(y);
        let (c, s) = (x / length, y / length);
        let corners = [(c, s), (-c, s), (-c, -s), (c, -s)];
        let section = Section::of_corners(order, corners.map(|d| (d, self.radius)).to_vec());
        twisted(&section, self.bore, self.height, self.twist, self.layers)
    }
}

impl HelicalGear {
    /// The body.
    pub fn build(&self) -> Body {
        let section = tooth(self.order, self.radius);
        twisted(&section, self.bore, self.height, self.twist, self.layers)
    }
}

fn twisted(section: &Section, bore: f64, height: f64, twist: f64, layers: u32) -> Body {
    // Opposite levels are exactly opposite.
    let share = |k: u32| f64::from(2 * k as i32 - layers as i32) / f64::from(2 * layers);
    let levels: Vec<Level> = (0..=layers)
        .map(|k| Level {
            z: height * share(k),
            twist: twist * share(k),
            scale: 1.0,
        })
        .collect();
    section.extrude(&Extrusion {
        bore,
        coating: 0.0,
        levels: &levels,
        kind: Kind::D,
        tessellation: Tessellation::Symmetric,
    })
}
