//! Facets and the folds between them: whether they are some of many that stand for something curved.

use super::allowance::outer;
use super::beside::Beside;
use super::beyond::{Beyond, Part};
use geom::edges::{EdgeUse, Edges};
use geom::measure::triangle_area;
use glam::{DMat3, DVec3};
use rustc_hash::FxHashMap;

/// A degree, in radians: what is bent by less may be the same face, however wide.
const SHALLOW: f64 = std::f64::consts::PI / 180.0;

/// How many times as far as it should the fold between two facets of a curve may turn: beside triangles the curvature is up to twice what is told of it, and one of
/// two sides may have all of the turn.
const SPREAD: f64 = 4.0;

/// Sets of triangles in one plane each.
pub struct Facets<'a> {
    /// Positions, model units.
    pub points: &'a [DVec3],
    /// Vertex ids.
    pub triangles: &'a [[u32; 3]],
    /// Unit normals of the triangles.
    pub normals: &'a [DVec3],
    /// Edges of the triangles.
    pub edges: &'a Edges,
    /// Facet of each triangle.
    pub of: &'a [u32],
    /// How far something curved may rise above its chords, model units, that goes on beside a wider facet: the facet would turn on
    /// both sides as it does at the edge between. Of what rises more the facet is no part: it is flat, and a fine drawing of a
    /// rounding begins beside it; of what rises less, where what is beside it does not say so.
    pub rise: f64,
}

/// A smooth edge between two facets.
struct Fold {
    facets: [u32; 2],
    /// How wide they are across the edge, in the mean along it.
    widths: [f64; 2],
    /// How wide they are at most.
    most: [f64; 2],
    /// Angle between them, radians.
    turn: f64,
    length: f64,
    /// Its unit direction, as it is of either.
    along: [DVec3; 2],
}

impl Fold {
    /// Which of both facets have it beside them: one that ends beside its own image has it once.
    fn sides(&self) -> &'static [[usize; 2]] {
        match self.facets[0] == self.facets[1] {
            true => &[[0, 1]],
            false => &[[0, 1], [1, 0]],
        }
    }
}

/// How facets turn at folds, and how wide they are there at most, by the direction of the fold, times length: between triangles side by side the curvature is up
/// to twice as large as that tells, and nowhere smaller.
#[derive(Clone, Copy, Default)]
struct Bend {
    turned: DMat3,
    across: DMat3,
}

impl Bend {
    fn add(&mut self, fold: &Fold, along: DVec3) {
        let outer = outer(along);
        let most = 0.5 * (fold.most[0] + fold.most[1]);
        self.turned += outer * (fold.turn * fold.length);
        self.across += outer * (most * fold.length);
    }

    /// Curvature across a direction at all folds but some.
    fn curvature(&self, but: &Self, along: DVec3) -> Option<f64> {
        let part = |all: DMat3, but: DMat3| along.dot((all - but) * along);
        let [turned, across] = [part(self.turned, but.turned), part(self.across, but.across)];
        let in_all = along.dot(self.across * along);
        // What is left may be rounding.
        (across > f64::EPSILON.sqrt() * in_all).then_some(turned / across)
    }
}

/// Whether a facet of some width is one of those of a curve, as what is beside it is, which has a width and, beyond, a
/// curvature. The fold between them then turns as far as the curve over half of either width. Beside a flat face, it turns
/// over half of the other facet's width only: half way between decides. And it turns no more than [`SPREAD`] times as far as it
/// should.
fn is_one_curve(turn: f64, [width, beside]: [f64; 2], curvature: f64) -> bool {
    let flat = 0.5 * curvature * beside;
    let curved = 0.5 * curvature * (width + beside);
    (0.5 * (flat + curved)..=SPREAD * curved).contains(&turn)
}

/// Whether a curve begins beside a facet that is flat: whether the fold between them turns as far as the curve over half of the width of what is beside
/// it, within as much as widths of triangles tell, and far from what it would if the facet were part of the curve.
fn begins_curve(turn: f64, [width, beside]: [f64; 2], curvature: f64) -> bool {
    let flat = 0.5 * curvature * beside;
    let curved = 0.5 * curvature * (width + beside);
    (flat / SPREAD..=SPREAD * flat).contains(&turn) && turn < curved / SPREAD
}

impl Facets<'_> {
    /// What is beside each of so many facets; `mate` has the triangle that goes on smoothly beyond an edge, and `beyond` what is where the surface was cut.
    pub fn beside(
        &self,
        count: usize,
        mate: impl Fn(usize, &EdgeUse) -> Option<EdgeUse>,
        beyond: &Beyond<'_>,
    ) -> Vec<Beside> {
        let mut beside = vec![Beside::default(); count];
        for &facet in self.of.iter().chain(&beyond.images) {
            beside[facet as usize].triangles += 1;
        }
        let folds = self.folds((&self.members(count, beyond), beyond), mate, &mut beside);
        for &(facet, length) in &beyond.inner {
            beside[facet as usize].border -= length;
        }
        // What each facet does at its folds, in all and at those with each of the others beside it.
        let mut bends = vec![Bend::default(); count];
        let mut between: FxHashMap<[u32; 2], Bend> = FxHashMap::default();
        for fold in &folds {
            for &[here, there] in fold.sides() {
                let facets = [here, there].map(|i| fold.facets[i]);
                between
                    .entry(facets)
                    .or_default()
                    .add(fold, fold.along[here]);
                bends[facets[0] as usize].add(fold, fold.along[here]);
            }
        }
        let mut parts: FxHashMap<u32, Vec<&Part<'_>>> = FxHashMap::default();
        for part in &beyond.parts {
            parts.entry(part.other).or_default().push(part);
        }
        for fold in folds.iter().filter(|_| !parts.is_empty()) {
            for &[here, _] in fold.sides() {
                for part in parts.get(&fold.facets[here]).into_iter().flatten() {
                    let along = (part.place)(fold.along[here]) - (part.place)(DVec3::ZERO);
                    bends[part.facet as usize].add(fold, along);
                }
            }
        }
        for fold in &folds {
            let &Fold { length, turn, .. } = fold;
            for &[here, there] in fold.sides() {
                let [f, g] = [here, there].map(|i| fold.facets[i]);
                let [w, x] = [here, there].map(|i| fold.widths[i]);
                let goes_on = || {
                    let with = &between[&[g, f]];
                    let beyond = bends[g as usize].curvature(with, fold.along[there]);
                    let is = |fits: fn(f64, [f64; 2], f64) -> bool| {
                        beyond.is_some_and(|beyond| fits(turn, [w, x], beyond))
                    };
                    let is_shallow = turn <= SHALLOW && 0.25 * turn * w <= self.rise;
                    is(is_one_curve) || is_shallow && !is(begins_curve)
                };
                let facet = &mut beside[f as usize];
                facet.smooth += length;
                if w <= 2.0 * x || goes_on() {
                    facet.like += length;
                    facet.more |= facet.first.is_some_and(|first| first != g);
                    facet.first.get_or_insert(g);
                }
            }
        }
        beside
    }

    /// The corners of the triangles of so many facets, with those of their parts beyond the cuts.
    fn members(&self, count: usize, beyond: &Beyond<'_>) -> Vec<Vec<DVec3>> {
        let mut members = vec![Vec::new(); count];
        for (corners, &facet) in self.triangles.iter().zip(self.of) {
            let corners = corners.iter().map(|&v| self.points[v as usize]);
            members[facet as usize].extend(corners);
        }
        let there = beyond.parts.iter().map(|part| {
            let there = members[part.other as usize].iter();
            (part.facet, there.map(|&p| (part.place)(p)).collect())
        });
        let there: Vec<(u32, Vec<DVec3>)> = there.collect();
        for (facet, there) in there {
            members[facet as usize].extend(there);
        }
        members
    }

    /// The folds between facets of such members, and how long their borders are.
    fn folds(
        &self,
        (members, beyond): (&[Vec<DVec3>], &Beyond<'_>),
        mate: impl Fn(usize, &EdgeUse) -> Option<EdgeUse>,
        beside: &mut [Beside],
    ) -> Vec<Fold> {
        let area = |corners: &Vec<DVec3>| -> f64 {
            let triangles = corners.as_chunks::<3>().0.iter();
            triangles.map(|&[a, b, c]| triangle_area(a, b, c)).sum()
        };
        let areas: Vec<f64> = members.iter().map(area).collect();
        let fold = |facets: [u32; 2], here: [[DVec3; 2]; 2], turn: f64| {
            let along = here.map(|[a, b]| (b - a).normalize_or_zero());
            let widths = [0, 1].map(|side| {
                let (facet, along) = (facets[side] as usize, along[side]);
                let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
                let mut most = 0.0_f64;
                for &p in &members[facet] {
                    let place = p.dot(along);
                    ends = [ends[0].min(place), ends[1].max(place)];
                    most = most.max((p - here[side][0]).cross(along).length());
                }
                (areas[facet] / (ends[1] - ends[0]), most)
            });
            Fold {
                facets,
                widths: widths.map(|w| w.0),
                most: widths.map(|w| w.1),
                turn,
                length: here[0][0].distance(here[0][1]),
                along,
            }
        };
        let mut folds = Vec::new();
        for edge in 0..self.edges.len() {
            let ends = self.edges.ends[edge].map(|v| self.points[v as usize]);
            let length = ends[0].distance(ends[1]);
            for u in self.edges.around(edge) {
                let f = self.of[u.triangle as usize];
                let Some(v) = mate(edge, u) else {
                    beside[f as usize].border += length;
                    continue;
                };
                let g = self.of[v.triangle as usize];
                // Once for both.
                if f == g || (v.triangle, v.corner) < (u.triangle, u.corner) {
                    continue;
                }
                let [m, n] = [u, &v].map(|u| self.normals[u.triangle as usize]);
                for f in [f, g] {
                    beside[f as usize].border += length;
                }
                let turn = libm::atan2(m.cross(n).length(), m.dot(n).abs());
                folds.push(fold([f, g], [ends; 2], turn));
            }
        }
        let there = beyond.folds.iter();
        folds.extend(there.map(|there| fold(there.facets, there.ends, there.turn)));
        folds
    }
}
