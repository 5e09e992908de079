//! Making two parts of a wedge's faces images of each other, to the bit.

use super::align::{Step, align};
use super::reconcile::{Insertion, insert};
use crate::cell::{Cell, Join};
use crate::error::CutError;
use crate::section::{Chain, Piece, Section, chains};
use crate::surface::Surface;
use geom::grid::Grid;
use geom::measure::double_area_vector;
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use tmesh::{Frame, RegionMap};

/// Pairs of points there and here, increasing in the first; points that are their own images with themselves.
#[derive(Clone, Debug, PartialEq)]
pub struct Matched {
    /// The pairs.
    pub pairs: Vec<[u32; 2]>,
    /// Largest distance a point was moved, model units.
    pub moved: f64,
    /// Points that one section had and the other did not.
    pub inserted: usize,
    /// How regions there are named here.
    pub regions: RegionMap,
}

impl Matched {
    /// The point here for a point there.
    pub fn partner(&self, v: u32) -> Option<u32> {
        let i = self.pairs.binary_search_by_key(&v, |p| p[0]).ok()?;
        Some(self.pairs[i][1])
    }

    /// Adds the images of points there that no face of the surface has.
    pub fn add(&mut self, surface: &mut Surface, join: &Join, points: &[u32]) {
        for &v in points {
            let (p, class) = surface.at(v);
            if class.is_axis() {
                self.pairs.push([v, v]);
                continue;
            }
            let class = class.with(join.there.face, 1).with(join.here.face, 0);
            let w = surface.add(join.step.apply(p), class);
            surface.corners.push(w);
            self.pairs.push([v, w]);
        }
        self.pairs.sort_unstable();
    }
}

/// What two sections are to be made images of each other by.
#[derive(Clone, Copy)]
pub struct Matching<'a> {
    /// The cell that the sections are of.
    pub cell: &'a Cell,
    /// The parts, and what takes one onto the other.
    pub join: &'a Join,
    /// How that isometry renames regions.
    pub regions: &'a RegionMap,
    /// Largest distance of a point from the other section, model units.
    pub tolerance: f64,
    /// The same where that does not do but points are moved along faces: those that are cut at a small angle.
    pub along: f64,
    /// Where the input is.
    pub frame: &'a Frame,
}

impl Matching<'_> {
    /// Whether a point of the part there is its own image.
    fn is_fixed(&self, surface: &Surface, v: u32) -> bool {
        let (p, class) = surface.at(v);
        let fixes_axis = !self.join.step.flipped() || p.z == 0.0;
        class.is_axis() && fixes_axis || self.cell.is_on_fold(self.join.there.face, class)
    }
}

/// Pairs the points of the two sections of a surface that are to be images of each other and moves each pair to its
/// mean, the point here to the exact image of the one there. Points without partner are inserted into the other
/// section. Where points are farther apart than the tolerance, none is moved across its faces by more than that.
///
/// First the ends of chains are paired, then chains between them, then points along each chain.
///
/// # Errors
/// Points that are farther from the other section; chains that have no counterpart; edges or regions
/// that differ.
pub fn match_sections(surface: &mut Surface, matching: &Matching<'_>) -> Result<Matched, CutError> {
    let mut matching = *matching;
    let Matching {
        cell,
        join,
        tolerance,
        ..
    } = matching;
    // What was wrong within the tolerance, once that is wider.
    let mut differ = None;
    let section = |part| {
        let piece = Piece {
            surface,
            faces: &surface.faces,
            corners: surface.corners.clone(),
        };
        Section::new(&piece, cell, part)
    };
    let (mut low, mut high) = (section(join.there), section(join.here));
    low.rename(matching.regions);
    let mut inserted = 0;
    let (mut partner, into_low, into_high) = loop {
        let (of_low, nodes_low) = chains(surface, cell, &low);
        let (of_high, nodes_high) = chains(surface, cell, &high);
        let mut matcher = Matcher {
            matching: &matching,
            surface,
            low: &low,
            high: &high,
            partner: FxHashMap::default(),
            nodes: nodes_low.iter().chain(&nodes_high).copied().collect(),
        };
        let found = matcher.find([&nodes_low, &nodes_high], [of_low, of_high]);
        let partner = matcher.partner;
        match found {
            Err(error @ CutError::SectionsDiffer { .. }) if differ.is_none() => {
                differ = Some(error);
                matching.tolerance = matching.along;
            }
            Err(error) => return Err(differ.unwrap_or(error)),
            Ok(Found::Beginnings(beginnings)) => {
                inserted += beginnings.len();
                insert(surface, cell, &mut high, &beginnings);
            }
            Ok(Found::All(into_low, into_high)) => break (partner, into_low, into_high),
        }
    };
    inserted += into_low.len() + into_high.len();
    let new_high = insert(surface, cell, &mut high, &into_high);
    let new_low = insert(surface, cell, &mut low, &into_low);
    partner.extend(into_high.iter().map(|i| i.of).zip(new_high));
    partner.extend(new_low.into_iter().zip(into_low.iter().map(|i| i.of)));
    check_edges(surface, &matching, [&low, &high], &partner)?;
    let mut pairs: Vec<[u32; 2]> = partner.into_iter().map(|(v, w)| [v, w]).collect();
    pairs.sort_unstable();
    let mut moved = 0.0_f64;
    let mut places: FxHashMap<u32, DVec3> = FxHashMap::default();
    for &[v, w] in &pairs {
        if v == w && matching.is_fixed(surface, v) {
            continue;
        }
        let (p, q) = (low.place(surface, cell, v), high.place(surface, cell, w));
        moved = moved.max(0.5 * p.distance(q));
        let p = join.there.at(&cell.faces, 0.5 * (p + q));
        places.extend([(v, p), (w, join.step.apply(p))]);
    }
    if let Some(differ) = differ {
        let across = across(surface, &places);
        if across > tolerance {
            return Err(differ);
        }
    }
    for (v, p) in places {
        surface.points[v as usize] = p;
    }
    Ok(Matched {
        pairs,
        moved,
        inserted,
        regions: matching.regions.clone(),
    })
}

/// How far points are from the planes of their faces at the places that they are moved to, at most; model units.
fn across(surface: &Surface, places: &FxHashMap<u32, DVec3>) -> f64 {
    let of_face = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| surface.points[v as usize]);
        let normal = double_area_vector(a, b, c).normalize_or_zero();
        let moved = corners.iter().zip([a, b, c]);
        let off = moved.filter_map(|(v, p)| Some((*places.get(v)? - p).dot(normal).abs()));
        off.fold(0.0, f64::max)
    };
    let faces = surface.faces.iter().map(|face| of_face(&face.vertices));
    faces.fold(0.0, f64::max)
}

/// What the sections still need.
enum Found {
    /// Points of the second one that its closed curves begin at.
    Beginnings(Vec<Insertion>),
    /// Points that either has and the other one gets.
    All(Vec<Insertion>, Vec<Insertion>),
}

/// Finds counterparts.
struct Matcher<'a> {
    matching: &'a Matching<'a>,
    surface: &'a Surface,
    low: &'a Section,
    high: &'a Section,
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
            tolerance: self.matching.tolerance,
            near: self
                .matching
                .frame
                .to_world(self.surface.points[v as usize]),
        }
    }

    /// Pairs the points of both sections, given where chains end, and the chains.
    fn find(
        &mut self,
        [nodes_low, nodes_high]: [&[u32]; 2],
        [low, high]: [Vec<Chain>; 2],
    ) -> Result<Found, CutError> {
        self.pair_nodes(nodes_low, nodes_high)?;
        let paired = self.pair_chains(low, high)?;
        let beginnings = self.beginnings(&paired)?;
        if !beginnings.is_empty() {
            return Ok(Found::Beginnings(beginnings));
        }
        let (into_low, into_high) = self.align_all(&paired)?;
        Ok(Found::All(into_low, into_high))
    }

    /// Pairs the points where chains end, those that are their own images with themselves.
    fn pair_nodes(&mut self, low: &[u32], high: &[u32]) -> Result<(), CutError> {
        let is_fixed = |v: &u32| self.matching.is_fixed(self.surface, *v);
        let fixed = self.low.points.iter().copied().filter(is_fixed);
        self.partner.extend(fixed.map(|v| (v, v)));
        let places = |nodes: &[u32], section: &Section| -> Vec<(u32, DVec2)> {
            let off = nodes.iter().copied().filter(|v| !is_fixed(v));
            off.map(|v| (v, section.place(self.surface, self.matching.cell, v)))
                .collect()
        };
        let (low, high) = (places(low, self.low), places(high, self.high));
        let to_high = nearest(&low, &high, self.matching.tolerance);
        let to_low = nearest(&high, &low, self.matching.tolerance);
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
            let apart =
                of.is_none() && !begin_alike(&mut chain, &mut other, self.matching.tolerance);
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
                match distance > self.matching.tolerance {
                    true => Err(self.differ(chain.points[0], distance)),
                    // Not at the ends of the edge: no point is that near.
                    false => Ok(Insertion::new(self.high, other, chain.points[0], place)),
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
            let steps = align(chain, other, self.matching.tolerance).map_err(|apart| {
                let curve = if apart.first { chain } else { other };
                self.differ(curve.points[apart.point], apart.distance)
            })?;
            for step in steps {
                match step {
                    Step::Both(i, j) => {
                        self.partner.insert(chain.points[i], other.points[j]);
                    }
                    Step::First(i, place) => {
                        into_high.push(Insertion::new(self.high, other, chain.points[i], place));
                    }
                    Step::Second(j, place) => {
                        into_low.push(Insertion::new(self.low, chain, other.points[j], place));
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
            near: self
                .matching
                .frame
                .to_world(self.surface.points[v as usize]),
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
    matching: &Matching<'_>,
    [low, high]: [&Section; 2],
    partner: &FxHashMap<u32, u32>,
) -> Result<(), CutError> {
    let image = |v: u32| partner.get(&v).copied();
    let differs = |v: u32| CutError::SectionsJoinedDifferently {
        low: low.edges.len(),
        high: high.edges.len(),
        near: matching.frame.to_world(surface.points[v as usize]),
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
            // Around what both parts share, each sees what is beside the other.
            let is_axis = |v: u32| surface.classes[v as usize].is_axis();
            let is_fixed = |v: u32| is_axis(v) || matching.is_fixed(surface, v);
            let is_shared = e.ends.into_iter().all(is_fixed);
            is_shared || (h.left, h.right) == (left, right)
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
