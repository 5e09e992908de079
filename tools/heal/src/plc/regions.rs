//! Regions of the cells that the facets divide space into.

use crate::HealError;
use crate::words::place;
use geom::cells::{Cells, Place};
use glam::DVec3;
use interchange::parsed::{Plc, Seed};
use interchange::text::counted;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use tmesh::{OUTSIDE, Region, Size};

/// What the points of the file say of a cell.
#[derive(Clone, Copy)]
enum Content {
    Unknown,
    /// By position in [`Plc::holes`].
    Hole(usize),
    /// By position in [`Plc::regions`].
    Region(usize),
}

/// Region in each cell, and the regions, increasing in id. `leak` says where the facets are open.
pub fn regions(
    plc: &Plc,
    cells: &Cells<'_>,
    leak: &dyn Fn() -> String,
    notices: &mut Vec<String>,
) -> Result<(Vec<u32>, Vec<Region>), HealError> {
    let mut content = vec![Content::Unknown; cells.count()];
    for (i, &hole) in plc.holes.iter().enumerate() {
        let cell = locate(cells, hole, || format!("hole point {}", i + 1))?;
        if cell == Cells::UNBOUNDED {
            let at = place(hole);
            notices.push(format!("hole point {} at {at} lies outside", i + 1));
        } else {
            content[cell as usize] = Content::Hole(i);
        }
    }
    let ids = region_ids(&plc.regions);
    let mut regions: BTreeMap<u32, Region> = BTreeMap::new();
    for (i, seed) in plc.regions.iter().enumerate() {
        let cell = locate(cells, seed.point, || format!("region point {}", i + 1))?;
        if cell == Cells::UNBOUNDED {
            return Err(HealError::BadSurface(format!(
                "region point {} at {} lies outside, or in a region that the facets leave open{}",
                i + 1,
                place(seed.point),
                leak()
            )));
        }
        match content[cell as usize] {
            // As TetGen has it.
            Content::Hole(h) => {
                notices.push(format!(
                    "region point {} at {} is in the hole of hole point {} at {}: that stays empty",
                    i + 1,
                    place(seed.point),
                    h + 1,
                    place(plc.holes[h])
                ));
                continue;
            }
            Content::Region(j) if ids[j] != ids[i] => return Err(contradiction(plc, [j, i])),
            Content::Region(_) | Content::Unknown => content[cell as usize] = Content::Region(i),
        }
        let region = regions
            .entry(ids[i])
            .or_insert_with(|| region(ids[i], seed.attribute.clone()));
        // The stricter limit, where seeds of one region disagree.
        let known = region.size.map(Size::max_volume);
        let stricter = [known, seed.max_volume]
            .into_iter()
            .flatten()
            .reduce(f64::min);
        region.size = stricter.map(Size::MaxVolume);
    }
    let mut next = 1;
    let mut named = 0;
    let content = (0_u32..).zip(content).map(|(cell, content)| match content {
        _ if cell == Cells::UNBOUNDED => OUTSIDE,
        Content::Hole(_) => OUTSIDE,
        Content::Region(i) => ids[i],
        Content::Unknown => {
            while regions.contains_key(&next) {
                next += 1;
            }
            regions.insert(next, region(next, format!("region{next}")));
            named += 1;
            next
        }
    });
    let content = content.collect();
    if named > 0 && !plc.regions.is_empty() {
        let (one, many) = (
            "cell has no region point and is a region of its own",
            "cells have no region point and are regions of their own",
        );
        notices.push(format!(
            "{} (the last is {next})",
            counted(named, one, many)
        ));
    }
    Ok((content, regions.into_values().collect()))
}

fn region(id: u32, name: String) -> Region {
    Region {
        id,
        name,
        size: None,
        volume: None,
    }
}

fn locate(cells: &Cells<'_>, point: DVec3, what: impl Fn() -> String) -> Result<u32, HealError> {
    match cells.locate(point) {
        Place::Cell(cell) => Ok(cell),
        Place::Triangle(_) => Err(HealError::BadSurface(format!(
            "{} at {} lies on a facet",
            what(),
            place(point)
        ))),
    }
}

/// Two region points of one cell that have different attributes.
fn contradiction(plc: &Plc, seeds: [usize; 2]) -> HealError {
    let [first, second] = seeds.map(|i| &plc.regions[i]);
    HealError::BadSurface(format!(
        "region points {} at {} and {} at {} lie in the same cell, but have the attributes {} and {}",
        seeds[0] + 1,
        place(first.point),
        seeds[1] + 1,
        place(second.point),
        first.attribute,
        second.attribute
    ))
}

/// Region id of each seed: its attribute where that is a whole number, else a free id; the same for
/// the same attribute.
fn region_ids(seeds: &[Seed]) -> Vec<u32> {
    let whole = |seed: &Seed| {
        let value: f64 = seed.attribute.parse().ok()?;
        (value.fract() == 0.0 && (0.0..f64::from(OUTSIDE)).contains(&value)).then_some(value as u32)
    };
    let used: FxHashSet<u32> = seeds.iter().filter_map(whole).collect();
    let mut other: FxHashMap<&str, u32> = FxHashMap::default();
    let mut next = 1;
    seeds
        .iter()
        .map(|seed| {
            whole(seed).unwrap_or_else(|| {
                *other.entry(seed.attribute.as_str()).or_insert_with(|| {
                    while used.contains(&next) {
                        next += 1;
                    }
                    next += 1;
                    next - 1
                })
            })
        })
        .collect()
}
