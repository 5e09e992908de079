//! What is related: vertices, edges and triangles that lie at one place and have no vertex there in common.

use super::near::{Spot, crossing, piercing, spot};
use geom::contacts::contact;
use geom::edges::Edges;
use geom::sets::DisjointSets;
use geom::tree::{Search, pairs};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Triangles that may cross.
#[derive(Clone, Default)]
pub struct Complex {
    /// Places.
    pub points: Vec<DVec3>,
    /// Three different points each.
    pub triangles: Vec<[u32; 3]>,
    /// The triangle of the file that each one is a part of.
    pub source: Vec<u32>,
}

impl Complex {
    /// Positions of a triangle's corners.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.points[v as usize])
    }
}

/// What is related to what.
pub struct Relations {
    /// Vertices that are one.
    pub same: DisjointSets,
    /// Of each edge: the vertices on it, and how far along.
    pub on_edge: FxHashMap<u32, Vec<(f64, u32)>>,
    /// Of each triangle: the vertices in its interior.
    pub inside: FxHashMap<u32, Vec<u32>>,
    /// Pairs of triangles with a relation.
    pub pairs: Vec<[u32; 2]>,
    /// Whether the search came to an end.
    pub search: Search,
    /// The farthest that something is moved to what it is related to.
    pub largest: f64,
}

impl Relations {
    /// Whether nothing is related.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }
}

/// A pair of triangles in which to look for relations.
struct Finder<'a> {
    complex: &'a mut Complex,
    edges: &'a Edges,
    /// Of each triangle, the edges that begin at its corners.
    edge_of: Vec<[u32; 3]>,
    within: f64,
    found: Relations,
    /// Points made where edges cross.
    crossed: FxHashMap<[u32; 2], u32>,
    /// Points made where an edge passes through a triangle.
    pierced: FxHashMap<[u32; 2], u32>,
    set_on_edge: FxHashSet<[u32; 2]>,
    set_inside: FxHashSet<[u32; 2]>,
}

/// Finds what is related among pairs of triangles of which `is_new` accepts one. Points are added to the complex where
/// edges cross.
///
/// Of triangles of different solids, what lies within the distance is related. Of one solid, only what is at a place
/// where two triangles meet: what is thin is not closed.
pub fn relate(
    complex: &mut Complex,
    edges: &Edges,
    solid_of: impl Fn(u32) -> u32,
    within: f64,
    is_new: impl Fn(u32) -> bool,
) -> Relations {
    let mut near = Vec::new();
    let search = near_pairs(
        complex,
        within,
        |t| t,
        |s, t| {
            if is_new(s) || is_new(t) {
                near.push([s, t]);
            }
            true
        },
    );
    near.sort_unstable();
    let mut finder = Finder::new(complex, edges, within);
    finder.found.search = search;
    for [s, t] in near {
        finder.pair(s, t, solid_of(s) == solid_of(t));
    }
    finder.found
}

/// Whether triangles of different solids are related.
pub fn is_related(
    complex: &mut Complex,
    edges: &Edges,
    solid_of: impl Fn(u32) -> u32,
    within: f64,
) -> bool {
    let mut near = Vec::new();
    near_pairs(complex, within, &solid_of, |s, t| {
        near.push([s, t]);
        true
    });
    let mut finder = Finder::new(complex, edges, within);
    near.iter().any(|&[s, t]| {
        finder.pair(s, t, false);
        !finder.found.is_empty()
    })
}

/// Calls `visit` with the pairs of triangles of different groups that may be within a distance of each other, the lower
/// one first.
fn near_pairs(
    complex: &Complex,
    within: f64,
    group: impl Fn(u32) -> u32,
    mut visit: impl FnMut(u32, u32) -> bool,
) -> Search {
    let boxes: Vec<[DVec3; 2]> = (0..complex.triangles.len() as u32)
        .map(|t| {
            let [a, b, c] = complex.corners(t);
            [
                a.min(b).min(c) - 0.5 * within,
                a.max(b).max(c) + 0.5 * within,
            ]
        })
        .collect();
    pairs(boxes.into_iter(), group, |s, t| visit(s.min(t), s.max(t)))
}

impl<'a> Finder<'a> {
    fn new(complex: &'a mut Complex, edges: &'a Edges, within: f64) -> Self {
        let mut edge_of = vec![[0; 3]; complex.triangles.len()];
        for e in 0..edges.len() {
            for u in edges.around(e) {
                edge_of[u.triangle as usize][u.corner as usize] = e as u32;
            }
        }
        Self {
            found: Relations {
                same: DisjointSets::new(complex.points.len()),
                on_edge: FxHashMap::default(),
                inside: FxHashMap::default(),
                pairs: Vec::new(),
                search: Search::Done,
                largest: 0.0,
            },
            complex,
            edges,
            edge_of,
            within,
            crossed: FxHashMap::default(),
            pierced: FxHashMap::default(),
            set_on_edge: FxHashSet::default(),
            set_inside: FxHashSet::default(),
        }
    }

    fn pair(&mut self, s: u32, t: u32, alike: bool) {
        let [p, q] = [s, t].map(|t| self.complex.triangles[t as usize]);
        if p.iter().all(|v| q.contains(v)) {
            return;
        }
        if alike && contact(&self.complex.points, &p, &q).is_none() {
            return;
        }
        let mut any = false;
        // Both are always done.
        any |= self.vertices(p, t);
        any |= self.vertices(q, s);
        for i in 0..3 {
            for j in 0..3 {
                any |= self.edges(self.edge_of[s as usize][i], self.edge_of[t as usize][j]);
            }
        }
        for i in 0..3 {
            any |= self.pierce(self.edge_of[s as usize][i], t);
            any |= self.pierce(self.edge_of[t as usize][i], s);
        }
        if any {
            self.found.pairs.push([s, t]);
        }
    }

    /// Relates vertices to a triangle that does not have them.
    fn vertices(&mut self, of: [u32; 3], t: u32) -> bool {
        let corners = self.complex.triangles[t as usize];
        let places = self.complex.corners(t);
        let mut any = false;
        for v in of {
            if corners.contains(&v) {
                continue;
            }
            let p = self.complex.points[v as usize];
            let Some(spot) = spot(p, &places, self.within) else {
                continue;
            };
            any = true;
            match spot {
                Spot::Corner(i) => {
                    let w = corners[i];
                    self.moved(p.distance(places[i]));
                    self.found.same.join(v, w);
                }
                Spot::Edge(i, along) => {
                    let edge = self.edge_of[t as usize][i];
                    let [a, b] = [places[i], places[(i + 1) % 3]];
                    self.moved(p.distance(a + (b - a) * along));
                    let forward = self.edges.ends[edge as usize][0] == corners[i];
                    let along = if forward { along } else { 1.0 - along };
                    self.on_edge(edge, along, v);
                }
                Spot::Inside => {
                    if self.set_inside.insert([t, v]) {
                        self.found.inside.entry(t).or_default().push(v);
                    }
                }
            }
        }
        any
    }

    fn moved(&mut self, by: f64) {
        self.found.largest = self.found.largest.max(by);
    }

    fn on_edge(&mut self, edge: u32, along: f64, vertex: u32) {
        if self.set_on_edge.insert([edge, vertex]) {
            let on = self.found.on_edge.entry(edge).or_default();
            on.push((along, vertex));
        }
    }

    fn edges(&mut self, e: u32, f: u32) -> bool {
        let ends = [e, f].map(|e| self.edges.ends[e as usize]);
        if e == f || ends[0].iter().any(|v| ends[1].contains(v)) {
            return false;
        }
        let [p, q] = ends.map(|ends| ends.map(|v| self.complex.points[v as usize]));
        let Some([s, t]) = crossing(p, q, self.within) else {
            return false;
        };
        let key = [e.min(f), e.max(f)];
        if self.crossed.contains_key(&key) {
            return true;
        }
        let [x, y] = [p[0] + (p[1] - p[0]) * s, q[0] + (q[1] - q[0]) * t];
        self.moved(0.5 * x.distance(y));
        let new = self.add(0.5 * (x + y));
        self.crossed.insert(key, new);
        self.on_edge(e, s, new);
        self.on_edge(f, t, new);
        true
    }

    fn pierce(&mut self, e: u32, t: u32) -> bool {
        let ends = self.edges.ends[e as usize];
        if ends
            .iter()
            .any(|v| self.complex.triangles[t as usize].contains(v))
        {
            return false;
        }
        let p = ends.map(|v| self.complex.points[v as usize]);
        let corners = self.complex.corners(t);
        if p.iter().any(|&p| spot(p, &corners, self.within).is_some()) {
            return false;
        }
        let Some(along) = piercing(p, &corners, self.within) else {
            return false;
        };
        if !self.pierced.contains_key(&[e, t]) {
            let new = self.add(p[0] + (p[1] - p[0]) * along);
            self.pierced.insert([e, t], new);
            self.on_edge(e, along, new);
            if self.set_inside.insert([t, new]) {
                self.found.inside.entry(t).or_default().push(new);
            }
        }
        true
    }

    fn add(&mut self, place: DVec3) -> u32 {
        self.complex.points.push(place);
        self.complex.points.len() as u32 - 1
    }
}
