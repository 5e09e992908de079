//! Making the two sides of a rotation wedge images of each other, to the bit.

use crate::align::{Step, align};
use crate::chains::{Chain, chains};
use crate::error::CutError;
use crate::opening::Opening;
use crate::reconcile::{Insertion, insert};
use crate::section::Section;
use crate::surface::Surface;
use geom::grid::Grid;
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{Frame, Isometry};

/// Point pairs (low side, high side), increasing in the low point, axis points with themselves.
#[derive(Clone, Debug, PartialEq)]
pub struct Matched {
    /// The pairs.
    pub pairs: Vec<[u32; 2]>,
    /// Largest distance a point was moved, model units.
    pub moved: f64,
    /// Points that one side had and the other did not.
    pub inserted: usize,
}

/// Pairs the points of two sections and moves each pair to its mean, the high side to the exact
/// image of the low one. Points without partner are inserted into the other section.
///
/// First the ends of chains are paired, then chains between them, then points along each chain.
/// `tolerance`: largest distance of a point from the other section, model units.
///
/// # Errors
/// Points that are farther from the other section; chains that have no counterpart; edges or regions
/// that differ.
pub fn match_sections(
    surface: &mut Surface,
    opening: &Opening,
    rotation: Isometry,
    low: &mut Section,
    high: &mut Section,
    tolerance: f64,
    frame: &Frame,
) -> Result<Matched, CutError> {
    let mut inserted = 0;
    let (mut partner, into_low, into_high) = loop {
        let (of_low, nodes_low) = chains(surface, opening, low);
        let (of_high, nodes_high) = chains(surface, opening, high);
        let mut matcher = Matcher {
            surface,
            opening,
            low,
            high,
            tolerance,
            frame,
            partner: FxHashMap::default(),
            nodes: nodes_low.iter().chain(&nodes_high).copied().collect(),
        };
        matcher.pair_nodes(&nodes_low, &nodes_high)?;
        let paired = matcher.pair_chains(of_low, of_high)?;
        let beginnings = matcher.beginnings(&paired)?;
        if beginnings.is_empty() {
            let (into_low, into_high) = matcher.align_all(&paired)?;
            break (matcher.partner, into_low, into_high);
        }
        inserted += beginnings.len();
        insert(surface, opening, high, &beginnings);
    };
    inserted += into_low.len() + into_high.len();
    let new_high = insert(surface, opening, high, &into_high);
    let new_low = insert(surface, opening, low, &into_low);
    partner.extend(into_high.iter().map(|i| i.of).zip(new_high));
    partner.extend(new_low.into_iter().zip(into_low.iter().map(|i| i.of)));
    check_edges(surface, low, high, &partner, frame)?;
    let mut pairs: Vec<[u32; 2]> = partner.into_iter().map(|(v, w)| [v, w]).collect();
    pairs.sort_unstable();
    let mut moved = 0.0_f64;
    for &[v, w] in pairs.iter().filter(|p| p[0] != p[1]) {
        let (p, q) = (
            low.place(surface, opening, v),
            high.place(surface, opening, w),
        );
        moved = moved.max(0.5 * p.distance(q));
        let mean = 0.5 * (p + q);
        let p = DVec3::new(mean.x, 0.0, mean.y);
        surface.points[v as usize] = p;
        surface.points[w as usize] = rotation.apply(p);
    }
    Ok(Matched {
        pairs,
        moved,
        inserted,
    })
}

/// Finds counterparts.
struct Matcher<'a> {
    surface: &'a Surface,
    opening: &'a Opening,
    low: &'a Section,
    high: &'a Section,
    tolerance: f64,
    frame: &'a Frame,
    /// Point of the high section for points of the low one.
    partner: FxHashMap<u32, u32>,
    /// Points of either section where chains end.
    nodes: FxHashSet<u32>,
}

impl Matcher<'_> {
    fn differ(&self, v: u32, distance: f64) -> CutError {
        CutError::SectionsDiffer {
            low: self.low.points.len(),
            high: self.high.points.len(),
            distance,
            tolerance: self.tolerance,
            near: self.frame.to_world(self.surface.points[v as usize]),
        }
    }

    /// Pairs the points where chains end, those on the axis with themselves.
    fn pair_nodes(&mut self, low: &[u32], high: &[u32]) -> Result<(), CutError> {
        let is_axis = |v: &u32| self.surface.classes[*v as usize].is_axis();
        let axis = self.low.points.iter().copied().filter(is_axis);
        self.partner.extend(axis.map(|v| (v, v)));
        let places = |nodes: &[u32], section: &Section| -> Vec<(u32, DVec2)> {
            let off = nodes.iter().copied().filter(|v| !is_axis(v));
            off.map(|v| (v, section.place(self.surface, self.opening, v)))
                .collect()
        };
        let (low, high) = (places(low, self.low), places(high, self.high));
        let to_high = nearest(&low, &high, self.tolerance);
        let to_low = nearest(&high, &low, self.tolerance);
        let farthest = |v: u32, p: DVec2, others: &[(u32, DVec2)]| {
            let distances = others.iter().map(|q| q.1.distance(p));
            self.differ(v, distances.fold(f64::INFINITY, f64::min))
        };
        let mut found = Vec::new();
        for (i, &(v, p)) in low.iter().enumerate() {
            match to_high[i].filter(|&j| to_low[j] == Some(i)) {
                Some(j) => found.push((v, high[j].0)),
                None => return Err(farthest(v, p, &high)),
            }
        }
        if let Some(j) = (0..high.len()).find(|&j| to_low[j].is_none_or(|i| to_high[i] != Some(j)))
        {
            return Err(farthest(high[j].0, high[j].1, &low));
        }
        self.partner.extend(found);
        Ok(())
    }

    /// Pairs chains between the same ends and regions, directed and begun alike; says whether two are
    /// closed and have no points near each other to begin at.
    fn pair_chains(
        &self,
        low: Vec<Chain>,
        high: Vec<Chain>,
    ) -> Result<Vec<(Chain, Chain, bool)>, CutError> {
        let count = [low.len(), high.len()];
        let ends = |c: &Chain, image: &dyn Fn(u32) -> Option<u32>| {
            let [first, last] = [c.points[0], c.points[c.points.len() - 1]];
            let node = image(first).zip(image(last));
            node.filter(|_| !c.is_closed() || self.nodes.contains(&first))
        };
        let mut by_ends: FxHashMap<_, Vec<Chain>> = FxHashMap::default();
        for mut chain in high {
            let of = ends(&chain, &|v| Some(v));
            // Between equal regions the direction is open: from the lower end on.
            if chain.kind[0] == chain.kind[1] && of.is_some_and(|(v, w)| v > w) {
                chain.reverse();
            }
            let of = ends(&chain, &|v| Some(v));
            by_ends.entry((of, chain.kind)).or_default().push(chain);
        }
        let mut found = Vec::new();
        for mut chain in low {
            let image = |v: u32| self.partner.get(&v).copied();
            if chain.kind[0] == chain.kind[1] && ends(&chain, &image).is_some_and(|(v, w)| v > w) {
                chain.reverse();
            }
            let of = ends(&chain, &image);
            let apart = |other: &Chain| {
                let middle = chain.points.len() / 2;
                other.nearest(chain.at[middle]).1
            };
            let candidates = by_ends.get_mut(&(of, chain.kind));
            let best = candidates.and_then(|list| {
                let i =
                    (0..list.len()).min_by(|&i, &j| apart(&list[i]).total_cmp(&apart(&list[j])))?;
                Some(list.swap_remove(i))
            });
            let Some(mut other) = best else {
                let v = chain.points[chain.points.len() / 2];
                return Err(self.without_counterpart(count, v));
            };
            let apart = of.is_none() && !begin_alike(&mut chain, &mut other, self.tolerance);
            found.push((chain, other, apart));
        }
        match by_ends.values().flatten().next() {
            Some(chain) => {
                Err(self.without_counterpart(count, chain.points[chain.points.len() / 2]))
            }
            None => Ok(found),
        }
    }

    /// Points that closed curves of the high section need to begin at.
    fn beginnings(&self, paired: &[(Chain, Chain, bool)]) -> Result<Vec<Insertion>, CutError> {
        let apart = paired.iter().filter(|p| p.2);
        apart
            .map(|(chain, other, _)| {
                let (place, distance) = other.nearest(chain.at[0]);
                match distance > self.tolerance {
                    true => Err(self.differ(chain.points[0], distance)),
                    // Not at the ends of the edge: no point is that near.
                    false => Ok(other.insertion(self.high, chain.points[0], place)),
                }
            })
            .collect()
    }

    /// Pairs the points along paired chains; says which points either section gets.
    fn align_all(
        &mut self,
        paired: &[(Chain, Chain, bool)],
    ) -> Result<(Vec<Insertion>, Vec<Insertion>), CutError> {
        let (mut into_low, mut into_high) = (Vec::new(), Vec::new());
        for (chain, other, _) in paired {
            let steps = align(chain, other, self.tolerance).map_err(|apart| {
                let curve = if apart.first { chain } else { other };
                self.differ(curve.points[apart.point], apart.distance)
            })?;
            for step in steps {
                match step {
                    Step::Both(i, j) => {
                        self.partner.insert(chain.points[i], other.points[j]);
                    }
                    Step::First(i, place) => {
                        into_high.push(other.insertion(self.high, chain.points[i], place));
                    }
                    Step::Second(j, place) => {
                        into_low.push(chain.insertion(self.low, other.points[j], place));
                    }
                }
            }
        }
        Ok((into_low, into_high))
    }

    fn without_counterpart(&self, [low, high]: [usize; 2], v: u32) -> CutError {
        CutError::SectionsJoinedDifferently {
            low,
            high,
            near: self.frame.to_world(self.surface.points[v as usize]),
        }
    }
}

/// Starts two closed curves at the points nearest to each other; false if none are within `reach`.
fn begin_alike(chain: &mut Chain, other: &mut Chain, reach: f64) -> bool {
    let places = |c: &Chain| -> Vec<(u32, DVec2)> {
        let points = c.points.iter().copied().zip(c.at.iter().copied());
        points.take(c.edges.len()).collect()
    };
    let (of_chain, of_other) = (places(chain), places(other));
    let best = (nearest(&of_chain, &of_other, reach).into_iter().enumerate())
        .filter_map(|(i, j)| Some((i, j?)))
        .min_by(|a, b| {
            let distance = |&(i, j): &(usize, usize)| of_chain[i].1.distance(of_other[j].1);
            distance(a).total_cmp(&distance(b)).then(a.cmp(b))
        });
    if let Some((i, j)) = best {
        chain.start_at(i);
        other.start_at(j);
    }
    best.is_some()
}

/// For each point the nearest of `among` within `reach`, by index.
fn nearest(points: &[(u32, DVec2)], among: &[(u32, DVec2)], reach: f64) -> Vec<Option<usize>> {
    let grid = Grid::of(among.iter().map(|q| q.1), reach);
    let nearest = |p: &(u32, DVec2)| Some(grid.nearest(p.1, reach)?.0 as usize);
    points.iter().map(nearest).collect()
}

fn check_edges(
    surface: &Surface,
    low: &Section,
    high: &Section,
    partner: &FxHashMap<u32, u32>,
    frame: &Frame,
) -> Result<(), CutError> {
    let image = |v: u32| partner.get(&v).copied();
    let differs = |v: u32| CutError::SectionsJoinedDifferently {
        low: low.edges.len(),
        high: high.edges.len(),
        near: frame.to_world(surface.points[v as usize]),
    };
    for e in &low.edges {
        let [Some(a), Some(b)] = e.ends.map(image) else {
            return Err(differs(e.ends[0]));
        };
        let (ends, left, right) = if a < b {
            ([a, b], e.left, e.right)
        } else {
            ([b, a], e.right, e.left)
        };
        let found = high.edges.binary_search_by_key(&ends, |h| h.ends);
        let same = found.is_ok_and(|i| {
            let h = &high.edges[i];
            let on_axis = a == e.ends[0] && b == e.ends[1];
            on_axis || (h.left, h.right) == (left, right)
        });
        if !same {
            return Err(differs(e.ends[0]));
        }
    }
    if low.edges.len() != high.edges.len() {
        return Err(differs(high.points[0]));
    }
    Ok(())
}
