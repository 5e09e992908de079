//! Cylinders and tubes as facets, each circle a polygon with corners of its own: solids of one assembly as a CAD program
//! draws them, each for itself.

use crate::facets::Facet;
use std::f64::consts::TAU;

/// A circle about the z axis, drawn as a polygon whose corners are on it.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    /// Its radius.
    pub radius: f64,
    /// How many corners are drawn.
    pub corners: u32,
    /// Where the first corner is, as a share of the angle between two.
    pub phase: f64,
}

impl Circle {
    fn corner(&self, k: u32) -> [f64; 2] {
        let angle = TAU * (f64::from(k) + self.phase) / f64::from(self.corners);
        [
            self.radius * libm::cos(angle),
            self.radius * libm::sin(angle),
        ]
    }

    fn angle(&self, k: u32) -> f64 {
        (f64::from(k) + self.phase) / f64::from(self.corners)
    }

    /// Area of the polygon.
    pub fn area(&self) -> f64 {
        let n = f64::from(self.corners);
        0.5 * n * self.radius * self.radius * libm::sin(TAU / n)
    }

    /// Area of the circle.
    pub fn disc(&self) -> f64 {
        0.5 * TAU * self.radius * self.radius
    }
}

/// The wall of a prism over a circle's polygon, facing outwards.
fn wall(circle: Circle, [low, high]: [f64; 2]) -> Vec<Facet> {
    let n = circle.corners;
    let at = |k: u32, z: f64| {
        let [x, y] = circle.corner(k % n);
        [x, y, z]
    };
    let quad = |k: u32| {
        let [a, b, c, d] = [at(k, low), at(k + 1, low), at(k + 1, high), at(k, high)];
        [[a, b, c], [a, c, d]]
    };
    (0..n).flat_map(quad).collect()
}

fn turned(facets: impl IntoIterator<Item = Facet>) -> Vec<Facet> {
    facets.into_iter().map(|[a, b, c]| [a, c, b]).collect()
}

/// A cylinder between two heights: its ends are fans about a corner.
pub fn cylinder(circle: Circle, [low, high]: [f64; 2]) -> Vec<Facet> {
    let at = |k: u32, z: f64| {
        let [x, y] = circle.corner(k);
        [x, y, z]
    };
    let end = |z: f64| (1..circle.corners - 1).map(move |k| [at(0, z), at(k, z), at(k + 1, z)]);
    [
        wall(circle, [low, high]),
        end(high).collect(),
        turned(end(low)),
    ]
    .concat()
}

/// A tube between two circles and two heights.
pub fn tube(inner: Circle, outer: Circle, [low, high]: [f64; 2]) -> Vec<Facet> {
    let ring = |z: f64| {
        let at = |c: Circle, k: u32| {
            let [x, y] = c.corner(k % c.corners);
            [x, y, z]
        };
        let (mut i, mut o) = (0, 0);
        let mut facets = Vec::new();
        while i < inner.corners || o < outer.corners {
            let inner_first = inner.angle(i + 1) < outer.angle(o + 1);
            if o == outer.corners || (i < inner.corners && inner_first) {
                facets.push([at(inner, i), at(outer, o), at(inner, i + 1)]);
                i += 1;
            } else {
                facets.push([at(inner, i), at(outer, o), at(outer, o + 1)]);
                o += 1;
            }
        }
        facets
    };
    [
        wall(outer, [low, high]),
        turned(wall(inner, [low, high])),
        ring(high),
        turned(ring(low)),
    ]
    .concat()
}
