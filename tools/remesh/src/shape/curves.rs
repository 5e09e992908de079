//! Curves: chains of feature edges between corners.

use super::Patches;
use super::arc::Arc;
use crate::input::{Rules, Surface};
use geom::sets::DisjointSets;
use rustc_hash::FxHashMap;
use std::collections::BinaryHeap;

/// The feature curves of a surface.
#[derive(Default)]
pub struct Curves {
    /// Feature edges, lower vertex first.
    pub ends: Vec<[u32; 2]>,
    /// Curve of each feature edge.
    pub of: Vec<u32>,
    /// Number of curves.
    pub count: usize,
    /// Of each vertex, the number of feature edges at it.
    pub degree: Vec<u32>,
    /// Of each vertex, whether it stays where it is because curves end or turn there.
    pub corner: Vec<bool>,
    /// How far the curve may be from each feature edge.
    pub reach: Vec<f64>,
    /// The arc that the curve follows at each vertex, if it is on one.
    pub arcs: Vec<Option<Arc>>,
    /// How far along the surface each feature edge may be off where it is drawn, for what coordinates tell, model units.
    uncertain: Vec<f64>,
}

impl Curves {
    /// Finds the feature edges: where patches meet, end, or are sharp.
    pub fn new(surface: &Surface, rules: &Rules<'_>, patches: &Patches) -> Self {
        let is_inner = |edge: &usize| patches.is_inner(surface, rules, *edge);
        let features: Vec<usize> = (0..patches.edges.len()).filter(|e| !is_inner(e)).collect();
        let ends: Vec<[u32; 2]> = features.iter().map(|&e| patches.edges.ends[e]).collect();
        let mut at = vec![Vec::new(); surface.points.len()];
        for (i, ends) in ends.iter().enumerate() {
            ends.iter().for_each(|&v| at[v as usize].push(i as u32));
        }
        let kind = |i: u32| {
            let around = patches.edges.around(features[i as usize]).iter();
            let mut of: Vec<u32> = around.map(|u| patches.of[u.triangle as usize]).collect();
            of.sort_unstable();
            of
        };
        let along = |i: u32, v: u32| {
            let [a, b] = ends[i as usize];
            let other = if a == v { b } else { a };
            surface.points[other as usize] - surface.points[v as usize]
        };
        let mut sets = DisjointSets::new(ends.len());
        let mut corner = vec![false; surface.points.len()];
        let mut turns: FxHashMap<u32, f64> = FxHashMap::default();
        for (v, here) in (0..).zip(&at) {
            let passes = match here[..] {
                [] => continue,
                [e, f] => {
                    let (p, q) = (along(e, v), along(f, v));
                    let straight = -p.normalize_or_zero().dot(q.normalize_or_zero());
                    turns.insert(v, libm::acos(straight.clamp(-1.0, 1.0)));
                    let bound = |i: u32| {
                        ends[i as usize]
                            .map(|v| rules.bound[v as usize])
                            .into_iter()
                            .fold(u32::MAX, |x, y| x & y)
                    };
                    straight >= rules.feature
                        && kind(e) == kind(f)
                        && bound(e) == rules.bound[v as usize]
                        && bound(f) == rules.bound[v as usize]
                }
                _ => false,
            };
            if passes {
                sets.join(here[0], here[1]);
            } else {
                corner[v as usize] = true;
            }
        }
        let mut curves = Self {
            degree: at.iter().map(|here| here.len() as u32).collect(),
            of: Vec::with_capacity(ends.len()),
            count: 0,
            reach: Vec::new(),
            uncertain: (features.iter())
                .map(|&edge| uncertainty(surface, rules, patches, edge))
                .collect(),
            arcs: vec![None; surface.points.len()],
            corner,
            ends,
        };
        let mut number = vec![u32::MAX; curves.ends.len()];
        for i in 0..curves.ends.len() as u32 {
            let first = sets.find(i) as usize;
            if number[first] == u32::MAX {
                number[first] = curves.count as u32;
                curves.count += 1;
            }
            curves.of.push(number[first]);
        }
        curves.allow(surface, rules, (&at, &turns));
        curves
    }

    /// Sets how far curves may be from their chords, and how long these are to be, from the arcs that they stand for: as those
    /// of [`super::Allowance`].
    fn allow(
        &mut self,
        surface: &Surface,
        rules: &Rules<'_>,
        (at, turns): (&[Vec<u32>], &FxHashMap<u32, f64>),
    ) {
        let length = |i: u32| {
            let [a, b] = self.ends[i as usize].map(|v| surface.points[v as usize]);
            a.distance(b)
        };
        // A turn beside an edge that is shorter than those around it moves the curve by less, and counts for less.
        let own = |v: u32, mean: f64| -> [f64; 3] {
            let here = || at[v as usize].iter().map(|&i| length(i));
            // What ends at a corner does not turn there, and other curves that end there are none of its length.
            if self.corner[v as usize] {
                return [0.0; 3];
            }
            let lengths = here().map(|length| 0.5 * length).sum();
            let counts = (here().fold(f64::INFINITY, f64::min) / mean).min(1.0);
            let turn = counts * turns.get(&v).copied().unwrap_or(0.0);
            [turn, turn * turn, lengths]
        };
        for (v, here) in (0..).zip(at) {
            if here.is_empty() || self.corner[v as usize] {
                continue;
            }
            // Over the neighbours, too: beside a short edge turns mean nothing.
            let beside = here.iter().flat_map(|&i| self.ends[i as usize]);
            let lengths = here.iter().flat_map(|&i| self.ends[i as usize]);
            let lengths = lengths.flat_map(|v| at[v as usize].iter().map(|&i| length(i)));
            let (sum, count) = lengths.fold((0.0, 0.0), |(s, n), l| (s + l, n + 1.0));
            let sums = beside
                .map(|v| own(v, sum / count))
                .fold([0.0; 3], |[a, b, c], [x, y, z]| [a + x, b + y, c + z]);
            let (angle, curvature) = (sums[1] / sums[0], sums[0] / sums[2]);
            let uncertain = here.iter().map(|&i| self.uncertain[i as usize]);
            let uncertain = ROUND * uncertain.fold(0.0, f64::max);
            if sums[0] > 0.0 && curvature > 0.0 && curvature * uncertain < 1.0 {
                self.arcs[v as usize] = Some(Arc { angle, curvature });
            }
        }
        self.reach = self.reaches(surface, rules, at);
    }

    /// How far curves may be from each feature edge: as far as the arcs at either end allow. The chords of an arc go on beyond its
    /// ends by up to their length, and how far the vertices there are from an arc cannot be told from a straight edge beside them that is
    /// many times as long: what an arc allows falls from its vertices to nothing over the length of its chords. n log n.
    fn reaches(&self, surface: &Surface, rules: &Rules<'_>, at: &[Vec<u32>]) -> Vec<f64> {
        let longest = rules.sizes.longest(surface);
        let own = |v: usize| {
            let (arc, deviation) = (self.arcs[v]?, rules.deviation_at(v));
            let height = arc.height(rules, longest[v], deviation);
            let size = arc.size(rules, longest[v], deviation);
            (height > 0.0).then_some((height, height / size))
        };
        let own: Vec<Option<(f64, f64)>> = (0..self.arcs.len()).map(own).collect();
        let mut beside = vec![0.0; own.len()];
        let mut settled = vec![false; own.len()];
        // Bits of positive numbers are in their order.
        let first = (0..).zip(&own).filter_map(|(v, own)| Some((v, (*own)?)));
        let mut heap: BinaryHeap<(u64, u32, u64)> = first
            .map(|(v, (height, slope))| (height.to_bits(), v, slope.to_bits()))
            .collect();
        while let Some((height, v, slope)) = heap.pop() {
            if std::mem::replace(&mut settled[v as usize], true) {
                continue;
            }
            // What is nearer to something else there allows less, whatever goes on beyond it.
            beside[v as usize] = f64::from_bits(height).min(rules.deviation_at(v as usize));
            // No chord goes around a corner.
            if self.corner[v as usize] {
                continue;
            }
            for &i in &at[v as usize] {
                let [a, b] = self.ends[i as usize].map(|v| surface.points[v as usize]);
                let left = f64::from_bits(height) - f64::from_bits(slope) * a.distance(b);
                if left > 0.0 {
                    let ends = self.ends[i as usize].into_iter();
                    let open = ends.filter(|&w| !settled[w as usize]);
                    heap.extend(open.map(|w| (left.to_bits(), w, slope)));
                }
            }
        }
        let reach = |(ends, uncertain): (&[u32; 2], &f64)| {
            let [a, b] = ends.map(|v| own[v as usize].map_or(0.0, |own| own.0));
            let [p, q] = ends.map(|v| beside[v as usize]);
            a.max(b).max(p.min(q)).max(rules.flat).max(*uncertain)
        };
        self.ends.iter().zip(&self.uncertain).map(reach).collect()
    }
}

/// Radius of an arc over how far it is from the corner that it rounds off, for a right angle.
const ROUND: f64 = std::f64::consts::SQRT_2 + 1.0;

/// How far along the surface a feature edge may be off where it is drawn, for what coordinates tell, model units: where a flat face and what is curved
/// go on smoothly, the facets between them that are in the plane but for what is uncertain belong to either.
fn uncertainty(surface: &Surface, rules: &Rules<'_>, patches: &Patches, edge: usize) -> f64 {
    let Some(both) = patches.smooth(surface, rules, edge) else {
        return 0.0;
    };
    let rise = libm::sin(patches.turn(surface, both).abs());
    let ends = patches.edges.ends[edge].map(|v| rules.deviation_at(v as usize));
    (rules.told() / rise).min(ends[0]).min(ends[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{Drawn, Sizes};
    use glam::DVec3;

    #[test]
    fn an_arc_is_one_up_to_where_a_long_straight_edge_begins() {
        // The border of a sheet: from a long edge over a quarter of a circle to another one.
        let chords = 256;
        let on_arc = |i: u32| {
            let angle = std::f64::consts::FRAC_PI_2 * f64::from(i) / f64::from(chords);
            DVec3::new(angle.sin(), angle.cos(), 0.0)
        };
        let mut points = vec![DVec3::new(-20.0, -20.0, 0.0), DVec3::new(-20.0, 1.0, 0.0)];
        points.extend((0..=chords).map(on_arc));
        points.push(DVec3::new(1.0, -20.0, 0.0));
        let last = points.len() as u32 - 1;
        let triangles: Vec<[u32; 3]> = (1..last).map(|v| [0, v + 1, v]).collect();
        let labels = vec![0; triangles.len()];
        let surface = Surface {
            points,
            triangles,
            labels,
        };
        let held = vec![false; surface.points.len()];
        let bound = vec![0; surface.points.len()];
        let usual = Rules {
            sharp: 0.0,
            drawn: Drawn::Roughly,
            held: &held,
            bound: &bound,
            links: &[],
            spaces: &[],
            onto: &|_, p| p,
            deviation: 0.1,
            nearer: &[],
            noise: 1e-6,
            flat: 1e-10,
            folds: 0.0,
            feature: 0.75_f64.sqrt(),
            sizes: Sizes {
                turn: std::f64::consts::TAU / 12.0,
                turn_is_asked: false,
                lengths: &[0.5],
                local: None,
                growth: 0.5,
            },
        };
        let reaches = |rules: &Rules<'_>| {
            let patches = Patches::new(&surface, rules);
            let curves = Curves::new(&surface, rules, &patches);
            [2 + chords / 2, 2, 1].map(|v| {
                let i = curves.ends.iter().position(|ends| *ends == [v, v + 1]);
                curves.reach[i.expect("a feature")]
            })
        };
        let [middle, first, straight] = reaches(&usual);
        assert!(first > 0.9 * middle, "{first} {middle}");
        assert!(straight < 0.5 * middle, "{straight} {middle}");
        // A wall begins with the arc.
        let mut nearer = vec![usual.deviation; surface.points.len()];
        (nearer[2], nearer[3]) = (1e-3, 1e-3);
        let nearer = &nearer;
        let [_, first, _] = reaches(&Rules { nearer, ..usual });
        assert!(first <= 1e-3, "{first}");
    }
}
