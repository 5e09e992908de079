//! The rounds.

use super::curves::Curves;
use super::divide::{Division, Parts, sorted};
use super::faces::{Complex, Faces, Incidence};
use super::relate::{Reach, Relations, relate};
use geom::edges::Edges;
use geom::grid::Grid;
use geom::sets::DisjointSets;
use geom::tree::{Search, Tree};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Rounds after which triangles are left as they are. A choice: the first one relates what the file has, the second one
/// what crosses on a face, and each further one what the movement of the one before brought near. What has not come to rest
/// by then is tried without curves, or refused: a larger number takes longer to say so, a smaller one may cut off what
/// would have come to rest.
const ROUNDS: usize = 16;

/// Triangles that meet in common vertices and edges only, as far as anything was found.
pub struct Overlay {
    /// The triangles.
    pub complex: Complex,
    /// Points that were added where triangles cross.
    pub added: usize,
    /// The farthest that a point was moved, or an edge to a point.
    pub largest: f64,
    /// Whether the rounds came to rest: then triangles of different faces meet in common vertices and edges only.
    pub done: bool,
}

/// Divides faces until none has anything within reach that it does not have in common with it. `solid` has the solid of
/// each source. What touches the surfaces behind facets is related in the first round, up to a gap if one is given; a gap
/// of zero leaves that out. The pairs of triangles of one solid that meet away from common vertices and edges are given.
pub fn overlay(
    mut complex: Complex,
    (solid, meeting): (&[u32], &[[u32; 2]]),
    within: f64,
    gap: Option<f64>,
) -> Overlay {
    let points = complex.points.len();
    let mut overlay = Overlay {
        complex: Complex::default(),
        added: 0,
        largest: 0.0,
        done: false,
    };
    let mut is_new = vec![true; complex.triangles.len()];
    let mut fewest = usize::MAX;
    for round in 0..ROUNDS {
        let edges = Edges::new(&complex.triangles);
        let faces = Faces::new(&complex, &edges);
        let curved = gap != Some(0.0) && round == 0;
        let curves = curved.then(|| Curves::new(&complex, &edges, solid, gap));
        let before = complex.points.len();
        let source = complex.source.clone();
        let reach = Reach {
            equal: within,
            curves: curves.as_ref(),
        };
        let solid_of = |t: u32| solid[source[t as usize] as usize];
        let incidence = Incidence {
            edges: &edges,
            faces: &faces,
        };
        let which = (|t: u32| is_new[t as usize], (round == 0).then_some(meeting));
        let mut found = relate(&mut complex, incidence, solid_of, reach, which);
        if found.is_empty() {
            overlay.done = found.search == Search::Done;
            break;
        }
        if found.pairs.len() >= fewest {
            // Edges within a face do not count, as it is flat: where it was bent, others cross it there, and dividing its
            // border changes nothing.
            let stuck = found.pairs.iter().flatten().copied().collect();
            let are_stuck = complex.face.iter().map(|f| FxHashSet::contains(&stuck, f));
            let are_stuck: Vec<bool> = are_stuck.collect();
            if complex.break_up(&stuck) {
                complex.points.truncate(before);
                is_new
                    .iter_mut()
                    .zip(are_stuck)
                    .for_each(|(new, stuck)| *new |= stuck);
                fewest = usize::MAX;
                continue;
            }
        }
        fewest = fewest.min(found.pairs.len());
        overlay.largest = overlay.largest.max(found.largest);
        let ids = ids(&complex.points, before, &mut found.same, within);
        let round = Round {
            incidence,
            found: &found,
            ids: &ids,
            within: within.max(found.largest),
            bent: within.max(overlay.largest),
        };
        is_new = round.run(&mut complex);
    }
    overlay.added = complex.points.len() - points;
    overlay.complex = complex;
    overlay
}

/// What each point becomes: those that are the same are one, and new points within the distance of another point are
/// that.
fn ids(points: &[DVec3], before: usize, same: &mut DisjointSets, within: f64) -> Vec<u32> {
    let mut ids: Vec<u32> = (0..before as u32).map(|v| same.find(v)).collect();
    if before == points.len() {
        return ids;
    }
    let mut grid: Grid<3> = Grid::of(points[..before].iter().copied(), within);
    let mut number: Vec<u32> = (0..before as u32).collect();
    for (v, &p) in (before as u32..).zip(&points[before..]) {
        match grid.nearest(p, within) {
            Some((near, _)) => ids.push(ids[number[near as usize] as usize]),
            None => {
                grid.insert(p);
                number.push(v);
                ids.push(v);
            }
        }
    }
    ids
}

struct Round<'a> {
    incidence: Incidence<'a>,
    found: &'a Relations,
    ids: &'a [u32],
    /// How far apart things are that are related.
    within: f64,
    /// How far off their planes faces have been bent, by this round and those before.
    bent: f64,
}

type Sides = Vec<[u32; 2]>;

impl Round<'_> {
    fn id(&self, v: u32) -> u32 {
        self.ids[v as usize]
    }

    /// Divides the faces; which of the resulting triangles are new.
    fn run(&self, complex: &mut Complex) -> Vec<bool> {
        let chains = self.chains();
        let borders: Vec<Sides> = (0..self.incidence.faces.triangles.len())
            .map(|f| self.border(complex, f, &chains))
            .collect();
        let inside = self.inside(&borders);
        let segments = self.segments(complex, &borders, &inside);
        let mut related = vec![false; borders.len()];
        for f in self.found.pairs.iter().flatten() {
            related[*f as usize] = true;
        }
        let mut parts = Parts::default();
        let mut divided = Complex {
            points: std::mem::take(&mut complex.points),
            ..Complex::default()
        };
        let mut is_new = Vec::new();
        let mut count = 0;
        for (f, triangles) in self.incidence.faces.triangles.iter().enumerate() {
            let whole = || {
                let ids = triangles.iter().map(|&t| complex.triangles[t as usize]);
                vec![ids.map(|t| t.map(|v| self.id(v))).collect::<Vec<_>>()]
            };
            let is_whole = !related[f] && self.is_as_it_was(complex, triangles, &chains);
            let list = if is_whole {
                whole()
            } else {
                let areas = triangles.iter().map(|&t| {
                    let [a, b, c] =
                        complex.triangles[t as usize].map(|v| divided.points[v as usize]);
                    (b - a).cross(c - a)
                });
                let key = f as u32;
                let division = Division {
                    normal: areas.sum(),
                    border: borders[f].clone(),
                    inside: inside.get(&key).cloned().unwrap_or_default(),
                    segments: segments.get(&key).cloned().unwrap_or_default(),
                };
                division
                    .divide(&divided.points, &mut parts)
                    .unwrap_or_else(whole)
            };
            let source = complex.source[triangles[0] as usize];
            for part in list {
                for corners in part {
                    let [a, b, c] = corners;
                    if a != b && b != c && a != c {
                        divided.triangles.push(corners);
                        divided.source.push(source);
                        divided.face.push(count);
                        let is_shifted = corners.iter().any(|v| self.found.shifted.contains(v));
                        is_new.push(!is_whole || is_shifted);
                    }
                }
                count += 1;
            }
        }
        divided.number_faces();
        *complex = divided;
        is_new
    }

    fn is_as_it_was(
        &self,
        complex: &Complex,
        triangles: &[u32],
        chains: &[Option<Vec<u32>>],
    ) -> bool {
        triangles.iter().all(|&t| {
            let edges = self.incidence.faces.edges[t as usize];
            let corners = complex.triangles[t as usize];
            corners.iter().all(|&v| self.id(v) == v)
                && edges.iter().all(|&e| chains[e as usize].is_none())
        })
    }

    /// Of each edge: its vertices from the lower end to the higher one.
    fn chains(&self) -> Vec<Option<Vec<u32>>> {
        let mut chains: Vec<Option<Vec<u32>>> = vec![None; self.incidence.edges.len()];
        for (&e, on) in &self.found.on_edge {
            let mut on = on.clone();
            on.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let ends = self.incidence.edges.ends[e as usize].map(|v| self.id(v));
            let mut chain = vec![ends[0]];
            for v in on.iter().map(|&(_, v)| self.id(v)) {
                if !chain.contains(&v) && v != ends[1] {
                    chain.push(v);
                }
            }
            chain.push(ends[1]);
            chains[e as usize] = Some(chain);
        }
        chains
    }

    /// The sides of a face.
    fn border(&self, complex: &Complex, f: usize, chains: &[Option<Vec<u32>>]) -> Sides {
        let mut sides = Sides::new();
        for &t in &self.incidence.faces.triangles[f] {
            let (t, corners) = (t as usize, complex.triangles[t as usize]);
            for i in (0..3).filter(|&i| self.incidence.faces.border[t][i]) {
                let [a, b] = [corners[i], corners[(i + 1) % 3]];
                let e = self.incidence.faces.edges[t][i] as usize;
                match &chains[e] {
                    Some(chain) => sides.extend(chain.windows(2).map(|w| [w[0], w[1]])),
                    None => sides.push([self.id(a), self.id(b)]),
                }
            }
        }
        sides.iter_mut().for_each(|s| *s = sorted(*s));
        sides.retain(|s| s[0] != s[1]);
        sides
    }

    fn inside(&self, borders: &[Sides]) -> FxHashMap<u32, Vec<u32>> {
        let of = self.found.inside.iter().filter_map(|(&f, list)| {
            let border: FxHashSet<u32> = borders[f as usize].iter().flatten().copied().collect();
            let mut list: Vec<u32> = list.iter().map(|&v| self.id(v)).collect();
            list.sort_unstable();
            list.dedup();
            list.retain(|v| !border.contains(v));
            (!list.is_empty()).then_some((f, list))
        });
        of.collect()
    }

    /// Of each face: segments across it, between vertices that it has in common with another one: parts of the border
    /// of that, or of the line in which both cross.
    fn segments(
        &self,
        complex: &Complex,
        borders: &[Sides],
        inside: &FxHashMap<u32, Vec<u32>>,
    ) -> FxHashMap<u32, Sides> {
        let mut segments: FxHashMap<u32, Sides> = FxHashMap::default();
        let mut trees: FxHashMap<u32, Tree> = FxHashMap::default();
        // A face with hundreds of others on it is asked for its vertices and sides by each of them.
        let mut vertices: FxHashMap<u32, FxHashSet<u32>> = FxHashMap::default();
        let mut sides: FxHashMap<u32, FxHashSet<[u32; 2]>> = FxHashMap::default();
        let mut pairs: Vec<[u32; 2]> = self.found.pairs.iter().copied().collect();
        pairs.sort_unstable();
        for pair in pairs {
            for f in pair {
                vertices.entry(f).or_insert_with(|| {
                    let within = inside.get(&f).into_iter().flatten();
                    let border = borders[f as usize].iter().flatten();
                    border.chain(within).copied().collect()
                });
            }
            let [first, second] = pair.map(|f| &vertices[&f]);
            let (few, many) = match first.len() <= second.len() {
                true => (first, second),
                false => (second, first),
            };
            let mut common: Vec<u32> = few.iter().filter(|v| many.contains(v)).copied().collect();
            if common.len() < 2 {
                continue;
            }
            common.sort_unstable();
            let line = on_line(&complex.points, &common, self.within);
            for [own, other] in [pair, [pair[1], pair[0]]] {
                let sides = sides
                    .entry(own)
                    .or_insert_with(|| borders[own as usize].iter().copied().collect());
                let tree = trees.entry(own).or_insert_with(|| {
                    let triangles = self.incidence.faces.triangles[own as usize].iter();
                    Tree::new(triangles.map(|&t| complex.corners(t)))
                });
                let of_other = borders[other as usize].iter().chain(&line);
                let across = of_other.copied().filter(|s| {
                    let middle = 0.5 * s.map(|v| complex.points[v as usize]).iter().sum::<DVec3>();
                    s.iter().all(|v| common.binary_search(v).is_ok())
                        && !sides.contains(s)
                        && tree.nearest(middle, 2.0 * self.bent).is_some()
                });
                segments.entry(own).or_default().extend(across);
            }
        }
        for list in segments.values_mut() {
            list.sort_unstable();
            list.dedup();
        }
        segments
    }
}

/// Segments between vertices that are on one line to within a distance, in order along it; none if they are not.
fn on_line(points: &[DVec3], common: &[u32], within: f64) -> Vec<[u32; 2]> {
    let at = |v: u32| points[v as usize];
    let mut ends = [common[0], common[1]];
    let mut longest = 0.0;
    for (i, &v) in common.iter().enumerate() {
        for &w in &common[i + 1..] {
            let length = at(v).distance(at(w));
            if length > longest {
                (longest, ends) = (length, [v, w]);
            }
        }
    }
    let [a, b] = ends.map(at);
    let along = (b - a) / longest;
    let off = |v: u32| (at(v) - a).reject_from_normalized(along).length();
    if common.iter().any(|&v| off(v) > within) {
        return Vec::new();
    }
    let mut order = common.to_vec();
    order.sort_by(|&v, &w| {
        let [x, y] = [v, w].map(|v| (at(v) - a).dot(along));
        x.total_cmp(&y).then(v.cmp(&w))
    });
    order.windows(2).map(|w| sorted([w[0], w[1]])).collect()
}
