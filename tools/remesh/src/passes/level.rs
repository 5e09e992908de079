//! Bringing flat faces to one level that are nearly in one plane.

use super::contract::contracted;
use super::crossings::crossings;
use super::meet::{bounds, onto_all};
use super::reduced::Reduced;
use super::remeshed::{Remeshed, Told};
use super::slender::by_facet;
use super::worth::{LEVEL, WORTH};
use crate::input::{Rules, Surface};
use crate::mesh::NONE;
use crate::shape::Patches;
use geom::edges::EdgeUse;
use geom::flat::FOLD_COSINE;
use geom::measure::triangle_area;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Attempts, each without the faces where the one before could not join what meets.
const ATTEMPTS: usize = 4;

/// Moves flat faces beside lower or higher ones that are larger, where a step between both is no higher than half of what the surface may move, into the plane
/// of these, so that the step is gone: the mark on a case, the foot of a terminal, a seam between halves of a mould. All other flat faces keep
/// their planes. `None` where there are none, and where what is left is no better. n log n.
///
/// Joining features cannot do it: vertices of flat faces stay in their planes, and planes that are parallel have no point in common.
pub fn leveled(surface: &Surface, rules: &Rules<'_>) -> Option<Reduced> {
    // The deviation is as wide as lengths asked for allow then, and who draws exactly gets what was drawn.
    if rules.drawn.is_exact() && rules.sizes.are_asked() {
        return None;
    }
    let patches = Patches::of_facets(surface, rules);
    let mut levels = Levels::new(surface, rules, &patches)?;
    let (places, mut remeshed) = (0..ATTEMPTS).find_map(|_| {
        let places = levels.places();
        match contracted(surface, rules, &patches, &places) {
            Ok(remeshed) => {
                let crossing = crossings(&remeshed.surface, rules);
                for (v, p) in (0..).zip(&places) {
                    if crossing.iter().any(|(at, size)| p.distance(*at) <= *size) {
                        levels.leave(v);
                    }
                }
                crossing.is_empty().then_some((places, remeshed))
            }
            Err(around) => {
                for v in around {
                    levels.leave(v);
                }
                None
            }
        }
    })?;
    let moves = |v: usize| surface.points[v].distance(places[v]);
    remeshed.told = Told {
        moved: (0..places.len()).filter(|&v| moves(v) > 0.0).count(),
        ..remeshed.told
    };
    let worth = if rules.drawn.is_exact() { WORTH } else { 1.0 };
    let [before, after] = costs(surface, rules, &patches, (&remeshed, moves));
    if after >= worth * before {
        return None;
    }
    // What was moved may move as much less, and so may all that is beside it.
    let mut nearer: Vec<f64> = (0..places.len()).map(|v| rules.deviation_at(v)).collect();
    for corners in &surface.triangles {
        let farthest = corners
            .map(|v| moves(v as usize))
            .into_iter()
            .fold(0.0, f64::max);
        for &v in corners {
            let most = rules.deviation_at(v as usize) - farthest;
            nearer[v as usize] = nearer[v as usize].min(most);
        }
    }
    Some(Reduced::new(remeshed, rules, &nearer))
}

/// What the facets cost at which something was moved, before and after.
fn costs(
    surface: &Surface,
    rules: &Rules<'_>,
    patches: &Patches,
    (remeshed, moves): (&Remeshed, impl Fn(usize) -> f64),
) -> [f64; 2] {
    let left = &remeshed.surface;
    let mut is_moved = [
        vec![false; surface.points.len()],
        vec![false; left.points.len()],
    ];
    for (v, &new) in remeshed.vertices.iter().enumerate() {
        if moves(v) > 0.0 {
            is_moved[0][v] = true;
            if new != NONE {
                is_moved[1][new as usize] = true;
            }
        }
    }
    let facets = Patches::of_facets(left, rules).facet;
    let both = [(surface, &patches.facet), (left, &facets)];
    let mut costs = [0.0; 2];
    for (((surface, facets), is_moved), cost) in both.into_iter().zip(is_moved).zip(&mut costs) {
        let all = surface.triangles.iter().zip(facets);
        let touched = all.filter(|(corners, _)| corners.iter().any(|&v| is_moved[v as usize]));
        let touched: FxHashSet<u32> = touched.map(|(_, facet)| *facet).collect();
        let each = by_facet(&surface.points, &surface.triangles, facets);
        let each = (0..).zip(each).filter(|(facet, _)| touched.contains(facet));
        *cost = each.map(|(_, cost)| cost).sum();
    }
    costs
}

/// What is next to a narrow face around an edge.
#[derive(Clone, Copy, PartialEq)]
struct Beside {
    face: u32,
    /// Whether it is on the front of the narrow face, and that on the front of it.
    sides: [bool; 2],
}

/// The flat faces of a surface with the planes that they get.
struct Levels<'a> {
    surface: &'a Surface,
    rules: &'a Rules<'a>,
    patches: &'a Patches,
    /// Of each face, the one whose plane it gets: mostly itself.
    plane_of: Vec<u32>,
    /// Whether each face is no wider than the surface may move.
    is_narrow: Vec<bool>,
    /// The faces around each vertex, increasing.
    around: Vec<Vec<u32>>,
    /// The vertices of each face that gets another plane, or got one.
    vertices: FxHashMap<u32, Vec<u32>>,
}

impl<'a> Levels<'a> {
    /// Finds steps. `None` where there are none.
    fn new(surface: &'a Surface, rules: &'a Rules<'a>, patches: &'a Patches) -> Option<Self> {
        let strips = patches.strips(surface, rules);
        if !strips.contains(&true) {
            return None;
        }
        let mut around = vec![Vec::new(); surface.points.len()];
        for (corners, &face) in surface.triangles.iter().zip(&patches.of) {
            corners.iter().for_each(|&v| around[v as usize].push(face));
        }
        for faces in &mut around {
            faces.sort_unstable();
            faces.dedup();
        }
        let mut levels = Self {
            surface,
            rules,
            patches,
            plane_of: (0..patches.planes.len() as u32).collect(),
            is_narrow: strips,
            around,
            vertices: FxHashMap::default(),
        };
        levels.find();
        (!levels.vertices.is_empty()).then_some(levels)
    }

    /// Gives faces beside a step the plane of the largest one across it.
    fn find(&mut self) {
        let faces = self.patches.planes.len();
        let mut area = vec![0.0; faces];
        for (t, &face) in (0..).zip(&self.patches.of) {
            let [a, b, c] = self.surface.corners(t);
            area[face as usize] += triangle_area(a, b, c);
        }
        let is_cut = self.patches.cut(self.surface, self.rules);
        let pairs = self.across_steps();
        let corners = pairs.iter().flatten().copied().collect();
        self.vertices = self.vertices_of(&corners);
        let mut found: Vec<[u32; 2]> = Vec::new();
        for [f, g] in pairs {
            let is_smaller = (area[f as usize], g) < (area[g as usize], f);
            let pair = if is_smaller { [f, g] } else { [g, f] };
            if !is_cut[f as usize] && !is_cut[g as usize] && self.may_get(pair) {
                found.push(pair);
            }
        }
        // The largest first, so that what a face gets is known when a smaller one gets the same.
        let place = |face: u32| (-area[face as usize], face);
        found.sort_by(|x, y| {
            let [x, y] = [x, y].map(|[f, g]| (place(*f), place(*g)));
            x.partial_cmp(&y).unwrap_or(std::cmp::Ordering::Equal)
        });
        for [f, g] in found {
            let first = self.plane_of[g as usize];
            if self.plane_of[f as usize] == f && self.may_get([f, first]) {
                self.plane_of[f as usize] = first;
            }
        }
        self.vertices
            .retain(|&face, _| self.plane_of[face as usize] != face);
    }

    /// Pairs of faces that face the same side, which one side of a narrow one leads to with the same side of theirs: beside corners of one of
    /// its triangles.
    fn across_steps(&self) -> FxHashSet<[u32; 2]> {
        let mut beside: FxHashMap<(u32, u32), Vec<Beside>> = FxHashMap::default();
        for (edge, ends) in self.patches.edges.ends.iter().enumerate() {
            for (narrow, known) in self.beside(edge) {
                for &v in ends {
                    let all = beside.entry((narrow, v)).or_default();
                    if !all.contains(&known) {
                        all.push(known);
                    }
                }
            }
        }
        let normal = |f: u32| self.patches.planes[f as usize].map_or(DVec3::ZERO, |p| p.normal);
        let mut pairs = FxHashSet::default();
        for (corners, &face) in self.surface.triangles.iter().zip(&self.patches.of) {
            let at = |v: u32| beside.get(&(face, v)).map_or(&[][..], Vec::as_slice);
            for [v, w] in [[0, 1], [1, 2], [2, 0]].map(|e| e.map(|i: usize| corners[i])) {
                for x in at(v) {
                    for y in at(w).iter().filter(|y| y.sides == x.sides) {
                        let [f, g] = [x.face, y.face];
                        if f != g && normal(f).dot(normal(g)) >= FOLD_COSINE {
                            pairs.insert([f.min(g), f.max(g)]);
                        }
                    }
                }
            }
        }
        pairs
    }

    /// The narrow faces at an edge, each with what is next to it around the edge on either side.
    fn beside(&self, edge: usize) -> Vec<(u32, Beside)> {
        let of = |u: &EdgeUse| self.patches.of[u.triangle as usize];
        let edges = &self.patches.edges;
        let around = edges.around(edge);
        if !around.iter().any(|u| self.is_narrow[of(u) as usize]) {
            return Vec::new();
        }
        let around = edges.sorted_around(edge, &self.surface.triangles, &self.surface.points);
        let mut found = Vec::new();
        for (i, first) in around.iter().enumerate() {
            // What runs along the edge has its front where angles grow.
            let second = &around[(i + 1) % around.len()];
            let sides = [first.forward, !second.forward];
            let [f, g] = [of(first), of(second)];
            if f != g {
                found.push((f, Beside { face: g, sides }));
                let sides = [sides[1], sides[0]];
                found.push((g, Beside { face: f, sides }));
            }
        }
        found.retain(|(face, _)| self.is_narrow[*face as usize]);
        found
    }

    /// The vertices of some faces.
    fn vertices_of(&self, faces: &FxHashSet<u32>) -> FxHashMap<u32, Vec<u32>> {
        let mut vertices: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for (v, around) in (0..).zip(&self.around) {
            for face in around.iter().filter(|face| faces.contains(face)) {
                vertices.entry(*face).or_default().push(v);
            }
        }
        vertices
    }

    /// Whether a face may get the plane of another one: whether it is off that, and no farther than a step may be high.
    fn may_get(&self, [face, other]: [u32; 2]) -> bool {
        let Some(plane) = self.patches.planes[other as usize] else {
            return false;
        };
        let off = |v: &u32| plane.height(self.surface.points[*v as usize]).abs();
        let mut is_off = false;
        let is_near = self.vertices[&face].iter().all(|v| {
            is_off |= off(v) > self.rules.flat;
            off(v) <= LEVEL * self.rules.deviation_at(*v as usize)
        });
        is_near && is_off
    }

    /// Leaves the faces around a vertex as they are. Returns their vertices, of those that were to be moved.
    fn leave(&mut self, v: u32) -> Vec<u32> {
        let mut again = Vec::new();
        for &face in &self.around[v as usize] {
            if self.plane_of[face as usize] != face {
                self.plane_of[face as usize] = face;
                again.extend(&self.vertices[&face]);
            }
        }
        again
    }

    /// Where the vertices are when all faces are in the planes that they get. Faces with vertices that cannot get there, or not together with their
    /// images, are left as they are.
    fn places(&mut self) -> Vec<DVec3> {
        let mut places = self.surface.points.clone();
        let mut open: Vec<u32> = self.vertices.values().flatten().copied().collect();
        open.sort_unstable();
        open.dedup();
        while !open.is_empty() {
            while let Some(v) = open.pop() {
                match self.place(v) {
                    Some(place) => places[v as usize] = place,
                    None => open.extend(self.leave(v)),
                }
            }
            open = self.apart_from_images(&places);
        }
        places
    }

    /// Leaves the faces around vertices that are not where their images are to be, but for rounding, and around those that are their own images. Returns what is to
    /// be placed anew.
    fn apart_from_images(&mut self, places: &[DVec3]) -> Vec<u32> {
        let mut again = Vec::new();
        for link in self.rules.links {
            for &pair in &link.pairs {
                let moves = |v: u32| places[v as usize] != self.surface.points[v as usize];
                let [p, q] = pair.map(|v| places[v as usize]);
                let is_apart = (link.image)(p).distance(q) > self.rules.flat;
                if pair.into_iter().any(moves) && (is_apart || pair[0] == pair[1]) {
                    pair.iter().for_each(|&v| again.extend(self.leave(v)));
                }
            }
        }
        again
    }

    /// Where a vertex is in the planes that the faces around it get: in those of all, or if that is too far away, of all that are not narrow.
    fn place(&self, v: u32) -> Option<DVec3> {
        let faces = &self.around[v as usize];
        let own = self.surface.points[v as usize];
        let is_moved = |f: &u32| self.plane_of[*f as usize] != *f;
        if !faces.iter().any(is_moved) {
            return Some(own);
        }
        let bound = self.rules.bound[v as usize];
        let most = LEVEL * self.rules.deviation_at(v as usize);
        let within = |counts: &dyn Fn(&u32) -> bool| {
            let mut planes: Vec<u32> = faces
                .iter()
                .filter(|f| counts(f))
                .map(|&f| self.plane_of[f as usize])
                .collect();
            // Those that others are moved to first: along narrow ones they get there.
            planes.sort_by_key(|&f| (self.is_narrow[f as usize], f));
            planes.dedup();
            let planes = planes
                .iter()
                .filter_map(|&f| self.patches.planes[f as usize]);
            let all = bounds(self.rules, bound, own).into_iter();
            let all = all.chain(planes.clone().map(|plane| (plane.normal, plane.origin)));
            let place = self.rules.put(bound, onto_all(own, all))?;
            let mut planes = planes;
            let is_there = planes.all(|plane| plane.height(place).abs() <= self.rules.flat);
            let moved = own.distance(place);
            let may = moved <= most && (moved == 0.0 || !self.rules.held[v as usize]);
            (is_there && may).then_some(place)
        };
        within(&|_| true).or_else(|| within(&|f| !self.is_narrow[*f as usize] || is_moved(f)))
    }
}
