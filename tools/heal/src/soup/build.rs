//! From polygons in groups to a document.

use super::closure::open_surface;
use super::imprinted::{imprinted, touches};
use super::mending::Mending;
use super::solids::label;
use super::surface::{NONE, Surface};
use super::tables::tables;
use super::weld;
use crate::document::{Imported, check_scale, document, tolerance};
use crate::words::unique_names;
use crate::{HealError, Repair, Repairing};
use interchange::parsed::Soup;

/// Builds the document of a surface: welded, closed, with regions on the inside.
///
/// Where every group is closed by itself, groups are solids, and each is a region. Otherwise all
/// groups together must be closed: one region, and the groups are pieces of its boundary. Regions
/// and markers are numbered from 1. Linear but for nested or several pieces, which take
/// O(n log n).
///
/// # Errors
/// Open surfaces; solids that overlap, cross, or touch with different triangles; with [`Repairing::Off`], surfaces that
/// have triangles to be dropped.
pub fn build(
    mut soup: Soup,
    format: &'static str,
    repairing: Repairing,
) -> Result<Imported, HealError> {
    let relative_precision = soup.relative_precision;
    let mut notices = std::mem::take(&mut soup.notices);
    let mut mending = Mending::new(welded(soup)?, relative_precision);
    mending.drop_collapsed()?;
    mending.merge(false)?;
    if repairing != Repairing::Off {
        mending.close()?;
        mending.remove_flat();
    }
    let solids = mending.tell_solids();
    let several = mending.surface.groups.len() > 1;
    let apart = several.then(|| mending.surface.clone());
    let merged = if several { mending.merge(true) } else { Ok(()) };
    let Mending {
        surface,
        edges,
        odd,
        repairs,
        ..
    } = mending;
    if surface.triangles.is_empty() {
        return Err(HealError::BadSurface(
            "all its triangles cancel each other in pairs".to_owned(),
        ));
    }
    if solids == 1
        && let Some(error) = open_surface(&surface, &edges, &odd)
    {
        return Err(error);
    }
    if repairing == Repairing::Off
        && let Some(first) = repairs.first()
    {
        return Err(HealError::BadSurface(first.refusal()));
    }
    notices.extend(repairs.iter().map(Repair::sentence));
    let told = merged.and_then(|()| label(&surface, &edges, solids));
    let apart = apart.as_ref().unwrap_or(&surface);
    let tolerance = tolerance(&apart.points, relative_precision);
    let mut joined = None;
    let (surface, mut labels) = match (told, repairing) {
        (told, Repairing::Off) => (surface, told?),
        (Ok(labels), Repairing::Auto(contacts))
            if !(labels.crosses || several && touches(apart, &tolerance, contacts)) =>
        {
            (surface, labels)
        }
        (told, Repairing::Auto(contacts)) => match imprinted(apart, &tolerance, contacts, solids) {
            Ok(imprinted) => {
                joined = Some(imprinted.joined);
                (imprinted.surface, imprinted.labels)
            }
            Err(reason) => match told {
                Ok(mut labels) => {
                    labels.notices.push(reason);
                    (surface, labels)
                }
                Err(error) => {
                    return Err(HealError::BadSurface(format!("{error}; {reason}")));
                }
            },
        },
    };
    notices.append(&mut labels.notices);
    let mut labelled = tables(surface, labels, solids);
    labelled.relative_precision = relative_precision;
    labelled.notices = notices;
    labelled.repairs = repairs;
    let mut imported = document(labelled, format)?;
    if let Some(joined) = &mut joined {
        joined.tell_volumes(&imported.document);
    }
    imported.joined = joined;
    Ok(imported)
}

/// The triangles of a soup by distinct points, in groups that have triangles.
fn welded(soup: Soup) -> Result<Surface, HealError> {
    let weld::Welded {
        points,
        triangles,
        group,
    } = weld::weld(soup.points, soup.faces, &soup.group_of);
    if triangles.is_empty() {
        return Err(HealError::BadSurface("it has no triangles".to_owned()));
    }
    check_scale(&points)?;
    let names = soup.groups.into_iter().map(|g| g.name).collect();
    let (group, groups) = used_groups(group, names);
    Ok(Surface {
        solid: group.clone(),
        partner: vec![NONE; triangles.len()],
        source: (0..triangles.len() as u32).collect(),
        points,
        triangles,
        group,
        groups: unique_names(groups.iter().map(String::as_str), "region"),
        group_word: soup.group_word,
    })
}

/// Drops groups without triangles.
fn used_groups(group_of: Vec<u32>, groups: Vec<String>) -> (Vec<u32>, Vec<String>) {
    let mut new_id = vec![NONE; groups.len()];
    for &g in &group_of {
        new_id[g as usize] = 0;
    }
    let mut kept = Vec::new();
    for (id, name) in new_id.iter_mut().zip(groups) {
        if *id != NONE {
            *id = kept.len() as u32;
            kept.push(name);
        }
    }
    let group = group_of.into_iter().map(|g| new_id[g as usize]).collect();
    (group, kept)
}
