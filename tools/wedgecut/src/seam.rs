//! Making the two sides of a rotation wedge images of each other, to the bit.

use crate::error::CutError;
use crate::opening::{Class, Opening};
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
}

/// Pairs the points of two sections and moves each pair to its mean, the high side to the exact
/// image of the low one.
///
/// `tolerance`: largest distance between partners, model units.
///
/// # Errors
/// Points without partner; edges or regions that differ.
pub fn match_sections(
    surface: &mut Surface,
    opening: &Opening,
    rotation: Isometry,
    low: &Section,
    high: &Section,
    tolerance: f64,
    frame: &Frame,
) -> Result<Matched, CutError> {
    let plane = |section: &Section, v: u32| {
        let p = surface.points[v as usize];
        DVec2::new(section.extent.radius(opening, p), p.z)
    };
    let off_axis = |section: &Section| -> Vec<(u32, DVec2)> {
        section
            .points
            .iter()
            .filter(|&&v| surface.classes[v as usize] != Class::AXIS)
            .map(|&v| (v, plane(section, v)))
            .collect()
    };
    let (lows, highs) = (off_axis(low), off_axis(high));
    let to_high = nearest(&lows, &highs, tolerance);
    let to_low = nearest(&highs, &lows, tolerance);
    let mut farthest = (0.0, DVec3::ZERO);
    let mut check = |from: &[(u32, DVec2)],
                     to: &[Option<(usize, f64)>],
                     back: &[Option<(usize, f64)>],
                     all: &[(u32, DVec2)]| {
        for (i, partner) in to.iter().enumerate() {
            let mutual = partner.is_some_and(|(j, _)| back[j].is_some_and(|(k, _)| k == i));
            if !mutual {
                let distance = all
                    .iter()
                    .map(|q| q.1.distance(from[i].1))
                    .fold(f64::INFINITY, f64::min)
                    .max(tolerance);
                if distance > farthest.0 {
                    farthest = (distance, surface.points[from[i].0 as usize]);
                }
            }
        }
    };
    check(&lows, &to_high, &to_low, &highs);
    check(&highs, &to_low, &to_high, &lows);
    if farthest.0 > 0.0 {
        return Err(CutError::SectionsDiffer {
            low: lows.len(),
            high: highs.len(),
            distance: farthest.0,
            tolerance,
            near: frame.to_world(farthest.1),
        });
    }
    let mut partner: FxHashMap<u32, u32> = FxHashMap::default();
    for &v in &low.points {
        if surface.classes[v as usize] == Class::AXIS {
            partner.insert(v, v);
        }
    }
    for (i, &(v, _)) in lows.iter().enumerate() {
        if let Some((j, _)) = to_high[i] {
            partner.insert(v, highs[j].0);
        }
    }
    check_edges(surface, low, high, &partner, frame)?;
    let mut moved = 0.0_f64;
    for &(v, p) in &lows {
        let w = partner[&v];
        let q = plane(high, w);
        moved = moved.max(0.5 * p.distance(q));
    }
    let mut pairs: Vec<[u32; 2]> = partner.into_iter().map(|(v, w)| [v, w]).collect();
    pairs.sort_unstable();
    for &[v, w] in &pairs {
        if v == w {
            continue;
        }
        let mean = 0.5 * (plane_of(surface, opening, low, v) + plane_of(surface, opening, high, w));
        let p = DVec3::new(mean.x, 0.0, mean.y);
        surface.points[v as usize] = p;
        surface.points[w as usize] = rotation.apply(p);
    }
    Ok(Matched { pairs, moved })
}

fn plane_of(surface: &Surface, opening: &Opening, section: &Section, v: u32) -> DVec2 {
    let p = surface.points[v as usize];
    DVec2::new(section.extent.radius(opening, p), p.z)
}

/// For each point the nearest of `among` within `reach`, by index, with its distance.
fn nearest(
    points: &[(u32, DVec2)],
    among: &[(u32, DVec2)],
    reach: f64,
) -> Vec<Option<(usize, f64)>> {
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
        return Err(differs(high.edges[0].ends[0]));
    }
    Ok(())
}
