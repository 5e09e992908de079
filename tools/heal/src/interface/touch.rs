//! Where vertices and sharp edges of solids touch curved faces of others.

use super::rims::Rims;
use crate::imprint::{Complex, Curves, Patch, Spot, crossing_along};
use geom::edges::Edges;
use geom::sets::DisjointSets;
use geom::smooth::SMOOTH_COSINE;
use geom::tree::{Search, closest_point, pairs};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Where a vertex touches another solid.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// The solid that it is a vertex of.
    pub of: u32,
    /// The facet that it is over or under.
    pub triangle: u32,
    /// Where on that: on a sharp edge, or inside.
    pub at: Spot,
    /// How far it is from the facet's plane, model units.
    pub height: f64,
    /// How far it is from the surface behind the facet, by how far what touches by itself may be.
    pub off: f64,
    /// Of what is on a sharp edge: how far it is beside the curve behind that, across the edge.
    pub sideways: DVec3,
    /// Whether both solids are on the same side of that: they end side by side.
    pub is_beside: bool,
}

/// How many times as far off as what touches by itself a vertex may be, if what is around it is near enough for both. Seen from a
/// facet, the surface behind it is known to half of its height over that: twice that is all of the height.
const UNSURE: f64 = 2.0;

/// Share of its shortest edge by which a vertex may be moved: a choice. Facets around it keep their sides.
const SLIGHT: f64 = 0.25;

/// Cosine of the largest angle between facets that look at each other: each may be turned against the surface behind it by as much
/// as is smooth.
const FACING_COSINE: f64 = 2.0 * SMOOTH_COSINE * SMOOTH_COSINE - 1.0;

/// Two sharp edges of different solids that cross on the surface that both are on.
pub struct Crossed {
    /// The edges.
    pub edges: [u32; 2],
    /// The solids that have them.
    pub solids: [u32; 2],
    /// Where along each, from its lower end.
    pub along: [f64; 2],
    /// The place.
    pub place: DVec3,
}

/// What touches.
pub struct Touches {
    /// Of vertices and solids: where a vertex touches a solid that it is no vertex of.
    pub of: FxHashMap<[u32; 2], Touch>,
    /// Vertices at one place.
    pub same: DisjointSets,
    /// Edges that cross, in order.
    pub crossed: Vec<Crossed>,
    /// Of each vertex: the solids that it is on.
    solids: Vec<Vec<u32>>,
}

impl Touches {
    /// Gives vertices that are one the number of the first of them.
    pub fn renumber(&mut self, id: &[u32], corners: &[[u32; 3]], solid: &[u32]) {
        let mut all: Vec<([u32; 2], Touch)> = self.of.drain().collect();
        all.sort_unstable_by_key(|a| a.0);
        for ([v, solid], touch) in all {
            self.of.entry([id[v as usize], solid]).or_insert(touch);
        }
        self.solids = vec![Vec::new(); id.len()];
        for (t, &solid) in corners.iter().zip(solid) {
            t.iter().for_each(|&v| self.solids[v as usize].push(solid));
        }
        for &[v, solid] in self.of.keys() {
            self.solids[v as usize].push(solid);
        }
        for list in &mut self.solids {
            list.sort_unstable();
            list.dedup();
        }
    }

    /// Leaves out what touches between solids other than these pairs, the lower one first, or side by side of others than those; whether
    /// there was something.
    pub fn keep(&mut self, pairs: &FxHashSet<[u32; 2]>) -> bool {
        let before = self.of.len() + self.crossed.len();
        let some: FxHashSet<u32> = pairs.iter().flatten().copied().collect();
        let is_kept = |a: u32, b: u32| pairs.contains(&[a.min(b), a.max(b)]);
        self.of.retain(|key, touch| match touch.is_beside {
            true => some.contains(&touch.of) && some.contains(&key[1]),
            false => is_kept(touch.of, key[1]),
        });
        self.crossed.retain(|c| is_kept(c.solids[0], c.solids[1]));
        self.of.len() + self.crossed.len() < before
    }

    /// The solids that a vertex is on, in order.
    pub fn solids_of(&self, v: u32) -> &[u32] {
        self.solids.get(v as usize).map_or(&[], Vec::as_slice)
    }
}

/// Solids with what is known of their facets.
#[derive(Clone, Copy)]
pub struct Facets<'a> {
    /// The facets.
    pub complex: &'a Complex,
    /// Their edges.
    pub edges: &'a Edges,
    /// The edge that begins at each corner.
    pub edge: &'a [[u32; 3]],
    /// The surfaces behind them.
    pub curves: &'a Curves,
    /// The curves behind sharp edges.
    pub rims: &'a Rims,
    /// The shortest edge at each vertex, model units.
    pub shortest: &'a [f64],
    /// The solid of each.
    pub solid: &'a [u32],
    /// Whether each belongs to a smooth face that is curved somewhere, of a solid that is closed.
    pub is_curved: &'a [bool],
    /// Distance within which things are at one place.
    pub equal: f64,
}

impl Facets<'_> {
    /// Finds what touches; `None` if there is too much near each other.
    pub fn touches(self) -> Option<Touches> {
        let mut finder = Finder {
            facets: self,
            best: FxHashMap::default(),
            same: DisjointSets::new(self.complex.points.len()),
            both_sharp: Vec::new(),
        };
        let some: Vec<u32> = (0..self.complex.triangles.len() as u32)
            .filter(|&t| self.is_curved[t as usize])
            .collect();
        let boxed = |&t: &u32| {
            let [a, b, c] = self.complex.corners(t);
            let reach = self.curves.reach(t).max(self.equal);
            [a.min(b).min(c) - reach, a.max(b).max(c) + reach]
        };
        let search = pairs(
            some.iter().map(boxed),
            |i| self.solid[some[i as usize] as usize],
            |s, t| {
                finder.pair([s, t].map(|i| some[i as usize]));
                true
            },
        );
        (search == Search::Done).then(|| finder.end())
    }

    fn patch(&self, t: u32) -> &Patch {
        &self.curves.patches[t as usize]
    }

    /// How uncertain it is whether two facets touch.
    fn within(&self, s: u32, t: u32) -> f64 {
        let [s, t] = [s, t].map(|t| self.curves.uncertain(t));
        s.max(t).max(self.equal)
    }

    /// Where a corner of the facet `s` touches the facet `t`, and how far beside and off the surface behind that. What looks the
    /// same way ends at the same edge, or does not touch.
    fn place(&self, (s, corner): (u32, usize), t: u32) -> Option<(f64, f64, Touch)> {
        let v = self.complex.triangles[s as usize][corner];
        let (p, patch) = (self.complex.points[v as usize], self.patch(t));
        let (within, height) = (self.within(s, t), patch.height(p));
        if height.abs() > patch.sagitta + UNSURE * within {
            return None;
        }
        let flat = p - patch.normal * height;
        let off = (height - patch.over(flat)).abs();
        if off > UNSURE * within {
            return None;
        }
        let ids = self.complex.triangles[t as usize];
        let corners = self.complex.corners(t);
        let is_beside = self.patch(s).normal.dot(patch.normal) > 0.0;
        let [own, solid] = [s, t].map(|t| self.solid[t as usize]);
        if is_beside && !self.rims.has(v, own) {
            return None;
        }
        // Where two solids end side by side, faces beyond these edges look at each other.
        let is_met = |ends: [u32; 2]| {
            let look = |end| self.rims.face([v, own], [end, solid], -FACING_COSINE);
            !is_beside || ends.into_iter().all(look)
        };
        let on_sharp = (0..3).filter(|&i| !patch.smooth[i]).find_map(|i| {
            let ends = [ids[i], ids[(i + 1) % 3]];
            if !is_met(ends) {
                return None;
            }
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let along = (p - a).dot(b - a) / (b - a).length_squared();
            let rim = self.rims.rim(ends, solid, &self.complex.points);
            let off = p - (a + (b - a) * along);
            let bent = off.dot(rim.bend);
            let sideways = off - rim.bend * bent;
            // A vertex nearer to the curve than that is to its edge would make the facet between them steep: it is put on the curve, if
            // its own facets are larger than that.
            let near = match self.rims.has(v, own) {
                true => rim.sagitta * rim.twist,
                false => bent.abs().min(SLIGHT * self.shortest[v as usize]),
            };
            let is_on = along > 0.0
                && along < 1.0
                && bent.abs() <= UNSURE * rim.sagitta + self.equal
                && sideways.length() <= self.equal + near;
            is_on.then_some((Spot::Edge(i, along), sideways))
        });
        let beside = flat.distance(closest_point(flat, &corners));
        let at = match on_sharp {
            Some((at, _)) => at,
            None if is_beside => return None,
            None if beside == 0.0 => Spot::Inside,
            // Between the projections along two facets there is a gap where the surface is convex.
            None if beside <= UNSURE * self.curves.uncertain(t)
                && self.is_beyond_smooth(flat, t) =>
            {
                Spot::Inside
            }
            None => return None,
        };
        let touch = Touch {
            of: own,
            triangle: t,
            at,
            height: height.abs(),
            off: off / within,
            is_beside,
            sideways: on_sharp.map_or(DVec3::ZERO, |on| on.1),
        };
        Some((beside, off, touch))
    }

    /// Whether a point in the plane of a facet is beyond smooth edges of it only.
    fn is_beyond_smooth(&self, p: DVec3, t: u32) -> bool {
        let (corners, patch) = (self.complex.corners(t), self.patch(t));
        (0..3).all(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            patch.smooth[i] || (b - a).cross(p - a).dot(patch.normal) > 0.0
        })
    }
}

struct Finder<'a> {
    facets: Facets<'a>,
    /// Of vertices and solids: how far beside a facet and off its surface, and where.
    best: FxHashMap<[u32; 2], (f64, f64, Touch)>,
    same: DisjointSets,
    /// Pairs of facets that look at each other and both have sharp edges.
    both_sharp: Vec<[u32; 2]>,
}

impl Finder<'_> {
    fn pair(&mut self, [s, t]: [u32; 2]) {
        let facets = self.facets;
        let [own, other] = [s, t].map(|t| facets.patch(t));
        let turned = own.normal.dot(other.normal);
        if turned.abs() < FACING_COSINE {
            return;
        }
        self.corners(s, t);
        self.corners(t, s);
        if turned < 0.0 && [own, other].iter().all(|p| p.smooth != [true; 3]) {
            self.both_sharp.push([s.min(t), s.max(t)]);
        }
    }

    fn corners(&mut self, s: u32, t: u32) {
        let facets = self.facets;
        let complex = facets.complex;
        let ids = complex.triangles[t as usize];
        for (i, v) in complex.triangles[s as usize].into_iter().enumerate() {
            if ids.contains(&v) {
                continue;
            }
            let p = complex.points[v as usize];
            let near = |w: &u32| complex.points[*w as usize].distance(p) <= facets.equal;
            if let Some(w) = ids.into_iter().find(|w| near(w)) {
                self.same.join(v, w);
                continue;
            }
            let Some(new) = facets.place((s, i), t) else {
                continue;
            };
            let key = [v, facets.solid[t as usize]];
            let order = |a: &(f64, f64, Touch), b: &(f64, f64, Touch)| {
                let rank = |t: &Touch| (t.is_beside, t.off > 1.0, t.at == Spot::Inside);
                (rank(&a.2).cmp(&rank(&b.2)))
                    .then(a.0.total_cmp(&b.0))
                    .then(a.1.total_cmp(&b.1))
                    .then(a.2.triangle.cmp(&b.2.triangle))
                    .is_lt()
            };
            let best = self.best.entry(key).or_insert(new);
            if order(&new, best) {
                *best = new;
            }
        }
    }

    fn end(mut self) -> Touches {
        let crossed = self.crossed();
        Touches {
            of: self.best.into_iter().map(|(k, b)| (k, b.2)).collect(),
            same: self.same,
            crossed,
            solids: Vec::new(),
        }
    }

    /// Sharp edges that cross away from vertices that either has on the other one.
    fn crossed(&mut self) -> Vec<Crossed> {
        let facets = self.facets;
        let points = &facets.complex.points;
        let mut on: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
        for (&[v, solid], (_, _, touch)) in &self.best {
            if let Spot::Edge(i, _) = touch.at {
                let edge = facets.edge[touch.triangle as usize][i];
                on.entry([edge, solid]).or_default().push(v);
            }
        }
        let mut seen: FxHashSet<[u32; 2]> = FxHashSet::default();
        let mut crossed = Vec::new();
        self.both_sharp.sort_unstable();
        self.both_sharp.dedup();
        for &[s, t] in &self.both_sharp {
            let [own, other] = [s, t].map(|t| facets.patch(t));
            let solids = [s, t].map(|t| facets.solid[t as usize]);
            let within = facets.within(s, t);
            let reach = facets.curves.reach(s).max(facets.curves.reach(t));
            for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
                if own.smooth[i] || other.smooth[j] {
                    continue;
                }
                let [e, f] = [facets.edge[s as usize][i], facets.edge[t as usize][j]];
                let [mut p, mut q] = [e, f].map(|e| facets.edges.ends[e as usize]);
                let has = |edge: u32, solid: u32, ends: [u32; 2]| {
                    let on = on.get(&[edge, solid]);
                    on.is_some_and(|on| ends.iter().any(|v| on.contains(v)))
                };
                if e == f || has(e, solids[0], q) || has(f, solids[1], p) {
                    continue;
                }
                p = p.map(|v| self.same.find(v));
                q = q.map(|v| self.same.find(v));
                if p.iter().any(|v| q.contains(v)) {
                    continue;
                }
                let [p, q] =
                    [e, f].map(|e| facets.edges.ends[e as usize].map(|v| points[v as usize]));
                // They look at each other.
                let normal = own.normal - other.normal;
                let reach = reach.max(facets.equal);
                let Some(along) = crossing_along(normal, p, q, reach, facets.equal) else {
                    continue;
                };
                let [x, y] = [
                    p[0] + (p[1] - p[0]) * along[0],
                    q[0] + (q[1] - q[0]) * along[1],
                ];
                let over = |patch: &Patch, t: u32, i: usize, e: u32, along: f64| {
                    let start = facets.complex.triangles[t as usize][i];
                    let forward = facets.edges.ends[e as usize][0] == start;
                    patch.over_edge(i, if forward { along } else { 1.0 - along })
                };
                let first = over(own, s, i, e, along[0]);
                let second = over(other, t, j, f, along[1]);
                let apart = (x - y).dot(own.normal) + first + second;
                if apart.abs() <= UNSURE * within && seen.insert([e.min(f), e.max(f)]) {
                    crossed.push(Crossed {
                        edges: [e, f],
                        solids,
                        along,
                        place: if first.abs() <= second.abs() { x } else { y },
                    });
                }
            }
        }
        crossed
    }
}
