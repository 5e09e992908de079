//! The angle of a seam over distance from the axis and height.

use glam::DVec3;
use std::f64::consts::FRAC_PI_6;

/// The angle of a seam, as a function of the distance from the axis and the height: bilinear between knots,
/// constant beyond them.
#[derive(Clone, Debug, PartialEq)]
pub struct Graph {
    /// Distances from the axis of the knots, increasing, model units.
    radii: Vec<f64>,
    /// Heights of the knots, increasing, model units.
    heights: Vec<f64>,
    /// Angles at the knots, radians: for each distance those at all heights.
    angles: Vec<f64>,
}

/// How far the middle of an arc that turns by 30 degrees, from which on an edge is a feature, is from its chord, in
/// parts of the chord: an angle over eight where it is small. What is bent less may be taken as straight.
pub const STRAIGHT: f64 = FRAC_PI_6 / 8.0;

/// The middles of the quarters of a way from 0 to 1: what bends once is seen in any of them, and twice in two.
pub fn samples() -> impl Iterator<Item = f64> {
    (0..4).map(|quarter| 0.25 * (f64::from(quarter) + 0.5))
}

/// Twice as many intervals, on a cubic spline; the ends stay.
fn finer(values: &[f64]) -> Vec<f64> {
    let [first, .., last] = values else {
        return values.to_vec();
    };
    let mut made = vec![*first];
    for (i, w) in values.windows(2).enumerate() {
        made.push(w[0].midpoint(w[1]));
        if let Some(next) = values.get(i + 2) {
            made.push(0.125 * (w[0] + 6.0 * w[1] + next));
        }
    }
    made.push(*last);
    made
}

/// What a graph does where the height changes its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// The angle stays.
    Even,
    /// The angle changes its sign.
    Odd,
    /// Anything else.
    None,
}

/// The interval between increasing knots that holds a value, and the share of the way along it.
fn locate(knots: &[f64], x: f64) -> (usize, f64) {
    let after = knots.partition_point(|&k| k <= x);
    match after {
        0 => (0, 0.0),
        _ if after == knots.len() => (knots.len() - 1, 0.0),
        _ => {
            let (low, high) = (knots[after - 1], knots[after]);
            (after - 1, (x - low) / (high - low))
        }
    }
}

impl Graph {
    /// From increasing distances and heights, and the angles (radians) of all heights at each distance.
    pub fn new(radii: Vec<f64>, heights: Vec<f64>, angles: Vec<f64>) -> Self {
        debug_assert_eq!(radii.len() * heights.len(), angles.len());
        Self {
            radii,
            heights,
            angles,
        }
    }

    /// The angle at a distance from the axis and a height, radians.
    pub fn angle(&self, radius: f64, height: f64) -> f64 {
        let (i, s) = locate(&self.radii, radius);
        let (j, t) = locate(&self.heights, height);
        let count = self.heights.len();
        let at = |i: usize, j: usize| {
            self.angles[i.min(self.radii.len() - 1) * count + j.min(count - 1)]
        };
        let along = |i: usize| match t {
            0.0 => at(i, j),
            t => at(i, j) + (at(i, j + 1) - at(i, j)) * t,
        };
        match s {
            0.0 => along(i),
            s => along(i) + (along(i + 1) - along(i)) * s,
        }
    }

    /// The point, turned back by the angle of the graph there.
    pub fn straighten(&self, p: DVec3) -> DVec3 {
        turn(p, -self.angle(p.x.hypot(p.y), p.z))
    }

    /// The point of which another is the straightened one.
    pub fn bend(&self, p: DVec3) -> DVec3 {
        turn(p, self.angle(p.x.hypot(p.y), p.z))
    }

    /// The graph without creases: a spline whose control points are the knots, with new knots at all quarters between, where
    /// a quarter of a crease is left each time (J. Lane, R. Riesenfeld, "A theoretical development for the computer generation and
    /// display of piecewise polynomial surfaces", 1980).
    pub fn rounded(mut self) -> Self {
        for _halving in [1, 2] {
            let count = self.heights.len();
            let rows = self.angles.chunks(count).map(finer);
            let rows: Vec<Vec<f64>> = rows.collect();
            let columns = (0..rows[0].len()).map(|j| rows.iter().map(|r| r[j]).collect::<Vec<_>>());
            let columns: Vec<Vec<f64>> = columns.map(|column| finer(&column)).collect();
            let across = 0..columns[0].len();
            self.angles = across
                .flat_map(|i| columns.iter().map(move |column| column[i]))
                .collect();
            // Heights and distances that are as far apart as each other stay so.
            (self.radii, self.heights) = (finer(&self.radii), finer(&self.heights));
        }
        self
    }

    /// The same graph, raised by a height, model units.
    pub fn raised(mut self, by: f64) -> Self {
        self.heights.iter_mut().for_each(|z| *z += by);
        self
    }

    /// The same graph, turned by an angle, radians.
    pub fn turned(mut self, angle: f64) -> Self {
        self.angles.iter_mut().for_each(|a| *a += angle);
        self
    }

    /// The same graph, at each of some heights (model units, increasing) turned by an angle (radians), and between them by what
    /// lies between; `None` where none are given.
    pub fn shifted(&self, by: &[(f64, f64)]) -> Option<Self> {
        let (known, angles): (Vec<f64>, Vec<f64>) = by.iter().copied().unzip();
        let turn = |z: f64| match locate(&known, z) {
            (i, 0.0) => angles[i],
            (i, t) => angles[i] + (angles[i + 1] - angles[i]) * t,
        };
        let mut heights: Vec<f64> = self.heights.iter().chain(&known).copied().collect();
        heights.sort_unstable_by(f64::total_cmp);
        heights.dedup();
        let at = |&r: &f64| heights.iter().map(move |&z| (r, z)).collect::<Vec<_>>();
        let places = self.radii.iter().flat_map(at);
        (!known.is_empty()).then(|| Self {
            radii: self.radii.clone(),
            angles: places.map(|(r, z)| self.angle(r, z) + turn(z)).collect(),
            heights: heights.clone(),
        })
    }

    /// The unit normal of the seam at the distance and height of a point, in the direction of increasing angles; `None`
    /// where the point is on the other side of the axis. `step`: a length over which the graph hardly changes.
    pub fn normal(&self, p: DVec3, step: f64) -> Option<DVec3> {
        if self.straighten(p).x <= 0.0 {
            return None;
        }
        let radius = p.x.hypot(p.y);
        let slope = |r: f64, z: f64| {
            self.angle(radius + r, p.z + z) - self.angle((radius - r).max(0.0), p.z - z)
        };
        let (out, up) = (slope(step, 0.0), slope(0.0, step));
        let outward = DVec3::new(p.x, p.y, 0.0) / radius;
        let along = DVec3::Z.cross(outward);
        let normal = along - (outward * out + DVec3::Z * up) * (0.5 * radius / step);
        normal.try_normalize()
    }

    /// The number of the patch of the graph that a point is in: within a patch the graph is smooth.
    fn patch(&self, p: DVec3) -> [usize; 2] {
        let number = |knots: &[f64], x: f64| knots.partition_point(|&k| k <= x);
        [
            number(&self.radii, p.x.hypot(p.y)),
            number(&self.heights, p.z),
        ]
    }

    /// Where on a way, from 0 to 1, it passes a knot: of such places one near the middle.
    pub fn crease(&self, at: impl Fn(f64) -> DVec3) -> Option<f64> {
        let patch = |s: f64| self.patch(at(s));
        // A way along a knot is on neither side of it but for rounding.
        let is_off = |s: f64| {
            let p = at(s);
            let off = |knots: &[f64], x: f64| {
                let size = knots.iter().fold(0.0_f64, |m, k| m.max(k.abs()));
                let near = knots.iter().map(|k| (x - k).abs());
                near.fold(f64::INFINITY, f64::min) > f64::EPSILON.sqrt() * size
            };
            off(&self.radii, p.x.hypot(p.y)) && off(&self.heights, p.z)
        };
        let ways = samples().zip(samples().skip(1));
        let creases = ways.filter(|&(a, b)| patch(a) != patch(b) && is_off(a) && is_off(b));
        let off = |&(a, b): &(f64, f64)| (a + b - 1.0).abs();
        let (mut low, mut high) = creases.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        let first = patch(low);
        for _ in 0..f64::MANTISSA_DIGITS {
            let middle = 0.5 * (low + high);
            match patch(middle) == first {
                true => low = middle,
                false => high = middle,
            }
        }
        Some(high)
    }

    /// What the graph does where the height changes its sign.
    pub fn parity(&self) -> Parity {
        // The height of the centre is that of a body, not of a table.
        let rounding = f64::EPSILON.sqrt();
        let mirrored = self.heights.iter().map(|z| -z);
        let heights: Vec<f64> = mirrored.chain(self.heights.iter().copied()).collect();
        let all = |is: &dyn Fn(f64, f64) -> bool| {
            self.radii.iter().all(|&r| {
                let both = |&z: &f64| is(self.angle(r, z), self.angle(r, -z));
                heights.iter().all(both)
            })
        };
        match () {
            () if all(&|up, down| (up + down).abs() <= rounding) => Parity::Odd,
            () if all(&|up, down| (up - down).abs() <= rounding) => Parity::Even,
            () => Parity::None,
        }
    }

    /// How many knots there are.
    pub fn knots(&self) -> usize {
        self.angles.len()
    }

    /// Least and largest angle, radians.
    pub fn range(&self) -> [f64; 2] {
        let angles = self.angles.iter().copied();
        [
            angles.clone().fold(f64::INFINITY, f64::min),
            angles.fold(f64::NEG_INFINITY, f64::max),
        ]
    }
}

fn turn(p: DVec3, angle: f64) -> DVec3 {
    if angle == 0.0 {
        return p;
    }
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    DVec3::new(p.x * c - p.y * s, p.x * s + p.y * c, p.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn graphs_are_linear_between_knots_and_constant_beyond() {
        let graph = Graph::new(vec![1.0, 3.0], vec![0.0, 2.0], vec![0.0, 1.0, 0.5, 2.5]);
        assert_eq!(graph.angle(0.1, -1.0), 0.0);
        assert_eq!(graph.angle(1.0, 1.0), 0.5);
        assert_eq!(graph.angle(2.0, 2.0), 1.75);
        assert_eq!(graph.angle(9.0, 9.0), 2.5);
        let p = DVec3::new(1.2, -0.7, 0.4);
        assert!(graph.bend(graph.straighten(p)).distance(p) < 1e-15);
        assert_eq!(graph.parity(), Parity::None);
        let odd = Graph::new(vec![0.0], vec![-1.0, 1.0], vec![-0.3, 0.3]);
        assert_eq!(odd.parity(), Parity::Odd);
    }
}
