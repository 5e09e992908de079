//! The files are put together to one body.

use super::names::name_parts;
use super::part::Part;
use crate::document::Imported;
use crate::soup::{join, label_mended};
use crate::{HealError, Repairing};
use std::collections::BTreeSet;

/// The body that files make together: a region for each of their solids.
///
/// # Errors
/// Solids that overlap, cross, or touch with different triangles.
pub fn assemble(mut parts: Vec<Part>, repairing: Repairing) -> Result<Imported, HealError> {
    name_parts(&mut parts);
    let formats: BTreeSet<&str> = parts.iter().map(|p| p.format.name()).collect();
    let formats: Vec<&str> = formats.into_iter().collect();
    let (mut wishes, mut history, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for part in parts {
        let of_solids = part.wishes.into_iter().chain(std::iter::repeat(None));
        wishes.extend(of_solids.take(part.mended.mending.surface.solids.len()));
        history.extend(part.history);
        all.push(part.mended);
    }
    let mut imported = label_mended(join(all), &formats.join(", "), repairing)?;
    for (region, wish) in imported.document.regions.iter_mut().zip(wishes) {
        region.size = wish;
    }
    imported.document.history = history;
    Ok(imported)
}
