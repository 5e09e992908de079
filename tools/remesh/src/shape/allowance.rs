//! How far the shape may be from the triangles that stand for it, and how long edges are to be.

use super::arc::Arc;
use super::{Curves, Patches};
use crate::input::{Rules, Surface};
use geom::edges::{EdgeUse, apex_of};
use geom::eigen::symmetric;
use geom::measure::triangle_area;
use glam::{DMat3, DVec3};
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// What the facets of a surface hide.
pub struct Allowance {
    /// Of each triangle, how far the surface may be from it.
    pub reach: Vec<f64>,
    /// Of each vertex, the length of edges wanted there.
    pub size: Vec<f64>,
    /// Of each vertex, how wide facets are there as they are drawn.
    pub width: Vec<f64>,
}

/// How a surface bends around a vertex, times area.
#[derive(Clone, Copy)]
struct Bend {
    /// Sum of turn times length times the square of direction.
    tensor: DMat3,
    area: f64,
    /// Sum of the turns times length, and of their squares.
    turn: [f64; 2],
}

impl Bend {
    /// Flat, of no area.
    const NONE: Self = Self {
        tensor: DMat3::ZERO,
        area: 0.0,
        turn: [0.0; 2],
    };

    fn add(&mut self, other: &Self) {
        self.tensor += other.tensor;
        self.area += other.area;
        self.turn[0] += other.turn[0];
        self.turn[1] += other.turn[1];
    }

    /// The arc of the largest curvature.
    fn read(&self) -> Option<Arc> {
        let Self { tensor, area, turn } = self;
        let rows = tensor.transpose().to_cols_array_2d();
        let values = symmetric(rows).values;
        let largest = values.into_iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let (angle, curvature) = (turn[1] / turn[0], largest / area);
        let is_bent = turn[0] > 0.0 && *area > 0.0 && curvature > 0.0;
        is_bent.then_some(Arc { angle, curvature })
    }
}

impl Allowance {
    /// Measures a surface. A facet that turns by an angle along an arc of some curvature is as wide as their ratio, and hides
    /// the height of that arc above its chord. n log n.
    pub fn new(surface: &Surface, rules: &Rules<'_>, patches: &Patches, curves: &Curves) -> Self {
        let bent = bent(surface, rules, patches);
        let (mut bends, hidden) = bends(surface, rules, patches, &bent);
        // Once more over the neighbours: needles have normals that mean nothing.
        let mut around = vec![Bend::NONE; bends.len()];
        for t in curved(patches, &bent) {
            let corners = surface.triangles[t];
            for v in corners {
                for w in corners {
                    let bend = bends[w as usize];
                    around[v as usize].add(&bend);
                }
            }
        }
        std::mem::swap(&mut bends, &mut around);
        spread(&mut bends, &hidden, patches);
        let longest = rules.sizes.longest(surface);
        let mut size = longest.clone();
        let mut width = vec![f64::INFINITY; bends.len()];
        let mut height = vec![0.0_f64; bends.len()];
        for (v, bend) in bends.iter().enumerate() {
            let arc = bend.read();
            height[v] = arc.map_or(0.0, |arc| {
                arc.height(rules, longest[v], rules.deviation_at(v))
            });
            for arc in arc.into_iter().chain(curves.arcs[v]) {
                size[v] = size[v].min(arc.size(rules, longest[v], rules.deviation_at(v)));
                width[v] = width[v].min(arc.width());
            }
        }
        let reach = |t: usize| {
            let corners = surface.triangles[t].map(|v| height[v as usize]);
            let largest = corners.into_iter().fold(0.0, f64::max);
            match patches.planes[patches.of[t] as usize] {
                Some(_) => patches.off[patches.of[t] as usize],
                None if !bent[patches.of[t] as usize] => rules.noise,
                None => largest.max(rules.flat),
            }
        };
        Self {
            reach: (0..surface.triangles.len()).map(reach).collect(),
            size: graded(surface, rules, patches, size),
            width: graded(surface, rules, patches, width),
        }
    }
}

/// Of each patch, whether it bends: whether its triangles have directions that are apart by so much that, over its width, the
/// surface is farther than noise from a plane. Flat faces do not.
fn bent(surface: &Surface, rules: &Rules<'_>, patches: &Patches) -> Vec<bool> {
    let count = patches.planes.len();
    let widths = patches.widths(surface);
    let mut vector = vec![DVec3::ZERO; count];
    for (t, &patch) in patches.of.iter().enumerate() {
        let [a, b, c] = surface.corners(t as u32);
        vector[patch as usize] += patches.normals[t] * triangle_area(a, b, c);
    }
    let mut angle = vec![0.0_f64; count];
    for (t, &patch) in patches.of.iter().enumerate() {
        // Directions all around, as in a hole, have no mean.
        let off = match vector[patch as usize].try_normalize() {
            Some(mean) => {
                let normal = patches.normals[t];
                libm::atan2(mean.cross(normal).length(), mean.dot(normal))
            }
            None => std::f64::consts::PI,
        };
        angle[patch as usize] = angle[patch as usize].max(off);
    }
    let is_bent = |patch: usize| {
        // The height of a roof whose sides are off by that angle. What has no border is closed, and bends.
        let rise = 0.5 * widths[patch] * angle[patch];
        patches.planes[patch].is_none() && rise.is_nan() | (rise > rules.noise)
    };
    (0..count).map(is_bent).collect()
}

/// Triangles of patches that bend.
fn curved<'a>(patches: &'a Patches, bent: &'a [bool]) -> impl Iterator<Item = usize> + 'a {
    let all = 0..patches.of.len();
    all.filter(|&t| bent[patches.of[t] as usize])
}

/// A fold between facets of which one at least is curved.
struct Fold {
    ends: [u32; 2],
    along: DVec3,
    length: f64,
    turn: f64,
    /// What of the turn is more than coordinates are uncertain.
    told: f64,
    /// Width of the narrower triangle.
    width: f64,
    /// Curvature that coordinates hide there.
    hidden: f64,
    /// A patch that bends.
    patch: u32,
}

/// The folds of the curved patches.
fn folds(surface: &Surface, rules: &Rules<'_>, patches: &Patches, bent: &[bool]) -> Vec<Fold> {
    let is_curved = |t: u32| bent[patches.of[t as usize] as usize];
    let fold = |edge: usize| {
        let both = patches.smooth(surface, rules, edge)?;
        let ends = patches.edges.ends[edge];
        let [a, b] = ends.map(|v| surface.points[v as usize]);
        let width = |u: &EdgeUse| {
            let apex = apex_of(&surface.triangles[u.triangle as usize], u.corner);
            let apex = surface.points[apex as usize];
            (apex - a).cross((b - a).normalize_or_zero()).length()
        };
        let curved = || both.iter().filter(|u| is_curved(u.triangle));
        let patch = patches.of[curved().next()?.triangle as usize];
        let turn = patches.turn(surface, both);
        // Corners that are off by what counts as in one plane turn the triangles by as much over their width.
        let noise: f64 = both.iter().map(|u| rules.flat / width(u)).sum();
        Some(Fold {
            ends,
            along: (b - a).normalize_or_zero(),
            length: a.distance(b),
            turn,
            told: turn * (1.0 - (noise / turn).powi(2)).max(0.0),
            width: curved().map(width).fold(f64::INFINITY, f64::min),
            hidden: noise / both.iter().map(|u| 0.5 * width(u)).sum::<f64>(),
            patch,
        })
    };
    (0..patches.edges.len()).filter_map(fold).collect()
}

/// Takes of each fold what is told of its turn: at the poles of rounded corners facets are as thin as coordinates are uncertain, and
/// turn to and fro. What tells less of how it turns is taken as it is.
fn take_told(folds: &mut [Fold], patches: usize) {
    let tells = tells(folds, patches);
    for fold in folds {
        match tells[fold.patch as usize] {
            true => fold.turn = fold.told,
            false => fold.hidden = 0.0,
        }
    }
}

/// Of each patch, whether its folds tell at least half of how it turns.
fn tells(folds: &[Fold], patches: usize) -> Vec<bool> {
    let mut turns = vec![[0.0; 2]; patches];
    for fold in folds {
        let [all, told] = &mut turns[fold.patch as usize];
        *all += fold.turn.abs() * fold.length;
        *told += fold.told.abs() * fold.length;
    }
    turns
        .into_iter()
        .map(|[all, told]| told >= 0.5 * all)
        .collect()
}

/// Of each patch, whether it is drawn so finely that coordinates tell less than half of how it turns.
pub fn untold(surface: &Surface, rules: &Rules<'_>, patches: &Patches) -> Vec<bool> {
    let bent = bent(surface, rules, patches);
    let folds = folds(surface, rules, patches, &bent);
    let tells = tells(&folds, patches.planes.len());
    tells.into_iter().map(|tells| !tells).collect()
}

/// How the curved patches bend around each vertex. A fold beside a triangle that is narrower than those around it moves
/// the surface by less, and counts for less: at needles normals mean nothing. Also the curvature that coordinates hide around each vertex.
fn bends(
    surface: &Surface,
    rules: &Rules<'_>,
    patches: &Patches,
    bent: &[bool],
) -> (Vec<Bend>, Vec<f64>) {
    let mut folds = folds(surface, rules, patches, bent);
    take_told(&mut folds, patches.planes.len());
    let mut widths = vec![[0.0; 2]; surface.points.len()];
    for fold in &folds {
        for v in fold.ends {
            widths[v as usize][0] += fold.length * fold.width;
            widths[v as usize][1] += fold.length;
        }
    }
    let mut bends = vec![Bend::NONE; surface.points.len()];
    for t in curved(patches, bent) {
        let [a, b, c] = surface.corners(t as u32);
        for v in surface.triangles[t] {
            bends[v as usize].area += triangle_area(a, b, c) / 3.0;
        }
    }
    let mut hidden = vec![f64::INFINITY; surface.points.len()];
    for fold in &folds {
        for v in fold.ends {
            hidden[v as usize] = hidden[v as usize].min(fold.hidden);
        }
        let mean = fold.ends.map(|v| widths[v as usize]).into_iter();
        let [sum, length] = mean.fold([0.0; 2], |[s, l], [x, y]| [s + x, l + y]);
        let counts = (fold.width * length / sum).min(1.0);
        let turn = if sum > 0.0 { counts * fold.turn } else { 0.0 };
        for v in fold.ends {
            let bend = &mut bends[v as usize];
            bend.tensor += outer(fold.along) * (0.5 * turn * fold.length);
            bend.turn[0] += turn.abs() * fold.length;
            bend.turn[1] += turn * turn * fold.length;
        }
    }
    (bends, hidden)
}

/// Where nothing is told of how a surface bends, it bends as it does around, unless coordinates would tell that it does.
fn spread(bends: &mut [Bend], hidden: &[f64], patches: &Patches) {
    let may_take = |v: u32, bends: &[Bend]| {
        let hidden = hidden[v as usize];
        hidden > 0.0 && hidden.is_finite() && bends[v as usize].read().is_none()
    };
    let count = bends.len() as u32;
    let mut beside: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for v in (0..count).filter(|&v| may_take(v, bends)) {
        beside.insert(v, Vec::new());
    }
    if beside.is_empty() {
        return;
    }
    for &[a, b] in &patches.edges.ends {
        for [v, w] in [[a, b], [b, a]] {
            beside.entry(v).and_modify(|beside| beside.push(w));
        }
    }
    let mut open: Vec<u32> = beside.keys().copied().collect();
    open.sort_unstable();
    while !open.is_empty() {
        let taken = open.iter().filter_map(|v| {
            let mut sum = Bend::NONE;
            for w in &beside[v] {
                let bend = &bends[*w as usize];
                let arc = bend.read();
                if arc.is_some_and(|arc| arc.curvature <= hidden[*v as usize]) {
                    sum.add(bend);
                }
            }
            sum.read().map(|_| (*v, sum))
        });
        let taken: Vec<(u32, Bend)> = taken.collect();
        // What is beside one that has one now is next.
        open.clear();
        for (v, bend) in taken {
            bends[v as usize] = bend;
            open.extend(beside.remove(&v).unwrap_or_default());
        }
        open.sort_unstable();
        open.dedup();
        open.retain(|v| beside.contains_key(v));
    }
}

/// The matrix of the products of a vector's components.
pub(super) fn outer(a: DVec3) -> DMat3 {
    DMat3::from_cols(a * a.x, a * a.y, a * a.z)
}

/// Lets sizes grow from the smaller ones, at most to that of the surface.
fn graded(surface: &Surface, rules: &Rules<'_>, patches: &Patches, mut size: Vec<f64>) -> Vec<f64> {
    let mut at = vec![Vec::new(); size.len()];
    for &[a, b] in &patches.edges.ends {
        at[a as usize].push(b);
        at[b as usize].push(a);
    }
    let finite = (0..size.len()).filter(|&v| size[v].is_finite());
    let mut heap: BinaryHeap<Reverse<(u64, u32)>> = finite
        .map(|v| Reverse((size[v].to_bits(), v as u32)))
        .collect();
    // Bits of positive numbers are in their order.
    while let Some(Reverse((bits, v))) = heap.pop() {
        if size[v as usize].to_bits() != bits {
            continue;
        }
        for &w in &at[v as usize] {
            let distance = surface.points[v as usize].distance(surface.points[w as usize]);
            let longest = size[v as usize] + rules.sizes.growth * distance;
            if longest < size[w as usize] {
                size[w as usize] = longest;
                heap.push(Reverse((longest.to_bits(), w)));
            }
        }
    }
    let low = surface.points.iter().copied().reduce(DVec3::min);
    let high = surface.points.iter().copied().reduce(DVec3::max);
    let largest = low.zip(high).map_or(0.0, |(a, b)| a.distance(b));
    size.iter_mut().for_each(|size| *size = size.min(largest));
    size
}
