//! Parts of two solids' surfaces that have the same border, with nothing between them.

use super::skin::Skin;
use super::touch::{Facets, Touches};
use geom::measure::{tet_volume, triangle_area};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// A part of a solid's surface.
struct Part {
    facets: Vec<u32>,
    /// Its edges that the other solid has as well, as its facets run, in order.
    border: Vec<[u32; 2]>,
}

/// Facets of one solid that take the place of another one's.
pub struct Match {
    /// Those that stay, and are facets of both from then on.
    pub kept: Vec<u32>,
    /// Those that they take the place of.
    pub dropped: Vec<u32>,
}

/// All matches.
pub struct Matches {
    /// Each of them.
    pub all: Vec<Match>,
    /// The pairs of solids that have some, the lower one first.
    pub pairs: FxHashSet<[u32; 2]>,
}

/// Looks for parts.
pub struct Regions<'a> {
    /// The facets as they were.
    pub facets: Facets<'a>,
    /// What touched.
    pub touches: &'a Touches,
    /// The facets, with all vertices and edges where contacts end.
    pub skin: &'a Skin,
}

impl Regions<'_> {
    /// All matches: of two parts, the one with more vertices inside stays. Linear in the facets of parts that touch.
    pub fn matches(&self) -> Matches {
        let mut seen: FxHashSet<[u32; 2]> = FxHashSet::default();
        let mut used = vec![false; self.skin.corners.len()];
        let mut matches = Matches {
            all: Vec::new(),
            pairs: FxHashSet::default(),
        };
        for t in 0..self.skin.corners.len() as u32 {
            if !self.facets.is_curved[self.skin.origin[t as usize] as usize] {
                continue;
            }
            let own = self.skin.solid[t as usize];
            for other in self.all_on(t) {
                if other < own || seen.contains(&[t, other]) {
                    continue;
                }
                let found = self.flood(t, other, &mut seen);
                let Some((first, second)) = found.and_then(|first| {
                    let second = self.counterpart(&first, own, other)?;
                    Some((first, second))
                }) else {
                    continue;
                };
                let both = || first.facets.iter().chain(&second.facets);
                if both().any(|&t| used[t as usize])
                    || !self.is_thin(&first, &second)
                    || !self.is_near([(&first, other), (&second, own)])
                {
                    continue;
                }
                both().for_each(|&t| used[t as usize] = true);
                let is_first = self.inner(&first) >= self.inner(&second);
                let (kept, dropped) = if is_first {
                    (first, second)
                } else {
                    (second, first)
                };
                matches.pairs.insert([own, other]);
                matches.all.push(Match {
                    kept: kept.facets,
                    dropped: dropped.facets,
                });
            }
        }
        matches
    }

    /// Whether a vertex is on a solid.
    fn is_on(&self, v: u32, solid: u32) -> bool {
        self.skin.has(v, solid) || self.touches.of.contains_key(&[v, solid])
    }

    /// The other solids that all corners of a facet are on, in order.
    fn all_on(&self, t: u32) -> Vec<u32> {
        let own = self.skin.solid[t as usize];
        let [a, b, c] = self.skin.corners[t as usize];
        let solids = self.touches.solids_of(a).iter().copied();
        solids
            .filter(|&s| s != own && self.is_on(b, s) && self.is_on(c, s))
            .collect()
    }

    /// The part that a facet belongs to, up to edges that the other solid has as well; `None` if some of its corners are not
    /// on that.
    fn flood(&self, start: u32, other: u32, seen: &mut FxHashSet<[u32; 2]>) -> Option<Part> {
        let skin = self.skin;
        let solid = skin.solid[start as usize];
        let mut part = Part {
            facets: Vec::new(),
            border: Vec::new(),
        };
        let mut is_whole = true;
        let mut stack = vec![start];
        seen.insert([start, other]);
        while let Some(t) = stack.pop() {
            let corners = skin.corners[t as usize];
            if !corners.iter().all(|&v| self.is_on(v, other)) {
                is_whole = false;
                continue;
            }
            part.facets.push(t);
            for i in 0..3 {
                let [a, b] = [corners[i], corners[(i + 1) % 3]];
                if skin.side(a, b, other).is_some() || skin.side(b, a, other).is_some() {
                    part.border.push([a, b]);
                    continue;
                }
                match skin.side(b, a, solid) {
                    Some(next) if seen.insert([next, other]) => stack.push(next),
                    Some(_) => {}
                    None => is_whole = false,
                }
            }
        }
        part.facets.sort_unstable();
        part.border.sort_unstable();
        is_whole.then_some(part)
    }

    /// The part of the other solid with the same border.
    fn counterpart(&self, part: &Part, own: u32, other: u32) -> Option<Part> {
        let start = match part.border.first() {
            Some(&[a, b]) => self.skin.side(b, a, other)?,
            None => {
                let v = self.skin.corners[part.facets[0] as usize][0];
                self.touches.of.get(&[v, other])?.triangle
            }
        };
        let mut seen = FxHashSet::default();
        let found = self.flood(start, own, &mut seen)?;
        let mut reversed: Vec<[u32; 2]> = part.border.iter().map(|&[a, b]| [b, a]).collect();
        reversed.sort_unstable();
        (reversed == found.border).then_some(found)
    }

    /// Whether what is between two parts is no thicker than their facets are off the surface that they stand for.
    fn is_thin(&self, first: &Part, second: &Part) -> bool {
        let skin = self.skin;
        let corners = |t: u32| skin.corners[t as usize].map(|v| skin.points[v as usize]);
        let origin = corners(first.facets[0])[0];
        let (mut volume, mut area, mut reach) = (0.0, 0.0, 0.0_f64);
        for &t in first.facets.iter().chain(&second.facets) {
            let [a, b, c] = corners(t);
            volume += tet_volume(origin, a, b, c);
            area += triangle_area(a, b, c);
            reach = reach.max(self.facets.curves.reach(skin.origin[t as usize]));
        }
        volume.abs() <= 0.5 * area * reach.max(self.facets.equal)
    }

    /// Whether vertices are on average as near the other solid as what touches by itself.
    fn is_near(&self, parts: [(&Part, u32); 2]) -> bool {
        let (mut sum, mut count) = (0.0, 0.0);
        for (part, other) in parts {
            let corners = part
                .facets
                .iter()
                .flat_map(|&t| self.skin.corners[t as usize]);
            let vertices: BTreeSet<u32> = corners.collect();
            for v in vertices {
                if let Some(touch) = self.touches.of.get(&[v, other]) {
                    sum += touch.off;
                    count += 1.0;
                }
            }
        }
        sum <= count
    }

    /// How many vertices a part has that are not on its border.
    fn inner(&self, part: &Part) -> usize {
        let border: FxHashSet<u32> = part.border.iter().flatten().copied().collect();
        let corners = part
            .facets
            .iter()
            .flat_map(|&t| self.skin.corners[t as usize]);
        let inner: FxHashSet<u32> = corners.filter(|v| !border.contains(v)).collect();
        inner.len()
    }
}
