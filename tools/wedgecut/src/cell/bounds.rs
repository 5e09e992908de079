//! The faces together: where points lie, and where segments cross them.
//!
//! Each point is classified once against every face, moved onto the faces it counts as lying on, and its class is
//! kept; nothing asks again with another tolerance.

use super::class::{Class, sign};
use super::face::{Face, Role, Shape};
use super::join::Join;
use crate::graph::{Graph, samples};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The faces that bound a wedge, and how they are joined.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The faces: those through the axis, the hub's, the one across the axis.
    pub faces: Vec<Face>,
    /// Which parts of them are images of which.
    pub joins: Vec<Join>,
    /// Distance up to which a point counts as on a face, model units.
    tolerance: f64,
    /// The same of the axis.
    axis: f64,
    /// By what the points have been straightened, where the seam is no plane.
    graph: Option<Arc<Graph>>,
}

impl Cell {
    /// The cell of faces and joins, with the distances (model units) up to which points count as on a face and on
    /// the axis.
    pub fn new(faces: Vec<Face>, joins: Vec<Join>, tolerance: f64, axis: f64) -> Self {
        Self {
            faces,
            joins,
            tolerance,
            axis: axis.max(tolerance),
            graph: None,
        }
    }

    /// The same for points that have been straightened by a graph.
    pub fn straightened(self, graph: Option<Arc<Graph>>) -> Self {
        Self { graph, ..self }
    }

    /// Whether points have been straightened.
    pub fn is_straightened(&self) -> bool {
        self.graph.is_some()
    }

    /// The point at a share of the way from one point of the body to another.
    pub fn between(&self, p: DVec3, q: DVec3, at: f64) -> DVec3 {
        match &self.graph {
            None => p + (q - p) * at,
            Some(graph) => graph.straighten(graph.bend(p).lerp(graph.bend(q), at)),
        }
    }

    /// How far places on the way between two points of a cutting face, as `there` gives it, are from the line between
    /// them once they are bent back, in parts of the line's length.
    pub fn bulge(&self, at: impl Fn(f64) -> DVec3) -> f64 {
        let Some(graph) = &self.graph else { return 0.0 };
        let at = |s: f64| graph.bend(at(s));
        let [p, q] = [0.0, 1.0].map(at);
        let off = samples().map(|s| at(s).distance(p.lerp(q, s)));
        off.fold(0.0, f64::max) / p.distance(q)
    }

    /// Where on a way, from 0 to 1, it passes a crease of the seam.
    pub fn crease(&self, at: impl Fn(f64) -> DVec3) -> Option<f64> {
        self.graph.as_ref()?.crease(at)
    }

    /// Where on the way between two points of opposite classes a face is crossed, given their distances from it.
    fn root(&self, face: usize, [p, q]: [DVec3; 2], [dp, dq]: [f64; 2]) -> f64 {
        let straight = dp / (dp - dq);
        if self.graph.is_none() {
            return straight;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..f64::MANTISSA_DIGITS {
            let middle = 0.5 * (low + high);
            let d = self.faces[face].distance(self.between(p, q, middle));
            match (d > 0.0) == (dp > 0.0) {
                true => low = middle,
                false => high = middle,
            }
        }
        0.5 * (low + high)
    }

    /// The faces that satisfy a condition, by index.
    pub fn which(&self, is: impl Fn(&Face) -> bool) -> impl Iterator<Item = usize> {
        let faces = self.faces.iter().enumerate();
        faces.filter(move |(_, f)| is(f)).map(|(i, _)| i)
    }

    /// Faces to clip at, in order. What a plane across the axis takes away needs no other cuts.
    pub fn clips(&self) -> Vec<usize> {
        let wall = |f: &Face| f.role == Role::Wall;
        let across = self.which(|f| wall(f) && f.shape == Shape::Across);
        let others = self.which(|f| wall(f) && f.shape != Shape::Across);
        across.chain(others).collect()
    }

    /// The hub's face.
    pub fn hub(&self) -> Option<usize> {
        self.which(|f| f.role == Role::Hub).next()
    }

    /// The face across the axis, whether the cell ends there or other faces are divided.
    fn level(&self) -> Option<usize> {
        self.which(|f| f.shape == Shape::Across).next()
    }

    /// The other face that begins at the axis.
    fn other_radial(&self, face: usize) -> Option<usize> {
        self.which(Face::is_radial).find(|&g| g != face)
    }

    /// Signed distance of a point of the given class from a face, model units; exactly zero for points on it.
    pub fn distance(&self, face: usize, p: DVec3, class: Class) -> f64 {
        match class.of(face) {
            0 => 0.0,
            _ => self.faces[face].distance(p),
        }
    }

    /// Classifies a point and moves it onto the faces it counts as lying on.
    pub fn classify(&self, p: DVec3) -> (DVec3, Class) {
        let mut class = Class::INSIDE;
        if p.x.hypot(p.y) <= self.axis {
            class = self.put_on_axis(class);
        } else {
            let radial: Vec<(usize, f64)> = (self.which(Face::is_radial))
                .map(|f| (f, self.faces[f].distance(p)))
                .collect();
            for &(f, distance) in &radial {
                class = class.with(f, sign(distance));
            }
            let nearest =
                radial
                    .iter()
                    .copied()
                    .reduce(|near, other| match other.1.abs() < near.1.abs() {
                        true => other,
                        false => near,
                    });
            if let Some((f, distance)) = nearest
                && distance.abs() <= self.tolerance
            {
                class = self.put_on_radial(f, p, class, true);
            }
        }
        let class = self.with_others(p, class);
        (self.settle(p, class), class)
    }

    /// The class of a point near the axis with respect to the faces that begin there.
    fn put_on_axis(&self, class: Class) -> Class {
        let radial = self.which(Face::is_radial);
        radial.fold(class.on_axis(), |class, f| class.with(f, 0))
    }

    /// The class of a point near a face that begins at the axis; if `open`, points may lie beyond the other one.
    fn put_on_radial(&self, face: usize, p: DVec3, class: Class, open: bool) -> Class {
        let r = self.faces[face].coordinates(p).x;
        let other = self.other_radial(face);
        if r.abs() <= self.tolerance {
            return self.put_on_axis(class);
        }
        let class = class.with(face, 0);
        match other {
            Some(other) if open => class.with(other, sign(r)),
            _ => class,
        }
    }

    /// The class with the signs for the hub's face and the one across the axis.
    fn with_others(&self, p: DVec3, mut class: Class) -> Class {
        for face in self.hub().into_iter().chain(self.level()) {
            class = class.with(face, self.sign(face, p));
        }
        class
    }

    fn sign(&self, face: usize, p: DVec3) -> i8 {
        let distance = self.faces[face].distance(p);
        match distance.abs() <= self.tolerance {
            true => 0,
            false => sign(distance),
        }
    }

    /// Moves a point onto all faces that its class has it on.
    pub fn settle(&self, p: DVec3, class: Class) -> DVec3 {
        let is_on = |f: &usize| class.of(*f) == 0;
        let z = if self.level().is_some_and(|f| is_on(&f)) {
            0.0
        } else {
            p.z
        };
        if class.is_axis() {
            return DVec3::new(0.0, 0.0, z);
        }
        let radial = self
            .which(Face::is_radial)
            .find(is_on)
            .map(|f| &self.faces[f]);
        let hub = self.hub().filter(is_on).map(|f| &self.faces[f]);
        let Some(Shape::Chord { normal, distance }) = hub.map(|f| f.shape) else {
            return match radial {
                Some(face) => face.at(DVec2::new(face.coordinates(p).x, z)),
                None => DVec3::new(p.x, p.y, z),
            };
        };
        match radial.map(|face| (face, face.shape)) {
            // Exactly in the plane; on the other side up to rounding, as all points there.
            Some((_, Shape::Radial { cos, sin })) if normal == DVec3::X => {
                DVec3::new(distance, distance * (sin / cos), z)
            }
            // Half the angle of the wedge is between its sides and the normal.
            Some((face, _)) => face.at(DVec2::new(distance / normal.x, z)),
            None if normal == DVec3::X => DVec3::new(distance, p.y, z),
            None => {
                let offset = normal.x * p.x + normal.y * p.y - distance;
                let q = p - normal * offset;
                DVec3::new(q.x, q.y, z)
            }
        }
    }

    /// The crossing of the segment `p q` with a face, where the ends have opposite classes. `done`: bits of the
    /// faces that the surface has been cut at.
    ///
    /// The result does not depend on the order of the ends, and points that share x and y with
    /// others give crossings that do so, to the bit: vertical faces stay vertical.
    pub fn crossing(
        &self,
        face: usize,
        p: (DVec3, Class),
        q: (DVec3, Class),
        done: u8,
    ) -> (DVec3, Class) {
        let ordered = |u: DVec3, v: DVec3| {
            (u.x, u.y, u.z).partial_cmp(&(v.x, v.y, v.z)) != Some(std::cmp::Ordering::Greater)
        };
        let (p, q) = if ordered(p.0, q.0) { (p, q) } else { (q, p) };
        let (dp, dq) = (self.distance(face, p.0, p.1), self.distance(face, q.0, q.1));
        let x = self.between(p.0, q.0, self.root(face, [p.0, q.0], [dp, dq]));
        self.on_face(face, x, [p.1, q.1], done)
    }

    /// A point on an edge of a triangle and on two faces that meet along the axis, moved along these until it is in the triangle's plane
    /// once it is bent back. The edges of a cut are no part of a bent face, but chords of it: what was on one has left the
    /// triangle when it was moved onto both faces. Where the faces pass along the triangle, the point stays.
    pub fn back_in_plane(&self, x: DVec3, class: Class, triangle: [DVec3; 3]) -> DVec3 {
        let (Some(graph), Some(hub)) = (&self.graph, self.hub()) else {
            return x;
        };
        let is_radial = self.which(Face::is_radial).any(|f| class.of(f) == 0);
        let is_level = self.level().is_some_and(|f| class.of(f) == 0);
        if class.is_axis() || class.of(hub) != 0 || !is_radial || is_level {
            return x;
        }
        let [a, b, c] = triangle.map(|p| graph.bend(p));
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let at = |z: f64| DVec3::new(x.x, x.y, z);
        let off = |z: f64| (graph.bend(at(z)) - a).dot(normal);
        let most = a.distance(b);
        // Of the secants of a function that is nearly linear, each doubles the digits.
        let (mut z, mut last) = (x.z, off(x.z));
        let mut step = last.abs();
        for _ in 0..f64::MANTISSA_DIGITS {
            let slope = (off(z + step) - last) / step;
            let next = z - last / slope;
            let is_near = (next - x.z).abs() <= most;
            let value = off(next);
            if !is_near || value.is_nan() || value.abs() >= last.abs() {
                break;
            }
            step = (next - z).abs();
            (z, last) = (next, value);
        }
        at(z)
    }

    /// Whether a segment passes the line at which a face is divided, both ends beside it on the face.
    pub fn passes_fold(&self, face: usize, p: (DVec3, Class), q: (DVec3, Class)) -> bool {
        let Some(i) = self.faces[face].divided else {
            return false;
        };
        let is_on = p.1.of(face) == 0 && q.1.of(face) == 0;
        is_on && {
            let [a, b] = [p.0, q.0].map(|p| self.faces[face].coordinates(p)[i]);
            a.min(b) < 0.0 && a.max(b) > 0.0
        }
    }

    /// Whether a point lies on the line, other than the axis, at which a face is divided.
    pub fn is_on_fold(&self, face: usize, class: Class) -> bool {
        let fold = self.which(|f| f.role == Role::Fold).next();
        let is_divided = self.faces[face].divided == Some(1);
        is_divided && class.of(face) == 0 && fold.is_some_and(|f| class.of(f) == 0)
    }

    /// Where a segment that [`Cell::passes_fold`] passes the line.
    pub fn fold_crossing(
        &self,
        face: usize,
        p: (DVec3, Class),
        q: (DVec3, Class),
        done: u8,
    ) -> (DVec3, Class) {
        let chart = &self.faces[face];
        let i = chart.divided.unwrap_or(0);
        let [a, b] = [p.0, q.0].map(|p| chart.coordinates(p));
        let (a, b) = if a[i] < b[i] { (a, b) } else { (b, a) };
        let mut at = a + (b - a) * (a[i] / (a[i] - b[i]));
        at[i] = 0.0;
        self.on_face(face, chart.at(at), [p.1, q.1], done)
    }

    /// A new point on a face between two others: on the faces cut before that both are on, on the others if it is
    /// near them.
    fn on_face(&self, face: usize, x: DVec3, ends: [Class; 2], done: u8) -> (DVec3, Class) {
        if self.faces[face].shape == Shape::Across {
            return self.classify(DVec3::new(x.x, x.y, 0.0));
        }
        let is_done = |f: usize| done & 1 << f != 0;
        let mut class = ends[0].between(ends[1]).with(face, 0);
        if self.faces[face].is_radial() {
            let other = self.other_radial(face);
            class = match other {
                Some(other) if ends.iter().all(|c| c.of(other) == 0) => self.put_on_axis(class),
                _ => self.put_on_radial(face, x, class, !other.is_some_and(is_done)),
            };
        }
        for other in self.hub().into_iter().chain(self.level()) {
            if other != face && !is_done(other) {
                class = class.with(other, self.sign(other, x));
            }
        }
        (self.settle(x, class), class)
    }

    /// The class of a point of an edge of a face, moved onto it.
    pub fn on_edge(&self, x: DVec3, ends: [Class; 2]) -> (DVec3, Class) {
        let class = ends[0].between(ends[1]);
        (self.settle(x, class), class)
    }

    /// Points where three of the faces meet, or two and the axis where a face is divided: caps need them where
    /// they are inside of the body.
    pub fn corners(&self) -> Vec<(DVec3, Class)> {
        let Some(level) = self.level() else {
            return Vec::new();
        };
        let radial: Vec<usize> = self.which(Face::is_radial).collect();
        let at_axis = radial.len() > 1 || radial.iter().any(|&f| self.faces[f].divided == Some(0));
        let mut found = Vec::new();
        if at_axis {
            found.push(self.classify(DVec3::ZERO));
        }
        if let Some(hub) = self.hub() {
            for f in radial {
                let class = Class::INSIDE.with(f, 0).with(hub, 0).with(level, 0);
                found.push((self.settle(DVec3::ZERO, class), class));
            }
        }
        found
    }
}
