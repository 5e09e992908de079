//! The facets of closed solids, which can be divided and flipped.

use crate::imprint::bend;
use geom::cdt::Frame;
use geom::smooth::SMOOTH_COSINE;
use glam::DVec3;
use robust::{Coord, incircle, orient2d};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::VecDeque;

/// Facets of closed solids, each edge of a solid with one facet on either side.
pub struct Skin {
    /// Places.
    pub points: Vec<DVec3>,
    /// Corners of the facets.
    pub corners: Vec<[u32; 3]>,
    /// The facet of before that each is a part of, or took the place of.
    pub origin: Vec<u32>,
    /// The solid of each.
    pub solid: Vec<u32>,
    /// Unit vectors that each is seen along, of the surface behind it: facets between vertices on one line are steep.
    normal: Vec<DVec3>,
    /// Unit normals of the surface behind each at its corners.
    normals: Vec<[DVec3; 3]>,
    /// How far the surface behind each facet of before is from that, model units.
    sagitta: Vec<f64>,
    /// The facet of a solid that has an edge in this direction: start, end, solid.
    sides: FxHashMap<[u32; 3], u32>,
    /// A facet of a solid at a vertex.
    at: FxHashMap<[u32; 2], u32>,
    /// Edges that stay: lower end, higher end, solid.
    fixed: FxHashSet<[u32; 3]>,
}

/// What is known of a facet.
pub struct Behind {
    /// Which of its edges stay.
    pub stays: [bool; 3],
    /// Unit normals of the surface behind it at its corners.
    pub normals: [DVec3; 3],
    /// How far that surface is from it at most, model units.
    pub sagitta: f64,
}

/// A corner of a facet, and the unit normal of the surface there.
type Corner = (u32, DVec3);

/// What is around an edge.
struct Around {
    /// The facets on its left and on its right.
    facets: [u32; 2],
    /// Its ends, and the corners of the facets across it.
    corners: [u32; 4],
    /// Where the corners are in a plane along both facets.
    flat: [Coord<f64>; 4],
}

impl Around {
    /// Whether one of the facets has the corner of the other one inside of the circle around it, or no area.
    fn has_corner_in_circle(&self) -> bool {
        let [a, b, c, d] = self.flat;
        orient2d(a, b, c) <= 0.0 || orient2d(b, a, d) <= 0.0 || incircle(a, b, c, d) > 0.0
    }
}

/// Facets that are looked at at most on the way to a place, or edges flipped for one: a choice. Few places are more than
/// some ten facets from where one begins to look.
const STEPS: usize = 2000;

/// How many times as far off the surface as facets of before an edge is that is about as near: the chord of one facet is once
/// as far off, that across two is four times. Between both, so that facets that are alike around an axis are judged alike
/// whatever rounding makes of them.
const NEAR: f64 = 2.0;

impl Skin {
    /// The facets of solids that are closed and oriented; `behind` tells of each what is known of it.
    pub fn new(
        points: Vec<DVec3>,
        corners: Vec<[u32; 3]>,
        solid: Vec<u32>,
        behind: impl Fn(u32) -> Behind,
    ) -> Self {
        let mut skin = Self {
            points,
            origin: (0..corners.len() as u32).collect(),
            corners: Vec::new(),
            solid: Vec::new(),
            normal: Vec::new(),
            normals: Vec::new(),
            sagitta: Vec::new(),
            sides: FxHashMap::default(),
            at: FxHashMap::default(),
            fixed: FxHashSet::default(),
        };
        skin.sides.reserve(3 * corners.len());
        for (t, (corners, solid)) in (0..).zip(corners.into_iter().zip(solid)) {
            skin.corners.push(corners);
            skin.solid.push(solid);
            let [a, b, c] = corners.map(|v| skin.place(v));
            let normal = (b - a).cross(c - a).normalize_or_zero();
            skin.normal.push(normal);
            let behind = behind(t);
            skin.normals.push(behind.normals);
            skin.sagitta.push(behind.sagitta);
            skin.enter(t);
            for (i, stays) in behind.stays.into_iter().enumerate() {
                if stays {
                    skin.fix(corners[i], corners[(i + 1) % 3], solid);
                }
            }
        }
        skin
    }

    fn enter(&mut self, t: u32) {
        let (corners, solid) = (self.corners[t as usize], self.solid[t as usize]);
        for i in 0..3 {
            self.sides
                .insert([corners[i], corners[(i + 1) % 3], solid], t);
            self.at.insert([corners[i], solid], t);
        }
    }

    /// Whether a solid has a vertex.
    pub fn has(&self, v: u32, solid: u32) -> bool {
        self.at.contains_key(&[v, solid])
    }

    /// The facet of a solid that has an edge in this direction.
    pub fn side(&self, a: u32, b: u32, solid: u32) -> Option<u32> {
        self.sides.get(&[a, b, solid]).copied()
    }

    fn fix(&mut self, a: u32, b: u32, solid: u32) {
        self.fixed.insert([a.min(b), a.max(b), solid]);
    }

    fn is_fixed(&self, a: u32, b: u32, solid: u32) -> bool {
        self.fixed.contains(&[a.min(b), a.max(b), solid])
    }

    /// The corner across an edge of a facet.
    fn apex(&self, t: u32, a: u32, b: u32) -> Option<u32> {
        let mut others = (self.corners[t as usize].into_iter()).filter(|&v| v != a && v != b);
        others.next()
    }

    fn place(&self, v: u32) -> DVec3 {
        self.points[v as usize]
    }

    /// A corner of a facet with its normal there.
    fn corner(&self, t: u32, v: u32) -> Corner {
        let corners = self.corners[t as usize];
        let i = corners.iter().position(|&c| c == v).unwrap_or(0);
        (v, self.normals[t as usize][i])
    }

    /// A vertex on or in a facet as a corner: with normals between those of the facet's corners.
    fn corner_within(&self, t: u32, v: u32) -> Corner {
        let [a, b, c] = self.corners[t as usize].map(|v| self.place(v));
        let (p, normal) = (self.place(v), self.normal[t as usize]);
        let part = |u: DVec3, v: DVec3| (u - p).cross(v - p).dot(normal).max(0.0);
        let [x, y, z] = self.normals[t as usize];
        let mean = x * part(b, c) + y * part(c, a) + z * part(a, b);
        (v, mean.try_normalize().unwrap_or(normal))
    }

    fn put(&mut self, t: u32, corners: [Corner; 3]) {
        self.corners[t as usize] = corners.map(|c| c.0);
        self.normals[t as usize] = corners.map(|c| c.1);
        self.enter(t);
    }

    fn add(&mut self, like: u32, corners: [Corner; 3]) {
        self.corners.push(corners.map(|c| c.0));
        self.normals.push(corners.map(|c| c.1));
        self.origin.push(self.origin[like as usize]);
        self.solid.push(self.solid[like as usize]);
        self.normal.push(self.normal[like as usize]);
        self.enter(self.corners.len() as u32 - 1);
    }

    /// Divides an edge that stays, and the facets on either side, at a vertex; whether the solid has the edge.
    pub fn divide_edge(&mut self, a: u32, b: u32, solid: u32, v: u32) -> bool {
        let (Some(t), Some(u)) = (self.side(a, b, solid), self.side(b, a, solid)) else {
            return false;
        };
        let (Some(c), Some(d)) = (self.apex(t, a, b), self.apex(u, a, b)) else {
            return false;
        };
        if self.has(v, solid) {
            return false;
        }
        self.sides.remove(&[a, b, solid]);
        self.sides.remove(&[b, a, solid]);
        for (t, [from, to, apex]) in [(t, [a, b, c]), (u, [b, a, d])] {
            let [from, to, apex] = [from, to, apex].map(|v| self.corner(t, v));
            let middle = self.corner_within(t, v);
            self.put(t, [from, middle, apex]);
            self.add(t, [middle, to, apex]);
        }
        if self.is_fixed(a, b, solid) {
            self.fix(a, v, solid);
            self.fix(v, b, solid);
        }
        true
    }

    /// Puts a vertex into a facet of before that is only divided since, seen along that, or onto an edge of it that is within `equal`:
    /// facets without an area on both sides of one could not be flipped. Whether the solid does not have it yet.
    pub fn insert(&mut self, v: u32, facet: u32, equal: f64) -> bool {
        let solid = self.solid[facet as usize];
        if self.has(v, solid) {
            return false;
        }
        let Some(t) = self.part_at(self.place(v), facet) else {
            return false;
        };
        if let Some([a, b]) = self.edge_at(self.place(v), t, equal) {
            return self.divide_edge(a, b, solid, v);
        }
        let [a, b, c] = self.corners[t as usize];
        let [x, y, z] = [a, b, c].map(|v| self.corner(t, v));
        let middle = self.corner_within(t, v);
        self.put(t, [x, y, middle]);
        self.add(t, [y, z, middle]);
        self.add(t, [z, x, middle]);
        self.legalize(vec![[a, b], [b, c], [c, a]], solid, |skin, around| {
            let [t, u] = around.facets;
            skin.origin[t as usize] == skin.origin[u as usize] && around.has_corner_in_circle()
        });
        true
    }

    /// The edge of a facet that a place in it is on, if that edge may be flipped.
    fn edge_at(&self, p: DVec3, t: u32, equal: f64) -> Option<[u32; 2]> {
        let (corners, solid) = (self.corners[t as usize], self.solid[t as usize]);
        let edges = [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]]);
        edges.into_iter().find(|&[a, b]| {
            let [from, to] = [a, b].map(|v| self.place(v));
            let across = (p - from).reject_from(to - from);
            let beside = across.reject_from(self.normal[t as usize]);
            beside.length() <= equal && !self.is_fixed(a, b, solid)
        })
    }

    /// The part of a facet at a place, or the one that is nearest to it.
    fn part_at(&self, p: DVec3, facet: u32) -> Option<u32> {
        let frame = Frame::new(self.normal[facet as usize].try_normalize()?);
        let solid = self.solid[facet as usize];
        let p = coord(&frame, p);
        let mut t = facet;
        for _ in 0..STEPS {
            let corners = self.corners[t as usize];
            let flat = corners.map(|v| coord(&frame, self.place(v)));
            let next = (0..3).find_map(|i| {
                let beyond = orient2d(flat[i], flat[(i + 1) % 3], p) < 0.0;
                let next = self.side(corners[(i + 1) % 3], corners[i], solid)?;
                let is_part = self.origin[next as usize] == self.origin[facet as usize];
                (beyond && is_part).then_some(next)
            });
            match next {
                Some(next) => t = next,
                None => return Some(t),
            }
        }
        None
    }

    /// Flips edges around vertices that were put in, which are given, until facets that stand for one surface are as those of a Delaunay
    /// triangulation, seen along both, and no farther off the surface than facets were, or `equal`.
    pub fn settle(&mut self, vertices: &[[u32; 2]], equal: f64) {
        for &[v, solid] in vertices {
            let edges = self.fan(v, solid).into_iter().flat_map(|t| {
                let corners = self.corners[t as usize];
                [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]])
            });
            let edges = edges.collect();
            self.legalize(edges, solid, |skin, around| {
                around.has_corner_in_circle()
                    && skin.stays_flat(around)
                    && skin.stays_near(around, equal)
            });
        }
    }

    /// Whether an edge that a flip makes is about as near to the surface as facets of before were there, or far nearer than the one before: a
    /// chord across several of these would not be.
    fn stays_near(&self, around: &Around, equal: f64) -> bool {
        let ([t, u], [a, b, c, d]) = (around.facets, around.corners);
        let off = |[p, q]: [Corner; 2]| {
            let ends = [p, q].map(|c| self.place(c.0));
            bend(ends, [p, q].map(|c| c.1)).abs() / 8.0
        };
        let before = [t, u].map(|t| self.sagitta[self.origin[t as usize] as usize]);
        let explained = equal.max(NEAR * before[0].max(before[1]));
        let new = off([self.corner(t, c), self.corner(u, d)]);
        let old = [t, u].map(|t| off([a, b].map(|v| self.corner(t, v))));
        new <= explained || NEAR * new <= old[0].max(old[1])
    }

    /// Whether the facets that a flip makes are turned against those of before by no more than is smooth.
    fn stays_flat(&self, around: &Around) -> bool {
        let [t, u] = around.facets;
        let normal = (self.normal[t as usize] + self.normal[u as usize]).normalize_or_zero();
        let [a, b, c, d] = around.corners.map(|v| self.place(v));
        [[a, d, c], [d, b, c]].iter().all(|[a, b, c]| {
            let area = (b - a).cross(c - a);
            area.dot(normal) >= SMOOTH_COSINE * area.length()
        })
    }

    /// What is around an edge of a solid, seen along a direction or along both facets; `None` where it has none on a side.
    fn around(&self, [a, b]: [u32; 2], solid: u32, along: Option<DVec3>) -> Option<Around> {
        let (t, u) = (self.side(a, b, solid)?, self.side(b, a, solid)?);
        let (c, d) = (self.apex(t, a, b)?, self.apex(u, a, b)?);
        let normal = along.unwrap_or(self.normal[t as usize] + self.normal[u as usize]);
        let frame = Frame::new(normal.try_normalize()?);
        let ids = [a, b, c, d];
        Some(Around {
            facets: [t, u],
            corners: ids,
            flat: ids.map(|v| coord(&frame, self.place(v))),
        })
    }

    /// Flips an edge if the facets on its sides make up a convex quadrilateral and `wanted` says so.
    fn flip(
        &mut self,
        [a, b]: [u32; 2],
        solid: u32,
        along: Option<DVec3>,
        wanted: impl Fn(&Self, &Around) -> bool,
    ) -> Option<[u32; 2]> {
        if self.is_fixed(a, b, solid) {
            return None;
        }
        let around = self.around([a, b], solid, along)?;
        let ([t, u], [a, b, c, d]) = (around.facets, around.corners);
        let [fa, fb, fc, fd] = around.flat;
        let is_convex = orient2d(fa, fd, fc) > 0.0 && orient2d(fd, fb, fc) > 0.0;
        if c == d || !is_convex || self.side(c, d, solid).is_some() || !wanted(self, &around) {
            return None;
        }
        self.sides.remove(&[a, b, solid]);
        self.sides.remove(&[b, a, solid]);
        let [from, left] = [a, c].map(|v| self.corner(t, v));
        let [to, right] = [b, d].map(|v| self.corner(u, v));
        self.put(t, [from, right, left]);
        self.put(u, [right, to, left]);
        let normal = self.normal[t as usize] + self.normal[u as usize];
        for t in [t, u] {
            self.normal[t as usize] = normal.normalize_or_zero();
        }
        Some([c, d])
    }

    /// Flips edges, and those around them, as long as that is wanted.
    fn legalize(
        &mut self,
        mut edges: Vec<[u32; 2]>,
        solid: u32,
        wanted: impl Fn(&Self, &Around) -> bool,
    ) {
        for _ in 0..STEPS {
            let Some(edge) = edges.pop() else {
                return;
            };
            if let Some([c, d]) = self.flip(edge, solid, None, &wanted) {
                let [a, b] = edge;
                edges.extend([[a, d], [d, b], [b, c], [c, a]]);
            }
        }
    }

    /// Makes an edge of a solid between two of its vertices, which stays; whether that was possible.
    pub fn recover(&mut self, a: u32, b: u32, solid: u32) -> bool {
        if self.side(a, b, solid).is_none() {
            let Some((crossed, normal)) = self.crossed(a, b, solid) else {
                return false;
            };
            self.flip_away(crossed, [a, b], solid, normal);
            if self.side(a, b, solid).is_none() {
                return false;
            }
        }
        self.fix(a, b, solid);
        true
    }

    /// The edges between two vertices, in order, and a direction in which they are seen; `None` where one of them stays.
    fn crossed(&self, a: u32, b: u32, solid: u32) -> Option<(Vec<[u32; 2]>, DVec3)> {
        if !(self.has(a, solid) && self.has(b, solid)) {
            return None;
        }
        let (from, to) = (self.place(a), self.place(b));
        let along = (to - from).normalize_or_zero();
        let mut first: Option<(f64, u32)> = None;
        for t in self.fan(a, solid) {
            let normal = self.normal[t as usize];
            let corners = self.corners[t as usize];
            let i = corners.iter().position(|&v| v == a)?;
            let [p, q] = [1, 2].map(|k| self.place(corners[(i + k) % 3]) - from);
            let within = p.cross(along).dot(normal) >= 0.0 && along.cross(q).dot(normal) >= 0.0;
            let steep = along.dot(normal).abs();
            if within && normal != DVec3::ZERO && first.is_none_or(|f| steep < f.0) {
                first = Some((steep, t));
            }
        }
        let (_, mut t) = first?;
        let normal = self.normal[t as usize];
        let sideways = normal.cross(along);
        let left = |v: u32| (self.place(v) - from).dot(sideways) > 0.0;
        let corners = self.corners[t as usize];
        let i = corners.iter().position(|&v| v == a)?;
        let mut edge = [corners[(i + 1) % 3], corners[(i + 2) % 3]];
        let mut crossed = Vec::new();
        for _ in 0..STEPS {
            if self.is_fixed(edge[0], edge[1], solid) {
                return None;
            }
            crossed.push(edge);
            t = self.side(edge[1], edge[0], solid)?;
            let apex = self.apex(t, edge[0], edge[1])?;
            if apex == b {
                return Some((crossed, normal));
            }
            edge = if left(apex) {
                [edge[0], apex]
            } else {
                [apex, edge[1]]
            };
        }
        None
    }

    /// The facets of a solid around a vertex, as far as they follow each other.
    fn fan(&self, v: u32, solid: u32) -> Vec<u32> {
        let Some(&first) = self.at.get(&[v, solid]) else {
            return Vec::new();
        };
        let mut fan = vec![first];
        while fan.len() < STEPS {
            let corners = self.corners[fan[fan.len() - 1] as usize];
            let i = corners.iter().position(|&c| c == v).unwrap_or(0);
            match self.side(v, corners[(i + 2) % 3], solid) {
                Some(next) if next != first => fan.push(next),
                _ => break,
            }
        }
        fan
    }

    /// Flips edges that cross the line between two vertices until none does.
    fn flip_away(&mut self, crossed: Vec<[u32; 2]>, [a, b]: [u32; 2], solid: u32, normal: DVec3) {
        let sideways = normal.cross(self.place(b) - self.place(a));
        let mut queue = VecDeque::from(crossed);
        for _ in 0..STEPS {
            let Some(edge) = queue.pop_front() else { break };
            let Some([c, d]) = self.flip(edge, solid, Some(normal), |_, _| true) else {
                queue.push_back(edge);
                continue;
            };
            let side = |v: u32| (self.place(v) - self.place(a)).dot(sideways);
            let is_end = [c, d].iter().any(|v| [a, b].contains(v));
            if !is_end && (side(c) > 0.0) != (side(d) > 0.0) {
                queue.push_back([c, d]);
            }
        }
    }
}

fn coord(frame: &Frame, p: DVec3) -> Coord<f64> {
    let p = frame.project(p);
    Coord { x: p.x, y: p.y }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two facets of a square, of something flat.
    fn square(t: u32) -> Behind {
        Behind {
            stays: [t == 0, true, t == 1],
            normals: [DVec3::Z; 3],
            sagitta: 0.1,
        }
    }

    /// Vertices on an edge, of which one is said to be in the facet on its left and the next one in that on its right.
    #[test]
    fn edges_are_divided_from_both_sides() {
        let mut points: Vec<DVec3> = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]
            .map(|[x, y]| DVec3::new(x, y, 0.0))
            .to_vec();
        points.extend([1.0, 3.0, 2.0, 0.5].map(|x| DVec3::new(x, x, 0.0)));
        let mut skin = Skin::new(points, vec![[0, 1, 2], [0, 2, 3]], vec![0; 2], square);
        let added: Vec<[u32; 2]> = (4..8).map(|v| [v, 0]).collect();
        for (v, facet) in (4..8).zip([0, 1, 1, 0]) {
            assert!(skin.insert(v, facet, 1e-12), "vertex {v}");
        }
        skin.settle(&added, 1e-12);
        for corners in &skin.corners {
            let [a, b, c] = corners.map(|v| skin.place(v));
            assert!((b - a).cross(c - a).z > 0.0, "{corners:?}");
        }
        assert_eq!(skin.corners.len(), 10);
    }

    /// A square of two facets with vertices in two rows across the diagonal.
    #[test]
    fn edges_are_recovered_across_others() {
        let place = |x: f64, y: f64| DVec3::new(x, y, 0.1 * x * (4.0 - x));
        let mut points = vec![
            place(0.0, 0.0),
            place(4.0, 0.0),
            place(4.0, 4.0),
            place(0.0, 4.0),
        ];
        let rows = [1.0, 2.0, 3.0].map(|x| [place(x, 1.5), place(x, 2.5)]);
        points.extend(rows.as_flattened());
        points.extend([place(0.5, 2.0), place(3.5, 2.1)]);
        let mut skin = Skin::new(points, vec![[0, 1, 2], [0, 2, 3]], vec![0; 2], square);
        let facet = |p: DVec3| u32::from(p.y > p.x);
        for v in 4..12 {
            assert!(skin.insert(v, facet(skin.place(v)), 1e-9), "vertex {v}");
        }
        assert!(!skin.insert(4, 0, 1e-9), "it is there");
        assert!(skin.recover(10, 11, 0));
        skin.settle(&[[10, 0], [11, 0]], 1e-9);
        assert!(skin.side(10, 11, 0).is_some() && skin.side(11, 10, 0).is_some());
        assert!(!skin.recover(0, 99, 0), "no such vertex");
        let seen = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| skin.place(v).truncate());
            0.5 * (b - a).perp_dot(c - a)
        };
        let areas: Vec<f64> = skin.corners.iter().map(seen).collect();
        assert!(areas.iter().all(|&area| area > 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - 16.0).abs() < 1e-12);
        assert_eq!(areas.len(), 18);
    }
}
