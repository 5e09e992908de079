//! The rounds.

use super::divide::{Division, Parts, sorted};
use super::relate::{Complex, Relations, relate};
use geom::edges::Edges;
use geom::grid::Grid;
use geom::measure::double_area_vector;
use geom::sets::DisjointSets;
use geom::tree::Search;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Rounds after which triangles are left as they are. A choice: the first one relates what the file has, the second one
/// what crosses on a triangle, and each further one what the movement of the one before brought near; assemblies from CAD
/// programs take up to five. What has not come to rest is refused, so that a larger number would only take longer.
const ROUNDS: usize = 16;

/// Triangles that meet in common vertices and edges only, as far as anything was found.
pub struct Overlay {
    /// The triangles.
    pub complex: Complex,
    /// Points that were added where triangles cross.
    pub added: usize,
    /// The farthest that a point was moved, or an edge to a point.
    pub largest: f64,
    /// Whether the rounds came to rest.
    pub done: bool,
}

/// Divides triangles until none has anything within the distance that it does not have in common with it. `solid` has
/// the solid of each source.
pub fn overlay(mut complex: Complex, solid: &[u32], within: f64) -> Overlay {
    let points = complex.points.len();
    let mut overlay = Overlay {
        complex: Complex::default(),
        added: 0,
        largest: 0.0,
        done: false,
    };
    let mut is_new = vec![true; complex.triangles.len()];
    for _ in 0..ROUNDS {
        let edges = Edges::new(&complex.triangles);
        let before = complex.points.len();
        let source = complex.source.clone();
        let solid_of = |t: u32| solid[source[t as usize] as usize];
        let mut found = relate(&mut complex, &edges, solid_of, within, |t| {
            is_new[t as usize]
        });
        if found.is_empty() {
            overlay.done = found.search == Search::Done;
            break;
        }
        overlay.largest = overlay.largest.max(found.largest);
        let ids = ids(&complex.points, before, &mut found.same, within);
        is_new = Round {
            edges: &edges,
            found: &found,
            ids: &ids,
            within,
        }
        .run(&mut complex);
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
    edges: &'a Edges,
    found: &'a Relations,
    ids: &'a [u32],
    within: f64,
}

impl Round<'_> {
    fn id(&self, v: u32) -> u32 {
        self.ids[v as usize]
    }

    /// Divides the triangles; which of the resulting ones are new.
    fn run(&self, complex: &mut Complex) -> Vec<bool> {
        let chains = self.chains();
        let borders = self.borders(&complex.triangles, &chains);
        let inside = self.inside(&borders);
        let segments = self.segments(complex, &borders, &inside);
        let mut parts = Parts::default();
        let mut divided = Complex {
            points: std::mem::take(&mut complex.points),
            ..Complex::default()
        };
        let mut is_new = Vec::new();
        for (t, corners) in complex.triangles.iter().enumerate() {
            let border = &borders[t];
            let within = inside.get(&(t as u32));
            let across = segments.get(&(t as u32));
            let whole = border[..] == corners[..] && within.is_none() && across.is_none();
            let list = if whole {
                vec![*corners]
            } else {
                let [a, b, c] = corners.map(|v| divided.points[v as usize]);
                let division = Division {
                    border: border.clone(),
                    inside: within.cloned().unwrap_or_default(),
                    segments: across.cloned().unwrap_or_default(),
                    normal: double_area_vector(a, b, c),
                };
                match division.divide(&divided.points, &mut parts) {
                    Some(list) => list,
                    None => vec![corners.map(|v| self.id(v))],
                }
            };
            for corners in list {
                if corners[0] != corners[1] && corners[1] != corners[2] && corners[0] != corners[2]
                {
                    divided.triangles.push(corners);
                    divided.source.push(complex.source[t]);
                    is_new.push(!whole);
                }
            }
        }
        *complex = divided;
        is_new
    }

    /// Of each edge: its vertices from the lower end to the higher one.
    fn chains(&self) -> Vec<Option<Vec<u32>>> {
        let mut chains: Vec<Option<Vec<u32>>> = vec![None; self.edges.len()];
        for (&e, on) in &self.found.on_edge {
            let mut on = on.clone();
            on.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let ends = self.edges.ends[e as usize].map(|v| self.id(v));
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

    /// Of each triangle: the vertices of its edges, in order.
    fn borders(&self, triangles: &[[u32; 3]], chains: &[Option<Vec<u32>>]) -> Vec<Vec<u32>> {
        let corners = |t: &[u32; 3]| t.iter().map(|&v| self.id(v)).collect();
        let mut sides: Vec<[Option<(u32, bool)>; 3]> = vec![[None; 3]; triangles.len()];
        for (e, chain) in chains.iter().enumerate() {
            if chain.is_some() {
                for u in self.edges.around(e) {
                    sides[u.triangle as usize][u.corner as usize] = Some((e as u32, u.forward));
                }
            }
        }
        let border = |(t, corners_of): (usize, &[u32; 3])| -> Vec<u32> {
            if sides[t].iter().all(Option::is_none) {
                return corners(corners_of);
            }
            let mut border = Vec::new();
            for i in 0..3 {
                match sides[t][i].and_then(|(e, f)| Some((chains[e as usize].as_ref()?, f))) {
                    Some((chain, true)) => border.extend(&chain[..chain.len() - 1]),
                    Some((chain, false)) => border.extend(chain[1..].iter().rev()),
                    None => border.push(self.id(corners_of[i])),
                }
            }
            border.dedup();
            while border.len() > 1 && border[0] == border[border.len() - 1] {
                border.pop();
            }
            border
        };
        triangles.iter().enumerate().map(border).collect()
    }

    fn inside(&self, borders: &[Vec<u32>]) -> FxHashMap<u32, Vec<u32>> {
        let of = self.found.inside.iter().filter_map(|(&t, list)| {
            let mut list: Vec<u32> = list.iter().map(|&v| self.id(v)).collect();
            list.sort_unstable();
            list.dedup();
            list.retain(|v| !borders[t as usize].contains(v));
            (!list.is_empty()).then_some((t, list))
        });
        of.collect()
    }

    /// Of each triangle: segments across it, between vertices that it has in common with another one. Two triangles have
    /// convex parts of planes in common: what joins two of their common vertices is in both.
    fn segments(
        &self,
        complex: &Complex,
        borders: &[Vec<u32>],
        inside: &FxHashMap<u32, Vec<u32>>,
    ) -> FxHashMap<u32, Vec<[u32; 2]>> {
        let mut segments: FxHashMap<u32, Vec<[u32; 2]>> = FxHashMap::default();
        let all = |t: u32| -> FxHashSet<u32> {
            let within = inside.get(&t).into_iter().flatten();
            borders[t as usize].iter().chain(within).copied().collect()
        };
        for pair in &self.found.pairs {
            let [first, second] = pair.map(all);
            let mut common: Vec<u32> = first.intersection(&second).copied().collect();
            if common.len() < 2 {
                continue;
            }
            common.sort_unstable();
            let is_common = |v: &u32| common.binary_search(v).is_ok();
            let mut new = Vec::new();
            for t in pair {
                let border = &borders[*t as usize];
                let n = border.len();
                let sides = (0..n).map(|i| [border[i], border[(i + 1) % n]]);
                new.extend(sides.filter(|s| s.iter().all(is_common)).map(sorted));
            }
            new.extend(on_line(&complex.points, &common, self.within));
            for t in pair {
                let border = &borders[*t as usize];
                let n = border.len();
                let sides: FxHashSet<[u32; 2]> = (0..n)
                    .map(|i| sorted([border[i], border[(i + 1) % n]]))
                    .collect();
                for s in &new {
                    if !sides.contains(s) {
                        segments.entry(*t).or_default().push(*s);
                    }
                }
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
