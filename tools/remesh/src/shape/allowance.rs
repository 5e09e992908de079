//! How far the shape may be from the triangles that stand for it, and how long edges are to be.

use super::arc::Arc;
use super::{Curves, Patches};
use crate::input::{Rules, Surface};
use geom::edges::{EdgeUse, apex_of};
use geom::eigen::symmetric;
use geom::measure::triangle_area;
use glam::{DMat3, DVec3};
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

/// By how much lengths of edges grow over a distance: such that each of a row of edges is half as long again as the one
/// before.
const GRADING: f64 = 0.5;

/// How a surface bends around a vertex, times area.
#[derive(Clone, Copy, Default)]
struct Bend {
    /// Sum of turn times length times the square of direction.
    tensor: DMat3,
    area: f64,
    /// Sum of the turns times length, and of their squares.
    turn: [f64; 2],
}

impl Bend {
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
        let mut bends = bends(surface, rules, patches);
        // Once more over the neighbours: needles have normals that mean nothing.
        let mut around = vec![Bend::default(); bends.len()];
        for t in curved(surface, patches) {
            let corners = surface.triangles[t];
            for v in corners {
                for w in corners {
                    let bend = bends[w as usize];
                    around[v as usize].add(&bend);
                }
            }
        }
        std::mem::swap(&mut bends, &mut around);
        let mut size = vec![f64::INFINITY; bends.len()];
        let mut width = size.clone();
        let mut height = vec![0.0_f64; bends.len()];
        for (v, bend) in bends.iter().enumerate() {
            let arc = bend.read();
            height[v] = arc.map_or(0.0, |arc| arc.height(rules));
            for arc in arc.into_iter().chain(curves.arcs[v]) {
                size[v] = size[v].min(arc.size(rules));
                width[v] = width[v].min(arc.width());
            }
        }
        let reach = |t: usize| {
            let corners = surface.triangles[t].map(|v| height[v as usize]);
            let largest = corners.into_iter().fold(0.0, f64::max);
            match patches.planes[patches.of[t] as usize] {
                Some(_) => rules.flat,
                None => largest.min(rules.deviation).max(rules.flat),
            }
        };
        Self {
            reach: (0..surface.triangles.len()).map(reach).collect(),
            size: graded(surface, patches, size),
            width: graded(surface, patches, width),
        }
    }
}

/// Triangles that are not part of flat faces.
fn curved(surface: &Surface, patches: &Patches) -> impl Iterator<Item = usize> {
    let all = 0..surface.triangles.len();
    all.filter(|&t| patches.planes[patches.of[t] as usize].is_none())
}

/// A fold between facets of which one at least is curved.
struct Fold {
    ends: [u32; 2],
    along: DVec3,
    length: f64,
    turn: f64,
    /// Width of the narrower triangle.
    width: f64,
}

/// The folds of the curved patches.
fn folds(surface: &Surface, rules: &Rules<'_>, patches: &Patches) -> Vec<Fold> {
    let is_curved = |t: u32| patches.planes[patches.of[t as usize] as usize].is_none();
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
        curved().next()?;
        Some(Fold {
            ends,
            along: (b - a).normalize_or_zero(),
            length: a.distance(b),
            turn: patches.turn(surface, both),
            width: curved().map(width).fold(f64::INFINITY, f64::min),
        })
    };
    (0..patches.edges.len()).filter_map(fold).collect()
}

/// How the curved patches bend around each vertex. A fold beside a triangle that is narrower than those around it moves
/// the surface by less, and counts for less: at needles normals mean nothing.
fn bends(surface: &Surface, rules: &Rules<'_>, patches: &Patches) -> Vec<Bend> {
    let folds = folds(surface, rules, patches);
    let mut widths = vec![[0.0; 2]; surface.points.len()];
    for fold in &folds {
        for v in fold.ends {
            widths[v as usize][0] += fold.length * fold.width;
            widths[v as usize][1] += fold.length;
        }
    }
    let mut bends = vec![Bend::default(); surface.points.len()];
    for t in curved(surface, patches) {
        let [a, b, c] = surface.corners(t as u32);
        for v in surface.triangles[t] {
            bends[v as usize].area += triangle_area(a, b, c) / 3.0;
        }
    }
    for fold in &folds {
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
    bends
}

fn outer(a: DVec3) -> DMat3 {
    DMat3::from_cols(a * a.x, a * a.y, a * a.z)
}

/// Lets sizes grow from the smaller ones.
fn graded(surface: &Surface, patches: &Patches, mut size: Vec<f64>) -> Vec<f64> {
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
            let longest = size[v as usize] + GRADING * distance;
            if longest < size[w as usize] {
                size[w as usize] = longest;
                heap.push(Reverse((longest.to_bits(), w)));
            }
        }
    }
    size
}
