//! Names of regions and of pieces of boundary of several files.

use super::part::Part;
use crate::words::unique_names;
use rustc_hash::FxHashMap;

/// Names the regions and groups of all files: a file of one solid as the file is to be called, others as their solids
/// are, with the file's name before it where another file has a region of that name.
pub fn name_parts(parts: &mut [Part]) {
    for part in parts.iter_mut() {
        let surface = &mut part.mended.mending.surface;
        if let [solid] = &mut surface.solids[..] {
            part.naming.name().clone_into(solid);
        }
        if let ([solid], [group]) = (&surface.solids[..], &mut surface.groups[..]) {
            group.clone_from(solid);
        }
    }
    let is_fixed = |part: &Part| part.mended.mending.surface.solids.len() == 1;
    make_unique(parts, is_fixed, |part| {
        &mut part.mended.mending.surface.solids
    });
    for part in parts.iter_mut() {
        let surface = &mut part.mended.mending.surface;
        if surface.groups.len() == surface.solids.len() {
            surface.groups.clone_from(&surface.solids);
        }
    }
    let is_fixed = |part: &Part| {
        let surface = &part.mended.mending.surface;
        surface.groups.len() == surface.solids.len()
    };
    make_unique(parts, is_fixed, |part| {
        &mut part.mended.mending.surface.groups
    });
}

/// Puts the file's name before names that others have as well, but for those of files that are `fixed`; what is the same even
/// then is numbered.
fn make_unique(
    parts: &mut [Part],
    is_fixed: impl Fn(&Part) -> bool,
    names: impl Fn(&mut Part) -> &mut Vec<String>,
) {
    let mut times: FxHashMap<String, usize> = FxHashMap::default();
    for part in parts.iter_mut() {
        for name in names(part) {
            *times.entry(name.clone()).or_default() += 1;
        }
    }
    for part in parts.iter_mut() {
        if is_fixed(part) {
            continue;
        }
        let file = part.naming.name().to_owned();
        for name in names(part).iter_mut().filter(|n| times[*n] > 1) {
            *name = format!("{file}-{name}");
        }
    }
    // Those that are fixed have their names first.
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by_key(|&i| !is_fixed(&parts[i]));
    let all: Vec<String> = (order.iter())
        .flat_map(|&i| names(&mut parts[i]).clone())
        .collect();
    let mut unique = unique_names(all.iter().map(String::as_str), "region").into_iter();
    for i in order {
        for name in names(&mut parts[i]) {
            if let Some(new) = unique.next() {
                *name = new;
            }
        }
    }
}
