//! What is related: vertices, edges and faces that lie at one place and have no vertex there in common.

use super::curves::Curves;
use super::faces::{Complex, Faces, Incidence};
use super::near::{Spot, crossing, crossing_along, is_beside, piercing, spot};
use geom::contacts::contact;
use geom::edges::Edges;
use geom::sets::DisjointSets;
use geom::tree::{Search, alignment, pairs, with_neighbours};
use glam::{DMat3, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};

/// What is related to what.
pub struct Relations {
    /// Vertices that are one.
    pub same: DisjointSets,
    /// Of each edge: the vertices on it, and how far along.
    pub on_edge: FxHashMap<u32, Vec<(f64, u32)>>,
    /// Of each face: the vertices in its interior.
    pub inside: FxHashMap<u32, Vec<u32>>,
    /// Pairs of faces with a relation, the lower one first.
    pub pairs: FxHashSet<[u32; 2]>,
    /// Whether the search came to an end.
    pub search: Search,
    /// The farthest that something is moved to what it is related to.
    pub largest: f64,
    /// Vertices that were moved to a feature, with all that is at them.
    pub shifted: FxHashSet<u32>,
}

impl Relations {
    /// Whether nothing is related.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }
}

/// Within what things are related.
#[derive(Clone, Copy)]
pub struct Reach<'a> {
    /// Distance within which all things are.
    pub equal: f64,
    /// What solids touch within the facets of curved faces.
    pub curves: Option<&'a Curves>,
}

impl Reach<'_> {
    fn of(&self, t: u32) -> f64 {
        let curved = self.curves.map_or(0.0, |c| c.reach(t));
        self.equal.max(curved)
    }
}

/// Finds what is related among pairs of triangles of which `is_new` accepts one. Points are added to the complex where
/// edges cross.
///
/// Of triangles of different solids, what lies within reach is related. Of one solid, only what is at a place where two
/// triangles meet: what is thin is not closed. The pairs of one solid that meet may be `known`.
pub fn relate(
    complex: &mut Complex,
    incidence: Incidence<'_>,
    solid_of: impl Fn(u32) -> u32,
    reach: Reach<'_>,
    (is_new, known): (impl Fn(u32) -> bool, Option<&[[u32; 2]]>),
) -> Relations {
    // What is not new is one group, and so is a solid within which everything is known: where there is nothing else,
    // nothing is looked at.
    let not_new = u32::MAX - 1;
    let group = |t: u32| match (is_new(t), known) {
        (false, _) => not_new,
        (true, Some(_)) => solid_of(t),
        (true, None) => complex.face[t as usize],
    };
    let face = |t: u32| complex.face[t as usize];
    let known = known.unwrap_or_default().iter().copied();
    let mut near: Vec<[u32; 2]> = known.filter(|&[s, t]| face(s) != face(t)).collect();
    let boxes = Aligned::of(complex, reach);
    let all: Vec<[DVec3; 2]> = (0..complex.triangles.len() as u32)
        .map(|t| boxes.of_triangle(t))
        .collect();
    let some = with_neighbours(&all, &is_new);
    let search = near_pairs(
        (&boxes, &some),
        group,
        |s, t| is_new(s) || is_new(t),
        |s, t| {
            let is_near = match solid_of(s) == solid_of(t) {
                true => meets(complex, s, t),
                false => !is_far(complex, s, t, reach),
            };
            if is_near {
                near.push([s, t]);
            }
        },
    );
    near.sort_unstable();
    let mut finder = Finder::new(complex, incidence, reach);
    finder.found.search = search;
    finder.run(&near, &solid_of);
    finder.found
}

/// Whether some triangles of different solids are related, of those pairs of solids that are `wanted`.
pub fn is_related(
    complex: &mut Complex,
    incidence: Incidence<'_>,
    solid_of: impl Fn(u32) -> u32,
    (some, wanted): (&[u32], impl Fn(u32, u32) -> bool),
    reach: Reach<'_>,
) -> bool {
    let mut near = Vec::new();
    let wanted = |s: u32, t: u32| wanted(solid_of(s), solid_of(t));
    let visit = |s, t| {
        if !is_far(complex, s, t, reach) {
            near.push([s, t]);
        }
    };
    let boxes = Aligned::of(complex, reach);
    let search = near_pairs((&boxes, some), &solid_of, wanted, visit);
    if search == Search::GaveUp {
        return false;
    }
    near.sort_unstable();
    let mut finder = Finder::new(complex, incidence, reach);
    finder.run(&near, &solid_of);
    !finder.found.is_empty()
}

fn meets(complex: &Complex, s: u32, t: u32) -> bool {
    let [p, q] = [s, t].map(|t| &complex.triangles[t as usize]);
    contact(&complex.points, p, q).is_some()
}

/// Boxes about all that triangles reach, which only sort out pairs: those of a frame along the faces are smaller, and what
/// turning rounds is less than the reach.
struct Aligned<'a> {
    complex: &'a Complex,
    reach: Reach<'a>,
    frame: Option<DMat3>,
}

impl<'a> Aligned<'a> {
    fn of(complex: &'a Complex, reach: Reach<'a>) -> Self {
        let frame = alignment(complex.triangles.len(), |t| complex.corners(t as u32));
        Self {
            complex,
            reach,
            frame,
        }
    }

    /// The lowest and the highest coordinates of a triangle's box.
    fn of_triangle(&self, t: u32) -> [DVec3; 2] {
        let [a, b, c] = (self.complex.corners(t)).map(|p| self.frame.map_or(p, |frame| frame * p));
        let reach = self.reach.of(t);
        [a.min(b).min(c) - reach, a.max(b).max(c) + reach]
    }
}

/// Calls `visit` with the pairs of some triangles of different groups that are `wanted` and whose boxes meet, the lower one
/// first.
fn near_pairs(
    (boxes, some): (&Aligned<'_>, &[u32]),
    group: impl Fn(u32) -> u32,
    wanted: impl Fn(u32, u32) -> bool,
    mut visit: impl FnMut(u32, u32),
) -> Search {
    pairs(
        some.iter().map(|&t| boxes.of_triangle(t)),
        |i| group(some[i as usize]),
        |s, t| {
            let [s, t] = [s.min(t), s.max(t)].map(|i| some[i as usize]);
            if wanted(s, t) {
                visit(s, t);
            }
            true
        },
    )
}

/// Whether two triangles are clearly farther apart than either reaches. What has a vertex in common is not.
fn is_far(complex: &Complex, s: u32, t: u32, reach: Reach<'_>) -> bool {
    let ids = complex.triangles[t as usize];
    if complex.triangles[s as usize]
        .iter()
        .any(|v| ids.contains(v))
    {
        return false;
    }
    let [p, q] = [s, t].map(|t| complex.corners(t));
    let within = reach.of(s).max(reach.of(t));
    is_beside(&p, &q, within) || is_beside(&q, &p, within)
}

/// Of which vertices of flat faces it is asked whether they touch the surface behind a facet.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Of {
    /// Of corners; whatever lies at one place is related as well.
    Corners,
    /// Of those between corners.
    Between,
}

/// Looks for relations in pairs of triangles.
struct Finder<'a> {
    complex: &'a mut Complex,
    edges: &'a Edges,
    faces: &'a Faces,
    reach: Reach<'a>,
    found: Relations,
    /// Points made where edges cross.
    crossed: FxHashMap<[u32; 2], u32>,
    /// Points made where an edge passes through a face.
    pierced: FxHashSet<[u32; 2]>,
    /// Vertices of faces that edges of curved faces pass through.
    vertices_of: FxHashMap<u32, FxHashSet<u32>>,
    set_on_edge: FxHashSet<[u32; 2]>,
    set_inside: FxHashSet<[u32; 2]>,
    /// Vertices that are moved to another one.
    moved: Vec<[u32; 2]>,
}

impl<'a> Finder<'a> {
    fn new(complex: &'a mut Complex, incidence: Incidence<'a>, reach: Reach<'a>) -> Self {
        let Incidence { edges, faces } = incidence;
        Self {
            found: Relations {
                same: DisjointSets::new(complex.points.len()),
                on_edge: FxHashMap::default(),
                inside: FxHashMap::default(),
                pairs: FxHashSet::default(),
                search: Search::Done,
                largest: 0.0,
                shifted: FxHashSet::default(),
            },
            complex,
            edges,
            faces,
            reach,
            crossed: FxHashMap::default(),
            pierced: FxHashSet::default(),
            vertices_of: FxHashMap::default(),
            set_on_edge: FxHashSet::default(),
            set_inside: FxHashSet::default(),
            moved: Vec::new(),
        }
    }

    /// Relates vertices first, then edges, then edges and faces: what is related already does not cross beside that.
    ///
    /// Whether flat faces touch within what they stand for is asked at their corners: vertices between those are where
    /// faces happen to be divided, and images of a face may be divided in other ways. They follow where a corner touches: of their own
    /// face, or of the one that they are at, since narrow faces may lie between the corners of a wide one.
    fn run(&mut self, near: &[[u32; 2]], solid_of: impl Fn(u32) -> u32) {
        let mut touched: FxHashSet<(u32, u32)> = FxHashSet::default();
        for &[s, t] in near {
            let others = solid_of(s) != solid_of(t);
            let of = Of::Corners;
            let any = self.vertices(s, t, (others, of)) | self.vertices(t, s, (others, of));
            self.related(any, s, t);
            if any && others {
                let [f, g] = [s, t].map(|t| self.complex.face[t as usize]);
                touched.extend([(f, solid_of(t)), (g, solid_of(s))]);
            }
        }
        for &[s, t] in near {
            let [f, g] = [s, t].map(|t| self.complex.face[t as usize]);
            let follow = touched.contains(&(f, solid_of(t))) || touched.contains(&(g, solid_of(s)));
            if follow {
                let of = Of::Between;
                let any = self.vertices(s, t, (true, of)) | self.vertices(t, s, (true, of));
                self.related(any, s, t);
            }
        }
        for &[s, t] in near {
            let others = solid_of(s) != solid_of(t);
            let mut any = false;
            for i in 0..3 {
                for j in 0..3 {
                    any |= self.edges([s, t], [i, j], others);
                }
            }
            self.related(any, s, t);
        }
        for &[s, t] in near {
            let others = solid_of(s) != solid_of(t);
            let mut any = false;
            for i in 0..3 {
                any |= self.pierce(s, i, t, others) | self.pierce(t, i, s, others);
            }
            // Faces with the same border may be cut into triangles in two ways.
            any |= meets(self.complex, s, t) || self.lies_over(s, t);
            self.related(any, s, t);
        }
        if let Some(curves) = self.reach.curves {
            self.keep_features(curves);
        }
    }

    /// Whether two triangles with an edge in common lie over each other, within the distance in which they need not meet.
    fn lies_over(&self, s: u32, t: u32) -> bool {
        let [p, q] = [s, t].map(|t| self.complex.triangles[t as usize]);
        let alone = |p: [u32; 3], q: [u32; 3]| {
            let mut others = p.into_iter().filter(|v| !q.contains(v));
            others.next().filter(|_| others.next().is_none())
        };
        let (Some(c), Some(d)) = (alone(p, q), alone(q, p)) else {
            return false;
        };
        let mut common = p.into_iter().filter(|&v| v != c);
        let (Some(a), Some(b)) = (common.next(), common.next()) else {
            return false;
        };
        let [a, b, c, d] = [a, b, c, d].map(|v| self.complex.points[v as usize]);
        let along = (b - a).normalize_or_zero();
        let [c, d] = [c, d].map(|p| (p - a).reject_from_normalized(along));
        let apart = |c: DVec3, d: DVec3| c.reject_from(d).length();
        c.dot(d) > 0.0 && apart(c, d).max(apart(d, c)) <= self.reach.equal
    }

    fn related(&mut self, any: bool, s: u32, t: u32) {
        if any {
            let [s, t] = [s, t].map(|t| self.complex.face[t as usize]);
            self.found.pairs.insert([s.min(t), s.max(t)]);
        }
    }

    /// Relates the vertices on a face's border to a triangle that does not have them.
    fn vertices(&mut self, of: u32, t: u32, (others, which): (bool, Of)) -> bool {
        let curves = self.reach.curves.filter(|_| others);
        let ids = self.complex.triangles[t as usize];
        let places = self.complex.corners(t);
        let mut any = false;
        for (i, v) in self.complex.triangles[of as usize].into_iter().enumerate() {
            let border = self.faces.border[of as usize];
            if ids.contains(&v) || !(border[i] || border[(i + 2) % 3]) {
                continue;
            }
            let p = self.complex.points[v as usize];
            let within = spot(p, &places, self.reach.equal);
            let beyond = || {
                let curves = curves.filter(|c| c.is_corner(v) == (which == Of::Corners))?;
                curves.spot((of, i), t, self.complex, self.reach.equal)
            };
            let at = match which {
                Of::Corners => within.or_else(beyond),
                Of::Between if within.is_some() => None,
                Of::Between => beyond(),
            };
            let Some(at) = at else { continue };
            any = true;
            match at {
                Spot::Corner(i) => {
                    self.moves(p.distance(places[i]));
                    self.found.same.join(v, ids[i]);
                    self.moved.push([v, ids[i]]);
                }
                Spot::Edge(i, along) if self.faces.border[t as usize][i] => {
                    let edge = self.faces.edges[t as usize][i];
                    let [a, b] = [places[i], places[(i + 1) % 3]];
                    self.moves(p.distance(a + (b - a) * along));
                    let forward = self.edges.ends[edge as usize][0] == ids[i];
                    self.on_edge(edge, if forward { along } else { 1.0 - along }, v);
                }
                _ => {
                    let normal = (places[1] - places[0]).cross(places[2] - places[0]);
                    self.moves((p - places[0]).dot(normal.normalize_or_zero()).abs());
                    self.inside(t, v);
                }
            }
        }
        any
    }

    fn moves(&mut self, by: f64) {
        self.found.largest = self.found.largest.max(by);
    }

    fn inside(&mut self, t: u32, v: u32) {
        let face = self.complex.face[t as usize];
        if self.set_inside.insert([face, v]) {
            self.found.inside.entry(face).or_default().push(v);
        }
    }

    fn on_edge(&mut self, edge: u32, along: f64, vertex: u32) {
        if self.set_on_edge.insert([edge, vertex]) {
            let on = self.found.on_edge.entry(edge).or_default();
            on.push((along, vertex));
        }
    }

    /// Relates two edges of faces that cross.
    fn edges(&mut self, [s, t]: [u32; 2], [i, j]: [usize; 2], others: bool) -> bool {
        let of = |t: u32, i: usize| {
            let t = t as usize;
            self.faces.border[t][i].then(|| self.faces.edges[t][i])
        };
        let (Some(e), Some(f)) = (of(s, i), of(t, j)) else {
            return false;
        };
        let ends = [e, f].map(|e| self.edges.ends[e as usize]);
        if e == f || ends[0].iter().any(|v| ends[1].contains(v)) {
            return false;
        }
        let key = [e.min(f), e.max(f)];
        if self.crossed.contains_key(&key) {
            return true;
        }
        if self.have_ends_in_common(e, f) {
            return false;
        }
        let [p, q] = ends.map(|ends| ends.map(|v| self.complex.points[v as usize]));
        let at = |along: [f64; 2]| {
            let [x, y] = [
                p[0] + (p[1] - p[0]) * along[0],
                q[0] + (q[1] - q[0]) * along[1],
            ];
            (along, x, y)
        };
        let equal = self.reach.equal;
        let found = crossing(p, q, equal, equal).map(|along| {
            let (along, x, y) = at(along);
            (along, 0.5 * (x + y), 0.5 * x.distance(y))
        });
        let found = found.or_else(|| {
            let curves = self.reach.curves.filter(|_| others)?;
            let normal = curves.patches[s as usize].normal;
            let reach = self.reach.of(s).max(self.reach.of(t));
            let (along, x, y) = at(crossing_along(normal, p, q, reach, equal)?);
            let first = curves.edge_over(e, along[0], t, self.edges);
            let second = curves.edge_over(f, along[1], s, self.edges);
            let (first, second) = (first?, second?);
            // Both are under the surface that both stand for; the one that is nearer to it has the point.
            let apart = (x + normal * first.0 - y + normal * second.0)
                .dot(normal)
                .abs();
            let allowed = first.1.max(second.1).max(equal);
            let place = if first.0.abs() <= second.0.abs() {
                x
            } else {
                y
            };
            (apart <= allowed).then(|| (along, place, x.distance(y)))
        });
        let Some((along, place, moved)) = found else {
            return false;
        };
        self.moves(moved);
        // Where one of them is bent to a vertex, they cross there.
        let within = match self.reach.curves.filter(|_| others) {
            Some(curves) => curves.uncertain(s).max(curves.uncertain(t)).max(equal),
            None => equal,
        };
        let known = (self.vertex_near(e, place, within)).or(self.vertex_near(f, place, within));
        let vertex = known.unwrap_or_else(|| self.add(place));
        self.crossed.insert(key, vertex);
        self.on_edge(e, along[0], vertex);
        self.on_edge(f, along[1], vertex);
        true
    }

    /// Whether an end of one edge is on the other one, or the same as one of its ends.
    fn have_ends_in_common(&mut self, e: u32, f: u32) -> bool {
        let [p, q] = [e, f].map(|e| self.edges.ends[e as usize]);
        let on =
            |edge: u32, ends: [u32; 2]| ends.iter().any(|&v| self.set_on_edge.contains(&[edge, v]));
        if on(e, q) || on(f, p) {
            return true;
        }
        let [p, q] = [p, q].map(|ends| ends.map(|v| self.found.same.find(v)));
        p.iter().any(|v| q.contains(v))
    }

    /// Relates an edge of a face to a triangle that it passes through.
    fn pierce(&mut self, s: u32, i: usize, t: u32, others: bool) -> bool {
        if !self.faces.border[s as usize][i] {
            return false;
        }
        let e = self.faces.edges[s as usize][i];
        let ends = self.edges.ends[e as usize];
        let ids = self.complex.triangles[t as usize];
        if ends.iter().any(|v| ids.contains(v)) {
            return false;
        }
        let p = ends.map(|v| self.complex.points[v as usize]);
        let corners = self.complex.corners(t);
        let equal = self.reach.equal;
        let border = self.faces.border[t as usize];
        let Some(along) = piercing(p, &corners, border, equal) else {
            return false;
        };
        if p.iter().any(|&p| spot(p, &corners, equal).is_some()) {
            return false;
        }
        let face = self.complex.face[t as usize];
        if self.pierced.contains(&[e, face]) {
            return true;
        }
        let place = p[0] + (p[1] - p[0]) * along;
        if let Some(curves) = self.reach.curves.filter(|_| others)
            && let Some((over, allowed)) = curves.edge_over(e, along, t, self.edges)
        {
            // A chord that dips into the facet of a surface that both stand for.
            let patch = &curves.patches[t as usize];
            if (over + patch.over(place)).abs() <= allowed.max(curves.uncertain(t)).max(equal) {
                return false;
            }
        }
        let near = self.reach.of(s);
        if self.reach.curves.is_some()
            && (self.vertex_near(e, place, near).is_some() || self.is_bent_to(e, face))
        {
            return false;
        }
        let new = self.add(place);
        self.pierced.insert([e, face]);
        self.on_edge(e, along, new);
        self.inside(t, new);
        true
    }

    /// Whether an edge is bent to a vertex of a flat face: there it passes through the face, and nowhere else.
    fn is_bent_to(&mut self, e: u32, face: u32) -> bool {
        let Some(on) = self.found.on_edge.get(&e) else {
            return false;
        };
        let vertices = self.vertices_of.entry(face).or_insert_with(|| {
            let triangles = self.faces.triangles[face as usize].iter();
            let all = triangles.flat_map(|&t| self.complex.triangles[t as usize]);
            all.collect()
        });
        on.iter().any(|(_, v)| vertices.contains(v))
    }

    /// The vertex on an edge that is nearest to a place of it, within a distance: the edge will be bent to that.
    fn vertex_near(&self, e: u32, place: DVec3, within: f64) -> Option<u32> {
        let on = self.found.on_edge.get(&e).into_iter().flatten();
        let off = |v: u32| self.complex.points[v as usize].distance(place);
        on.map(|&(_, v)| (off(v), v))
            .filter(|&(off, _)| off <= within)
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(_, v)| v)
    }

    fn add(&mut self, place: DVec3) -> u32 {
        self.complex.points.push(place);
        self.complex.points.len() as u32 - 1
    }

    /// Of vertices that are one, the one that is most of a feature stays where it is.
    fn keep_features(&mut self, curves: &Curves) {
        let mut best: FxHashMap<u32, (u8, u32)> = FxHashMap::default();
        for v in self.moved.concat() {
            let own = (curves.rank(v, &self.complex.points), v);
            let known = best.entry(self.found.same.find(v)).or_insert(own);
            if own.0 > known.0 || (own.0 == known.0 && v < known.1) {
                *known = own;
            }
        }
        let moves: Vec<(u32, DVec3)> = best
            .into_iter()
            .map(|(set, (_, v))| (set, self.complex.points[v as usize]))
            .collect();
        for (set, place) in moves {
            let at = &mut self.complex.points[set as usize];
            if *at != place {
                *at = place;
                self.found.shifted.insert(set);
            }
        }
    }
}
