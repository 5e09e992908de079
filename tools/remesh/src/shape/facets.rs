//! What is beside facets: whether they are some of many that stand for something curved.

use super::allowance::outer;
use geom::edges::{EdgeUse, Edges};
use glam::{DMat3, DVec3};
use rustc_hash::FxHashMap;

/// A degree, in radians: what is bent by less may be the same face, however wide.
const SHALLOW: f64 = std::f64::consts::PI / 180.0;

/// How many times as far as it should the fold between two facets of a curve may turn: the widths of triangles are up to twice their mean, and one of two
/// sides may have all of the turn.
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

/// What is beside a facet. Lengths are in model units.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// Number of its triangles.
    pub triangles: u32,
    /// Length of its outline.
    pub border: f64,
    /// Length of the part beside which the surface goes on smoothly.
    pub smooth: f64,
    /// Length of the part of it beside which it goes on with a facet of half its width at least, across the edge, or turns as
    /// one curve does for the width of both, or is bent by less than a degree and does not rise far, unless a curve begins there.
    pub like: f64,
    /// The first of the facets beyond that part.
    pub first: Option<u32>,
    /// Whether there are others.
    pub more: bool,
}

/// A smooth edge between two facets.
struct Fold {
    facets: [u32; 2],
    /// How wide they are across the edge.
    widths: [f64; 2],
    /// Angle between them, radians.
    turn: f64,
    length: f64,
    /// Its unit direction.
    along: DVec3,
}

/// How facets turn at folds, and how wide they are there, by the direction of the fold, times length.
#[derive(Clone, Copy, Default)]
struct Bend {
    turned: DMat3,
    across: DMat3,
}

impl Bend {
    fn add(&mut self, fold: &Fold) {
        let outer = outer(fold.along);
        let mean = 0.5 * (fold.widths[0] + fold.widths[1]);
        self.turned += outer * (fold.turn * fold.length);
        self.across += outer * (mean * fold.length);
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
    /// What is beside each of so many facets; `mate` has the triangle that goes on smoothly beyond an edge.
    pub fn beside(
        &self,
        count: usize,
        mate: impl Fn(usize, &EdgeUse) -> Option<EdgeUse>,
    ) -> Vec<Beside> {
        let mut members = vec![Vec::new(); count];
        let mut beside = vec![Beside::default(); count];
        for (t, &facet) in self.of.iter().enumerate() {
            members[facet as usize].extend(self.triangles[t]);
            beside[facet as usize].triangles += 1;
        }
        let folds = self.folds(&members, mate, &mut beside);
        // What each facet does at its folds, in all and at those with each of the others beside it.
        let mut bends = vec![Bend::default(); count];
        let mut between: FxHashMap<[u32; 2], Bend> = FxHashMap::default();
        for fold in &folds {
            let [f, g] = fold.facets;
            between.entry([f.min(g), f.max(g)]).or_default().add(fold);
            bends[f as usize].add(fold);
            bends[g as usize].add(fold);
        }
        for fold in &folds {
            let &Fold { length, turn, .. } = fold;
            for [here, there] in [[0, 1], [1, 0]] {
                let [f, g] = [here, there].map(|i| fold.facets[i]);
                let [w, x] = [here, there].map(|i| fold.widths[i]);
                let goes_on = || {
                    let with = &between[&[f.min(g), f.max(g)]];
                    let beyond = bends[g as usize].curvature(with, fold.along);
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

    /// The folds between facets of so many members, and how long their borders are.
    fn folds(
        &self,
        members: &[Vec<u32>],
        mate: impl Fn(usize, &EdgeUse) -> Option<EdgeUse>,
        beside: &mut [Beside],
    ) -> Vec<Fold> {
        let mut folds = Vec::new();
        for edge in 0..self.edges.len() {
            let [a, b] = self.edges.ends[edge].map(|v| self.points[v as usize]);
            let length = a.distance(b);
            let along = (b - a).normalize_or_zero();
            let width = |facet: u32| {
                let points = members[facet as usize].iter();
                let off = points.map(|&v: &u32| (self.points[v as usize] - a).cross(along));
                off.map(DVec3::length).fold(0.0, f64::max)
            };
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
                folds.push(Fold {
                    facets: [f, g],
                    widths: [width(f), width(g)],
                    turn: libm::atan2(m.cross(n).length(), m.dot(n).abs()),
                    length,
                    along,
                });
            }
        }
        folds
    }
}
