//! From polygons in groups to a document.

use super::imprinted::{Imprinted, Unjoined, imprinted, touching};
use super::mended::Mended;
use super::mending::Mending;
use super::precision::less_precise;
use super::shells::parts;
use super::solids::label;
use super::surface::{NONE, Surface};
use super::undrawn::{Reading, Undrawn};
use super::weld;
use crate::document::{Imported, check_scale, tolerance};
use crate::words::{short, unique_names};
use crate::{HealError, Healing, Repair, Repairing, Solids};
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
pub fn build(soup: Soup, format: &str, healing: Healing) -> Result<Imported, HealError> {
    let Healing { repairing, solids } = healing;
    label_mended(mend(soup, solids, repairing)?, format, repairing)
}

/// Welds a soup, mends it and tells its solids.
///
/// # Errors
/// Surfaces that stay open; with [`Repairing::Off`], surfaces that have triangles to be dropped.
pub fn mend(mut soup: Soup, solids: Solids, repairing: Repairing) -> Result<Mended, HealError> {
    let mut notices = std::mem::take(&mut soup.notices);
    let precision = [soup.relative_precision, soup.printed_precision];
    let mut mending = Mending::new(welded(soup)?, precision);
    mending.drop_collapsed()?;
    if solids == Solids::Shells {
        if repairing != Repairing::Off {
            mending.close()?;
        }
        mending.divide_into_shells();
    }
    mending.merge(false)?;
    if repairing != Repairing::Off {
        mending.close()?;
        mending.remove_flat();
    }
    mending.tell_solids();
    if mending.surface.solids.len() < mending.surface.groups.len() {
        mending.merge(true)?;
    } else if solids == Solids::Whole {
        mending.unite()?;
    }
    mending.check_closed()?;
    if repairing == Repairing::Off
        && let Some(first) = mending.repairs.first()
    {
        return Err(HealError::BadSurface(first.refusal()));
    }
    notices.extend(mending.repairs.iter().map(Repair::sentence));
    Ok(Mended { mending, notices })
}

/// The document of a mended surface.
///
/// # Errors
/// Solids that overlap, cross, or touch with different triangles.
pub fn label_mended(
    mended: Mended,
    format: &str,
    repairing: Repairing,
) -> Result<Imported, HealError> {
    let Mended {
        mut mending,
        mut notices,
    } = mended;
    let several = mending.surface.solids.len() > 1;
    let apart = several.then(|| mending.surface.clone());
    let merged = if several { mending.merge(true) } else { Ok(()) };
    let Mending {
        surface,
        edges,
        repairs,
        mut relative_precision,
        printed_precision,
        ..
    } = mending;
    let apart = apart.as_ref().unwrap_or(&surface);
    let tolerance = tolerance(&apart.points, relative_precision);
    let told = merged.and_then(|()| label(&surface, &edges, tolerance.flat()));
    // The shells of a single solid touch and cross as solids do.
    let parts = (!several && repairing != Repairing::Off)
        .then(|| parts(&surface, &edges))
        .flatten();
    let (mut joined, mut divided) = (None, None);
    let to_join = match (&told, repairing) {
        (_, Repairing::Off) => None,
        (Ok(labels), Repairing::Auto(contacts)) if !labels.crosses => match &parts {
            _ if several => touching(apart, &tolerance, contacts),
            // What is apart was meant to be, unless it is as near as rounding explains.
            Some(parts) => touching(parts, &tolerance, contacts.flat()),
            None => None,
        },
        (_, Repairing::Auto(contacts)) => Some(contacts),
    };
    let (surface, labels) = match to_join {
        None => (surface, told?),
        Some(contacts) => {
            let known = told.as_ref().ok().and_then(|labels| labels.met.as_ref());
            let precision = [relative_precision, printed_precision];
            let mut join = |solids: &Surface, known, is_sound: bool| {
                let mut made = imprinted(solids, &tolerance, contacts, known);
                // What is sound as it is stays so.
                if !is_sound
                    && let Some((wider, again)) = less_precise(solids, &made, precision, contacts)
                {
                    let equal = self::tolerance(&solids.points, wider).equal();
                    notices.push(format!(
                        "coordinates are known less well than their digits tell: what is nearer than {} is taken for one",
                        short(equal)
                    ));
                    relative_precision = wider;
                    made = Ok(again);
                }
                made
            };
            let united = parts.as_ref().and_then(|parts| {
                let mut made = join(parts, None, false).ok().filter(Imprinted::have_met)?;
                let divided = made.divided.take();
                let mut made = made.united(&surface);
                made.divided = divided;
                Some(made)
            });
            let whole = united.is_some().then(|| surface.clone());
            // Of several solids, another surface was labelled.
            let made = match united {
                Some(united) => Ok(united),
                None => join(apart, known.filter(|_| !several), told.is_ok()),
            };
            match made {
                Ok(imprinted) if imprinted.is_slight && told.is_ok() => (surface, told?),
                // What is drawn is a body as it is, and what looked like a contact is none; but where solids touch in edges or
                // vertices alone, these are divided.
                Ok(imprinted)
                    if imprinted.joined.largest > tolerance.equal()
                        && told.as_ref().is_ok_and(|told| {
                            !told.crosses && imprinted.labels.interfaces() <= told.interfaces()
                        }) =>
                {
                    (surface, told?)
                }
                Ok(imprinted) => {
                    joined = Some(imprinted.joined);
                    divided = imprinted.divided.map(|divided| (divided, whole));
                    (imprinted.surface, imprinted.labels)
                }
                Err(Unjoined { reason, .. }) => match told {
                    Ok(mut labels) => {
                        labels.notices.push(reason);
                        (surface, labels)
                    }
                    Err(error) => {
                        return Err(HealError::BadSurface(format!("{error}; {reason}")));
                    }
                },
            }
        }
    };
    let reading = Reading {
        format: format.to_owned(),
        relative_precision,
        notices,
        repairs,
    };
    let undrawn = divided.map(|(divided, whole)| Undrawn::new(&reading, divided, whole));
    let mut imported = reading.finished((surface, labels), joined)?;
    imported.undrawn = undrawn;
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
    let groups = unique_names(groups.iter().map(String::as_str), "region");
    Ok(Surface {
        solid: group.clone(),
        partner: vec![NONE; triangles.len()],
        source: (0..triangles.len() as u32).collect(),
        points,
        triangles,
        group,
        solids: groups.clone(),
        groups,
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
