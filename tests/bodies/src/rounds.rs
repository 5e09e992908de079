//! Cylinders and tubes as facets, each circle a polygon with corners of its own: solids of one assembly as a CAD program
//! draws them, each for itself.

use crate::Dice;
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

/// Corners around an axis, each with its angle as a share of a turn, increasing; the first one comes again at the end.
type Row = Vec<(f64, [f64; 3])>;

fn row(circle: Circle, z: f64) -> Row {
    let corner = |k: u32| {
        let [x, y] = circle.corner(k % circle.corners);
        (circle.angle(k), [x, y, z])
    };
    (0..=circle.corners).map(corner).collect()
}

/// What is between two rows, facing outwards if the second one is above the first one.
fn band(low: &Row, high: &Row) -> Vec<Facet> {
    let (mut i, mut o) = (0, 0);
    let mut facets = Vec::new();
    while i + 1 < low.len() || o + 1 < high.len() {
        let is_low = o + 1 == high.len() || i + 1 < low.len() && low[i + 1].0 < high[o + 1].0;
        let next = if is_low { low[i + 1] } else { high[o + 1] };
        facets.push([low[i].1, next.1, high[o].1]);
        if is_low {
            i += 1;
        } else {
            o += 1;
        }
    }
    facets
}

/// A tube between two circles and two heights.
pub fn tube(inner: Circle, outer: Circle, [low, high]: [f64; 2]) -> Vec<Facet> {
    let ring = |z: f64| turned(band(&row(inner, z), &row(outer, z)));
    [
        wall(outer, [low, high]),
        turned(wall(inner, [low, high])),
        ring(high),
        turned(ring(low)),
    ]
    .concat()
}

/// The corners of a wall around a circle as a mesher places them that knows nothing of other solids: rows from the lowest to the highest, in
/// each as many corners as the circle has, at angles and heights of their own.
pub struct Scattered {
    radius: f64,
    rows: Vec<Row>,
}

impl Scattered {
    /// Rows of corners of a circle between two heights.
    pub fn new(circle: Circle, [low, high]: [f64; 2], rows: u32, dice: &mut Dice) -> Self {
        let step = (high - low) / f64::from(rows - 1);
        let corners = f64::from(circle.corners);
        let mut row = |r: u32| -> Row {
            let phase = dice.between(-0.5, 0.5);
            let is_rim = r == 0 || r + 1 == rows;
            let mut row: Row = (0..circle.corners)
                .map(|k| {
                    let angle = (f64::from(k) + phase + dice.between(-0.3, 0.3)) / corners;
                    let off = if is_rim { 0.0 } else { dice.between(-0.3, 0.3) };
                    let [x, y] = [libm::cos, libm::sin].map(|f| circle.radius * f(TAU * angle));
                    (angle, [x, y, low + step * (f64::from(r) + off)])
                })
                .collect();
            row.push((row[0].0 + 1.0, row[0].1));
            row
        };
        Self {
            radius: circle.radius,
            rows: (0..rows).map(&mut row).collect(),
        }
    }

    /// The wall, facing outwards.
    fn wall(&self) -> Vec<Facet> {
        let pairs = self.rows.windows(2);
        pairs.flat_map(|pair| band(&pair[0], &pair[1])).collect()
    }

    fn rims(&self) -> [&Row; 2] {
        [&self.rows[0], &self.rows[self.rows.len() - 1]]
    }

    /// The cylinder inside.
    pub fn cylinder(&self) -> Vec<Facet> {
        let end = |rim: &Row| {
            let at: Vec<[f64; 3]> = rim.iter().map(|corner| corner.1).collect();
            let fan = (1..at.len() - 2).map(|k| [at[0], at[k], at[k + 1]]);
            fan.collect::<Vec<_>>()
        };
        let [low, high] = self.rims();
        [self.wall(), end(high), turned(end(low))].concat()
    }

    /// The tube around it.
    pub fn tube(&self, outer: Circle) -> Vec<Facet> {
        assert!(outer.radius > self.radius, "a tube is around its bore");
        let ring = |rim: &Row| turned(band(rim, &row(outer, rim[0].1[2])));
        let [low, high] = self.rims();
        let heights = [low, high].map(|rim| rim[0].1[2]);
        [
            wall(outer, heights),
            turned(self.wall()),
            ring(high),
            turned(ring(low)),
        ]
        .concat()
    }
}
