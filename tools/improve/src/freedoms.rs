//! Where the vertices of a template may be moved to without changing the shape, its facets, or a wall.

use crate::flats::Flats;
use crate::freedom::{Exact, Freedom};
use crate::shape::Shape;
use crate::slide::sliding;
use crate::surface::{Sheet, Surface};
use geom::edges::Edges;
use geom::measure::{Areas, double_area_vector};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;
use tmesh::{FixedSet, Gluing, Isometry, Template};

/// The freedom of all vertices of a template.
#[derive(Clone)]
pub struct Freedoms {
    of_vertex: Vec<Freedom>,
    exact: FxHashMap<u32, Exact>,
    /// Master of a vertex that is an image.
    master_of: FxHashMap<u32, u32>,
    /// Image of a master, with the step that takes one to the other.
    image_of: FxHashMap<u32, (u32, Isometry)>,
    /// Where edges of the surface may be replaced.
    surface: Surface,
    /// The shape that vertices move along.
    shape: Option<Arc<dyn Shape>>,
    /// Mirror planes, which no such vertex passes.
    mirrors: Vec<FixedSet>,
}

/// Of a plane and a line in it, the sine of the angle between them is below this: normals are those of the largest triangle of
/// a facet and good to more digits, and real edges are at an angle of degrees.
const ALONG: f64 = 1e-6;

/// Whether a seam is in a plane, wherever that is: both of its faces are then to stay in theirs.
fn is_flat(template: &Template, gluing: &Gluing, distance: f64) -> bool {
    let mut areas = Areas::default();
    for [t, _] in &gluing.triangle_pairs {
        let triangle = &template.triangles[*t as usize];
        areas.add(triangle.vertices.map(|v| template.vertices[v as usize]));
    }
    areas.is_flat(distance)
}

impl Freedoms {
    /// Finds what each vertex of a filled template, number `own`, may do. Linear.
    pub fn new((template, own): (&Template, usize), flats: &Flats<'_>) -> Self {
        let mut freedoms = Self {
            of_vertex: surface(template, flats),
            exact: FxHashMap::default(),
            master_of: FxHashMap::default(),
            image_of: FxHashMap::default(),
            surface: Surface::new((template, own), flats),
            shape: flats.curved.as_ref().map(|curved| curved.shape.clone()),
            mirrors: Vec::new(),
        };
        for (v, freedom) in sliding((template, own), flats) {
            freedoms.of_vertex[v as usize] = freedom;
        }
        flats.fixed.iter().for_each(|&v| freedoms.fix(v));
        for gluing in &template.gluings {
            if gluing.is_mirror(own) {
                freedoms.mirrors.push(FixedSet::of(gluing.step));
            }
            if gluing.other_than(own).is_some() {
                gluing.vertices_here().for_each(|v| freedoms.fix(v));
                continue;
            }
            // Only a master face that is flat lies in the plane that convention has it in.
            let plane = FixedSet::of_master(gluing.step);
            let is_on = |v: u32| {
                let p = template.vertices[v as usize];
                plane.nearest(p).distance(p) <= flats.straight
            };
            let plane = gluing.vertices_there().all(is_on).then_some(plane);
            if !is_flat(template, gluing, flats.straight) {
                freedoms.free_inside(template, gluing);
            }
            for &[here, there] in &gluing.vertex_pairs {
                if here == there {
                    freedoms.keep_on(here, FixedSet::of(gluing.step));
                } else {
                    freedoms.pair(there, here, gluing.step, plane);
                }
            }
        }
        for &v in &template.axis {
            freedoms.exact.entry(v).or_default().axis = true;
            let freedom = &mut freedoms.of_vertex[v as usize];
            if !matches!(freedom, Freedom::Line(d) if d.x.hypot(d.y) <= ALONG) {
                *freedom = Freedom::Fixed;
            }
        }
        freedoms
    }

    /// Vertices inside of a seam that is not flat may go anywhere: it is any surface between its borders. But where the regions on its
    /// two sides differ, as those of parts do that the rotation exchanges, each keeps its volume within the wedge.
    fn free_inside(&mut self, template: &Template, gluing: &Gluing) {
        let behind = |t: u32| {
            let t = &template.triangles[t as usize];
            t.front.min(t.back)
        };
        let alike = gluing.triangle_pairs.iter();
        let alike = alike.filter(|[here, there]| behind(*here) == behind(*there));
        let own: FxHashSet<u32> = alike.flatten().copied().collect();
        let others = (0_u32..).zip(&template.triangles);
        let others = others.filter(|(t, _)| !own.contains(t));
        let rim: FxHashSet<u32> = others.flat_map(|(_, t)| t.vertices).collect();
        for &[here, there] in &gluing.vertex_pairs {
            if here != there && !rim.contains(&here) && !rim.contains(&there) {
                for v in [here, there] {
                    self.of_vertex[v as usize] = Freedom::Free;
                }
            }
        }
    }

    fn fix(&mut self, v: u32) {
        self.of_vertex[v as usize] = Freedom::Fixed;
    }

    /// Keeps a vertex that is its own image on what the step leaves where it is.
    fn keep_on(&mut self, v: u32, set: FixedSet) {
        // A curved face that touches a wall there, and nowhere around, leaves no direction along both.
        if matches!(self.of(v), Freedom::Along(..)) {
            self.fix(v);
        }
        let exact = self.exact.entry(v).or_default();
        match set {
            FixedSet::All => {}
            FixedSet::Horizontal => exact.level = true,
            FixedSet::Vertical { .. } => exact.vertical = Some(set),
            FixedSet::Axis => exact.axis = true,
            FixedSet::Radial { cos, sin } => {
                exact.level = true;
                exact.vertical = Some(FixedSet::Vertical { cos, sin });
                let along = DVec3::new(cos, sin, 0.0);
                let freedom = &mut self.of_vertex[v as usize];
                if !matches!(freedom, Freedom::Line(d) if d.cross(along).length() <= ALONG) {
                    *freedom = Freedom::Fixed;
                }
            }
            FixedSet::Origin => self.fix(v),
        }
    }

    /// Has a vertex and its image move as one, if both may move alike and neither has another partner; the first within
    /// the plane of its face, if that is given.
    fn pair(&mut self, master: u32, image: u32, step: Isometry, plane: Option<FixedSet>) {
        let vertical = &mut self.exact.entry(master).or_default().vertical;
        *vertical = plane.or(*vertical);
        let once = self.image_of.insert(master, (image, step)).is_none()
            && self.master_of.insert(image, master).is_none();
        if !(once && alike(&self.of_vertex, master, image, step)) {
            self.fix(master);
        }
        self.fix(image);
    }

    /// The surface, and where edges of it may be replaced.
    pub fn take_surface(&mut self) -> Surface {
        std::mem::take(&mut self.surface)
    }

    /// The vertex to move for `v` to move: the master for its image.
    pub fn mover(&self, v: u32) -> u32 {
        self.master_of.get(&v).copied().unwrap_or(v)
    }

    /// Freedom of a vertex, of the master if it has a partner. Vertices that have come since are inside.
    pub fn of(&self, v: u32) -> Freedom {
        let known = self.of_vertex.get(v as usize);
        known.copied().unwrap_or(Freedom::Free)
    }

    /// The vertex that moves with `v`, and by which step.
    pub fn partner(&self, v: u32) -> Option<(u32, Isometry)> {
        self.image_of.get(&v).copied()
    }

    /// The nearest place to `p` that is exactly on what `v` belongs to.
    pub fn place(&self, v: u32, p: DVec3) -> DVec3 {
        if let (Freedom::Along(patch, _), Some(shape)) = (self.of(v), &self.shape) {
            return shape.nearest(patch, p).map_or(p, |found| found.0);
        }
        self.exact.get(&v).map_or(p, |exact| exact.place(p))
    }

    /// Whether a vertex may go from one place to another: whether it stays on its side of mirror planes if it moves along a shape, and the shape holds
    /// the triangles of the surface that stand for patches of it, given with these from the vertex on as they are then.
    pub fn holds(
        &self,
        v: u32,
        [from, to]: [DVec3; 2],
        mut faces: impl Iterator<Item = (u32, [DVec3; 3])>,
    ) -> bool {
        let Some(shape) = &self.shape else {
            return true;
        };
        let stays = |mirror: &FixedSet| {
            let [before, after] = [from, to].map(|p| p - mirror.nearest(p));
            before.dot(after) > 0.0
        };
        let is_along = matches!(self.of(v), Freedom::Along(..));
        (!is_along || self.mirrors.iter().all(stays))
            && faces.all(|(patch, corners)| shape.holds(patch, corners))
    }

    /// What a vertex inside of a patch of the shape may do.
    pub fn along(&self, patch: u32, p: DVec3) -> Option<Freedom> {
        let (_, normal) = self.shape.as_ref()?.nearest(patch, p)?;
        Some(Freedom::Along(patch, normal.any_orthonormal_pair().into()))
    }

    /// What a vertex in a patch of the surface may do, and what it must keep: what all corners of a triangle there keep.
    pub fn within(&self, sheet: &Sheet, at: impl Fn(u32) -> DVec3) -> (Freedom, Exact) {
        let normal = sheet.normal.unwrap_or_else(|| {
            let [a, b, c] = sheet.corners.map(at);
            double_area_vector(a, b, c).normalize_or_zero()
        });
        let freedom = match normal {
            DVec3::ZERO => Freedom::Fixed,
            normal => {
                let (a, b) = normal.any_orthonormal_pair();
                Freedom::Plane(a, b)
            }
        };
        (freedom, self.common(&sheet.corners))
    }

    /// What a vertex between others must keep: what all of them keep.
    pub fn common(&self, vertices: &[u32]) -> Exact {
        let of = |v: &u32| self.exact.get(v).copied().unwrap_or_default();
        let vertical = vertices.first().and_then(|v| of(v).vertical);
        Exact {
            vertical: vertical.filter(|_| vertices.iter().all(|v| of(v).vertical == vertical)),
            level: vertices.iter().all(|v| of(v).level),
            axis: false,
        }
    }

    /// Whether a vertex is on the axis.
    pub fn is_on_axis(&self, v: u32) -> bool {
        self.exact.get(&v).is_some_and(|exact| exact.axis)
    }

    /// Notes what a new vertex may do.
    pub fn add(&mut self, v: u32, freedom: Freedom, exact: Exact) {
        self.of_vertex.resize(v as usize, Freedom::Free);
        self.of_vertex.push(freedom);
        self.exact.insert(v, exact);
    }
}

/// Whether two partners have the same freedom.
fn alike(of_vertex: &[Freedom], master: u32, image: u32, step: Isometry) -> bool {
    match [master, image].map(|v| of_vertex[v as usize]) {
        [Freedom::Line(a), Freedom::Line(b)] => step.apply(a).cross(b).length() <= ALONG,
        [Freedom::Plane(..), Freedom::Plane(..)] | [Freedom::Free, Freedom::Free] => true,
        _ => false,
    }
}

/// Freedom as the surface's facets have it.
fn surface(template: &Template, flats: &Flats<'_>) -> Vec<Freedom> {
    let mut of_vertex = vec![Freedom::Free; template.vertices.len()];
    let corners: Vec<[u32; 3]> = template.triangles.iter().map(|t| t.vertices).collect();
    let edges = Edges::new(&corners);
    // Other ends of the feature edges at each vertex: two can be straight, more can not.
    let mut ends: FxHashMap<u32, (u32, [u32; 2])> = FxHashMap::default();
    for (e, &[a, b]) in edges.ends.iter().enumerate() {
        let facet = |t: u32| flats.of_triangle[t as usize];
        let inside = matches!(edges.around(e), [s, t]
            if s.forward != t.forward && facet(s.triangle) == facet(t.triangle));
        if !inside {
            for (v, other) in [(a, b), (b, a)] {
                let (count, others) = ends.entry(v).or_default();
                if let Some(slot) = others.get_mut(*count as usize) {
                    *slot = other;
                }
                *count += 1;
            }
        }
    }
    for (t, &facet) in corners.iter().zip(flats.of_triangle) {
        let normal = flats.normals[facet as usize];
        let along = ALONG.max(flats.slopes[facet as usize]);
        for &v in t {
            let p = template.vertices[v as usize];
            let freedom = &mut of_vertex[v as usize];
            *freedom = match (*freedom, ends.get(&v)) {
                _ if normal == DVec3::ZERO => Freedom::Fixed,
                (Freedom::Free, None) => {
                    let (a, b) = normal.any_orthonormal_pair();
                    Freedom::Plane(a, b)
                }
                (Freedom::Free, Some((2, others))) => {
                    let [a, b] = others.map(|o| template.vertices[o as usize]);
                    match straight(a, p, b, flats.straight) {
                        Some(d) if d.dot(normal).abs() <= along => Freedom::Line(d),
                        _ => Freedom::Fixed,
                    }
                }
                (Freedom::Line(d), Some(_)) if d.dot(normal).abs() <= along => Freedom::Line(d),
                (Freedom::Plane(a, b), None) if a.cross(b).dot(normal).abs() >= 1.0 - ALONG => {
                    Freedom::Plane(a, b)
                }
                _ => Freedom::Fixed,
            };
        }
    }
    of_vertex
}

/// The direction from `a` to `b` if `p` is between them.
fn straight(a: DVec3, p: DVec3, b: DVec3, tolerance: f64) -> Option<DVec3> {
    let direction = (b - a).try_normalize()?;
    let (before, after) = (p - a, b - p);
    let off = (before - direction * before.dot(direction)).length();
    let between = before.dot(direction) > 0.0 && after.dot(direction) > 0.0;
    (between && off <= tolerance).then_some(direction)
}
