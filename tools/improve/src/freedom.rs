//! Where a vertex may be moved to without changing the shape, its facets, or a wall.

use geom::edges::Edges;
use glam::DVec3;
use rustc_hash::FxHashMap;
use tmesh::{FixedSet, Isometry, Template, Wall};

/// Directions in which a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Freedom {
    /// Corners, walls shared with other templates.
    Fixed,
    /// Along a straight edge where facets meet.
    Line(DVec3),
    /// Inside of a facet: two unit vectors along it.
    Plane(DVec3, DVec3),
    /// Not on the surface.
    Free,
}

impl Freedom {
    /// Orthogonal unit vectors, as many as there are.
    pub fn directions(&self) -> impl Iterator<Item = DVec3> + use<> {
        let (list, count) = match *self {
            Self::Fixed => ([DVec3::ZERO; 3], 0),
            Self::Line(a) => ([a, DVec3::ZERO, DVec3::ZERO], 1),
            Self::Plane(a, b) => ([a, b, DVec3::ZERO], 2),
            Self::Free => ([DVec3::X, DVec3::Y, DVec3::Z], 3),
        };
        list.into_iter().take(count)
    }
}

/// What a vertex of a wall or of the axis must keep to the last bit.
#[derive(Clone, Copy, Debug, Default)]
struct Exact {
    vertical: Option<FixedSet>,
    level: bool,
    axis: bool,
}

/// Facets of the surface of a filled template.
pub struct Flats<'a> {
    /// Facet of each surface triangle.
    pub of_triangle: &'a [u32],
    /// Unit normal of each facet; zero where it has none.
    pub normals: &'a [DVec3],
    /// Vertices that must stay where they are.
    pub fixed: &'a [u32],
    /// A vertex this far from the line between its neighbours is on it, model units.
    pub straight: f64,
}

/// The freedom of all vertices of a template.
pub struct Freedoms {
    of_vertex: Vec<Freedom>,
    exact: FxHashMap<u32, Exact>,
    /// Low vertex of a seam's high one.
    low_of: FxHashMap<u32, u32>,
    /// High vertex of a seam's low one, with the rotation that takes one to the other.
    high_of: FxHashMap<u32, (u32, Isometry)>,
}

/// Of a plane and a line in it, the sine of the angle between them is below this.
const ALONG: f64 = 1e-6;

impl Freedoms {
    /// Finds what each vertex of a filled template may do. Linear.
    pub fn new(template: &Template, flats: &Flats<'_>) -> Self {
        let mut of_vertex = surface(template, flats);
        let mut exact: FxHashMap<u32, Exact> = FxHashMap::default();
        let mut low_of = FxHashMap::default();
        let mut high_of = FxHashMap::default();
        let fix = |list: &mut [Freedom], v: u32| list[v as usize] = Freedom::Fixed;
        flats.fixed.iter().for_each(|&v| fix(&mut of_vertex, v));
        for wall in &template.walls {
            match wall {
                Wall::Mirror(mirror) => {
                    let projection = FixedSet::of(mirror.reflection);
                    for &v in &mirror.vertices {
                        let exact = exact.entry(v).or_default();
                        match projection {
                            FixedSet::Horizontal => exact.level = true,
                            _ => exact.vertical = Some(projection),
                        }
                    }
                }
                Wall::Hub(hub) => {
                    for &[v, _] in &hub.vertex_pairs {
                        fix(&mut of_vertex, v);
                    }
                }
                Wall::Seam(seam) => {
                    for &[low, high] in &seam.vertex_pairs {
                        if low == high {
                            continue;
                        }
                        exact.entry(low).or_default().vertical = Some(LOW);
                        let turned = (high, seam.rotation);
                        let once = high_of.insert(low, turned).is_none()
                            && low_of.insert(high, low).is_none();
                        let free = once && alike(&of_vertex, low, high, seam.rotation);
                        if !free {
                            fix(&mut of_vertex, low);
                        }
                        fix(&mut of_vertex, high);
                    }
                }
            }
        }
        for &v in &template.axis {
            exact.entry(v).or_default().axis = true;
            let freedom = &mut of_vertex[v as usize];
            if !matches!(freedom, Freedom::Line(d) if d.x.hypot(d.y) <= ALONG) {
                *freedom = Freedom::Fixed;
            }
        }
        Self {
            of_vertex,
            exact,
            low_of,
            high_of,
        }
    }

    /// The vertex to move for `v` to move: the low one of a seam for its high one.
    pub fn mover(&self, v: u32) -> u32 {
        self.low_of.get(&v).copied().unwrap_or(v)
    }

    /// Freedom of a vertex, the low one if it has a partner on a seam. Vertices that have come since are inside.
    pub fn of(&self, v: u32) -> Freedom {
        let known = self.of_vertex.get(v as usize);
        known.copied().unwrap_or(Freedom::Free)
    }

    /// The vertex that moves with `v`, and by which rotation.
    pub fn partner(&self, v: u32) -> Option<(u32, Isometry)> {
        self.high_of.get(&v).copied()
    }

    /// The nearest place to `p` that is exactly on what `v` belongs to.
    pub fn place(&self, v: u32, p: DVec3) -> DVec3 {
        let Some(exact) = self.exact.get(&v) else {
            return p;
        };
        let p = if exact.axis {
            DVec3::new(0.0, 0.0, p.z)
        } else {
            exact.vertical.map_or(p, |plane| plane.nearest(p))
        };
        if exact.level {
            DVec3::new(p.x, p.y, 0.0)
        } else {
            p
        }
    }
}

/// The plane of a seam's low face.
const LOW: FixedSet = FixedSet::Vertical { cos: 1.0, sin: 0.0 };

/// Whether two partners on a seam have the same freedom.
fn alike(of_vertex: &[Freedom], low: u32, high: u32, rotation: Isometry) -> bool {
    match [low, high].map(|v| of_vertex[v as usize]) {
        [Freedom::Line(a), Freedom::Line(b)] => rotation.apply(a).cross(b).length() <= ALONG,
        [Freedom::Plane(..), Freedom::Plane(..)] => true,
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
                        Some(d) if d.dot(normal).abs() <= ALONG => Freedom::Line(d),
                        _ => Freedom::Fixed,
                    }
                }
                (Freedom::Line(d), Some(_)) if d.dot(normal).abs() <= ALONG => Freedom::Line(d),
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
