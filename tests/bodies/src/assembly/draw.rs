//! Solids, drawn one by one.

use super::Claim;
use crate::{Body, Dice, Face, Material};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use tmesh::Group;

/// An assembly that is being drawn.
pub struct Drawing {
    pub body: Body,
    pub regions: Vec<Claim>,
    pub order: usize,
    pub features: Vec<String>,
}

impl Default for Drawing {
    fn default() -> Self {
        Self {
            body: Body {
                vertices: Vec::new(),
                faces: Vec::new(),
                materials: Vec::new(),
                order: 1,
                group: Group::TRIVIAL,
            },
            regions: Vec::new(),
            order: 1,
            features: Vec::new(),
        }
    }
}

/// A circle that is drawn as a polygon.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    pub radius: f64,
    pub sides: usize,
    /// Where the first corner is, in sides.
    pub phase: f64,
}

impl Circle {
    /// A circle drawn with a random number of sides.
    pub fn random(radius: f64, dice: &mut Dice) -> Self {
        Self {
            radius,
            sides: dice.pick(&[12, 16, 17, 24, 25, 31, 32, 40, 48, 60]),
            phase: dice.pick(&[0.0, 0.0, 0.5, 0.3]) * dice.pick(&[1.0, 1.0, 0.37]),
        }
    }

    /// Its corners.
    pub fn corners(&self) -> Vec<DVec2> {
        let angle = |i: usize| TAU * (i as f64 + self.phase) / self.sides as f64;
        let corner = |i| DVec2::from_angle(angle(i)) * self.radius;
        (0..self.sides).map(corner).collect()
    }

    /// How far its sides are inside of it.
    pub fn sagitta(&self) -> f64 {
        self.radius * (1.0 - (std::f64::consts::PI / self.sides as f64).cos())
    }
}

impl Drawing {
    /// A new solid; faces that are drawn belong to it. Its volume is set when it is drawn.
    pub fn solid(&mut self, name: String) -> usize {
        self.body.materials.push(Material { name });
        self.regions.push(Claim {
            volume: 0.0,
            slack: 0.0,
        });
        self.body.materials.len() - 1
    }

    /// Vertices at places.
    fn vertices(&mut self, places: impl IntoIterator<Item = DVec3>) -> Vec<u32> {
        let first = self.body.vertices.len() as u32;
        self.body.vertices.extend(places);
        (first..self.body.vertices.len() as u32).collect()
    }

    /// Triangles of the last solid, counter-clockwise from outside.
    fn face(&mut self, vertices: [u32; 3]) {
        self.body.faces.push(Face {
            vertices,
            front: None,
            back: Some(self.body.materials.len() - 1),
        });
    }

    /// A box with diagonals chosen at random, some faces with a corner in the middle.
    pub fn block(&mut self, low: DVec3, high: DVec3, dice: &mut Dice) {
        let corner = |i: usize| {
            let pick = |bit: usize, axis: usize| if i & bit != 0 { high[axis] } else { low[axis] };
            DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
        };
        let v = self.vertices((0..8).map(corner));
        for quad in [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ] {
            let mut quad = quad.map(|i: usize| v[i]);
            quad.rotate_left(dice.below(2));
            let [a, b, c, d] = quad;
            if dice.chance(0.2) {
                let (s, t) = (dice.between(0.2, 0.8), dice.between(0.2, 0.8));
                let [p, q, r] = [a, b, d].map(|v| self.body.vertices[v as usize]);
                let m = self.vertices([p + s * (q - p) + t * (r - p)])[0];
                for [x, y] in [[a, b], [b, c], [c, d], [d, a]] {
                    self.face([x, y, m]);
                }
            } else {
                self.face([a, b, c]);
                self.face([a, c, d]);
            }
        }
    }

    /// A prism over a polygon that is star-shaped as seen from `middle`.
    pub fn prism(&mut self, polygon: &[DVec2], middle: DVec2, [low, high]: [f64; 2]) {
        let n = polygon.len();
        let lifted = |z: f64| polygon.iter().map(move |p| p.extend(z));
        let below = self.vertices(lifted(low));
        let above = self.vertices(lifted(high));
        let [bottom, top] = [low, high].map(|z| self.vertices([middle.extend(z)])[0]);
        for i in 0..n {
            let j = (i + 1) % n;
            self.face([below[j], below[i], bottom]);
            self.face([above[i], above[j], top]);
            self.face([below[i], below[j], above[j]]);
            self.face([below[i], above[j], above[i]]);
        }
    }

    /// What is between two polygons around the axis, both counter-clockwise; corners of the inner one are seen from
    /// those of the outer one that are near in angle.
    pub fn tube(&mut self, inner: &[DVec2], outer: &[DVec2], [low, high]: [f64; 2]) {
        let levels = [low, high].map(|z| {
            let lifted =
                |polygon: &[DVec2]| -> Vec<DVec3> { polygon.iter().map(|p| p.extend(z)).collect() };
            [self.vertices(lifted(inner)), self.vertices(lifted(outer))]
        });
        let [[inner_below, outer_below], [inner_above, outer_above]] = levels;
        for [i, j, k] in annulus(inner, outer) {
            let of = |corner: Corner, inner: &[u32], outer: &[u32]| match corner {
                Corner::Inner(i) => inner[i],
                Corner::Outer(i) => outer[i],
            };
            let above = [i, j, k].map(|c| of(c, &inner_above, &outer_above));
            let below = [i, k, j].map(|c| of(c, &inner_below, &outer_below));
            self.face(above);
            self.face(below);
        }
        for (below, above, outward) in [
            (&inner_below, &inner_above, false),
            (&outer_below, &outer_above, true),
        ] {
            let n = below.len();
            for i in 0..n {
                let (i, j) = if outward {
                    (i, (i + 1) % n)
                } else {
                    ((i + 1) % n, i)
                };
                self.face([below[i], below[j], above[j]]);
                self.face([below[i], above[j], above[i]]);
            }
        }
    }
}

impl Drawing {
    /// What is between two arcs, both counter-clockwise, their ends joined.
    pub fn slab(&mut self, inner: &[DVec2], outer: &[DVec2], levels: [f64; 2]) {
        let around: Vec<DVec2> = outer.iter().chain(inner.iter().rev()).copied().collect();
        let n = around.len();
        let [below, above] = levels.map(|z| self.vertices(around.iter().map(|p| p.extend(z))));
        for i in 0..n {
            let j = (i + 1) % n;
            self.face([below[i], below[j], above[j]]);
            self.face([below[i], above[j], above[i]]);
        }
        // Corners of both arcs in the order of how far along they are.
        let (last, count) = (outer.len() - 1, inner.len() - 1);
        let (mut i, mut j) = (0, 0);
        while i < count || j < last {
            let inside = |i: usize| n - 1 - i;
            let triangle = if j == last || i < count && (i + 1) * last <= (j + 1) * count {
                i += 1;
                [inside(i), inside(i - 1), j]
            } else {
                j += 1;
                [inside(i), j - 1, j]
            };
            let [a, b, c] = triangle;
            self.face([above[a], above[b], above[c]]);
            self.face([below[a], below[c], below[b]]);
        }
    }
}

#[derive(Clone, Copy)]
enum Corner {
    Inner(usize),
    Outer(usize),
}

/// Triangles between two polygons around the origin, counter-clockwise: sides are taken in the order of the angles of
/// their middles.
fn annulus(inner: &[DVec2], outer: &[DVec2]) -> Vec<[Corner; 3]> {
    let angle = |polygon: &[DVec2], i: usize| {
        let first = polygon[0].to_angle();
        let turned = (polygon[i % polygon.len()].to_angle() - first).rem_euclid(TAU);
        let whole = if i >= polygon.len() { TAU } else { 0.0 };
        first.rem_euclid(TAU) + turned + whole
    };
    // The outer corner nearest in angle to the first inner one comes first.
    let start = angle(inner, 0);
    let off = |i: usize| {
        let d = (outer[i].to_angle() - start).rem_euclid(TAU);
        d.min(TAU - d)
    };
    let nearest = (0..outer.len())
        .min_by(|&i, &j| off(i).total_cmp(&off(j)))
        .unwrap_or(0);
    let mut turned = outer.to_vec();
    turned.rotate_left(nearest);
    let base = angle(&turned, 0);
    let shift = if base - start > 0.5 * TAU {
        -TAU
    } else if start - base > 0.5 * TAU {
        TAU
    } else {
        0.0
    };
    let (n, m) = (inner.len(), outer.len());
    let (mut i, mut j) = (0, 0);
    let mut triangles = Vec::new();
    while i < n || j < m {
        let at = |j: usize| Corner::Outer((j + nearest) % m);
        let side_inner = angle(inner, i) + angle(inner, i + 1);
        let side_outer = angle(&turned, j) + angle(&turned, j + 1) + 2.0 * shift;
        if j == m || i < n && side_inner <= side_outer {
            triangles.push([Corner::Inner((i + 1) % n), Corner::Inner(i % n), at(j)]);
            i += 1;
        } else {
            triangles.push([Corner::Inner(i % n), at(j), at(j + 1)]);
            j += 1;
        }
    }
    triangles
}
