//! Making the two sides of a rotation wedge images of each other, to the bit.

use crate::error::CutError;
use crate::opening::Opening;
use crate::reconcile::{Insertion, insert, insertions};
use crate::section::Section;
use crate::surface::Surface;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
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
/// `tolerance`: largest distance between partners, model units.
///
/// # Errors
/// Points that are farther from the other section; edges or regions that differ.
pub fn match_sections(
    surface: &mut Surface,
    opening: &Opening,
    rotation: Isometry,
    low: &mut Section,
    high: &mut Section,
    tolerance: f64,
    frame: &Frame,
) -> Result<Matched, CutError> {
    let (lows, highs) = (
        off_axis(surface, opening, low),
        off_axis(surface, opening, high),
    );
    let to_high = nearest(&lows, &highs, tolerance);
    let to_low = nearest(&highs, &lows, tolerance);
    let mut partner: FxHashMap<u32, u32> = FxHashMap::default();
    for &v in &low.points {
        if surface.classes[v as usize].is_axis() {
            partner.insert(v, v);
        }
    }
    let mut lone_low = Vec::new();
    for (i, &(v, _)) in lows.iter().enumerate() {
        match to_high[i].filter(|&j| to_low[j] == Some(i)) {
            Some(j) => {
                partner.insert(v, highs[j].0);
            }
            None => lone_low.push(v),
        }
    }
    let lone_high: Vec<u32> = (0..highs.len())
        .filter(|&j| to_low[j].is_none_or(|i| to_high[i] != Some(j)))
        .map(|j| highs[j].0)
        .collect();
    let inserted = lone_low.len() + lone_high.len();
    if inserted > 0 {
        let into_high = insertions(surface, opening, low, high, &lone_low, tolerance);
        let into_low = insertions(surface, opening, high, low, &lone_high, tolerance);
        let checked = |found: Vec<Result<Insertion, u32>>| -> Result<Vec<Insertion>, CutError> {
            let differs = |v: u32, distance: f64| CutError::SectionsDiffer {
                low: lows.len(),
                high: highs.len(),
                distance,
                tolerance,
                near: frame.to_world(surface.points[v as usize]),
            };
            if let Some(Err(v)) = found.iter().find(|f| f.is_err()) {
                return Err(differs(*v, f64::INFINITY));
            }
            let found: Vec<Insertion> = found.into_iter().flatten().collect();
            let worst = found
                .iter()
                .max_by(|a, b| a.distance.total_cmp(&b.distance));
            match worst {
                Some(w) if w.distance > tolerance => Err(differs(w.of, w.distance)),
                _ => Ok(found),
            }
        };
        let (into_high, into_low) = (checked(into_high)?, checked(into_low)?);
        let new_high = insert(surface, opening, high, &into_high);
        let new_low = insert(surface, opening, low, &into_low);
        partner.extend(into_high.iter().map(|i| i.of).zip(new_high));
        partner.extend(new_low.into_iter().zip(into_low.iter().map(|i| i.of)));
    }
    check_edges(surface, low, high, &partner, frame)?;
    let mut pairs: Vec<[u32; 2]> = partner.into_iter().map(|(v, w)| [v, w]).collect();
    pairs.sort_unstable();
    let mut moved = 0.0_f64;
    for &[v, w] in pairs.iter().filter(|p| p[0] != p[1]) {
        let (p, q) = (
            plane_of(surface, opening, low, v),
            plane_of(surface, opening, high, w),
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

/// The points of a section that are not on the axis, with their radius and height.
fn off_axis(surface: &Surface, opening: &Opening, section: &Section) -> Vec<(u32, DVec2)> {
    section
        .points
        .iter()
        .filter(|&&v| !surface.classes[v as usize].is_axis())
        .map(|&v| (v, plane_of(surface, opening, section, v)))
        .collect()
}

fn plane_of(surface: &Surface, opening: &Opening, section: &Section, v: u32) -> DVec2 {
    let p = surface.points[v as usize];
    DVec2::new(section.extent.radius(opening, p), p.z)
}

/// For each point the nearest of `among` within `reach`, by index.
fn nearest(points: &[(u32, DVec2)], among: &[(u32, DVec2)], reach: f64) -> Vec<Option<usize>> {
    let cell = |p: DVec2| (p / reach).floor().to_array().map(|x| x as i64);
    let mut grid: FxHashMap<[i64; 2], Vec<usize>> = FxHashMap::default();
    for (j, q) in among.iter().enumerate() {
        grid.entry(cell(q.1)).or_default().push(j);
    }
    points
        .iter()
        .map(|p| {
            let [x, y] = cell(p.1);
            let around = (-1..=1).flat_map(|i| (-1..=1).map(move |k| [x + i, y + k]));
            around
                .filter_map(|key| grid.get(&key))
                .flatten()
                .map(|&j| (j, among[j].1.distance(p.1)))
                .filter(|(_, d)| *d <= reach)
                .min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
                .map(|(j, _)| j)
        })
        .collect()
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
