//! One file among several, and all of them together.

use super::names::name_parts;
use super::surface_of::surface_of;
use crate::document::Imported;
use crate::read::heal;
use crate::soup::{Mended, Solids, join, label_mended, mend};
use crate::{HealError, Repairing};
use interchange::{Format, Parsed, parse};
use std::collections::BTreeSet;
use tmesh::HistoryEntry;

/// What the regions of a file are called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Naming {
    /// All of the file is one region of this name.
    Region(String),
    /// A file of one solid is a region of this name; one of several solids is a region for each, of the solid's name.
    File(String),
}

impl Naming {
    /// The name.
    pub fn name(&self) -> &str {
        match self {
            Self::Region(name) | Self::File(name) => name,
        }
    }
}

/// One file among several: closed surfaces of solids.
pub struct Part {
    pub(super) mended: Mended,
    pub(super) naming: Naming,
    /// Largest element volume that the file asks for in each solid; empty where it asks for none.
    pub(super) wishes: Vec<Option<f64>>,
    pub(super) format: Format,
    pub(super) history: Vec<HistoryEntry>,
}

impl Part {
    /// Takes what the user should know about the file, a sentence each, so that it can be told with the file's name.
    pub fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.mended.notices)
    }
}

/// Reads a whole file of the given format as one among several. Of a mesh, a complex or a document, the surfaces of
/// regions are read.
///
/// # Errors
/// Malformed bytes, surfaces that are not closed, and documents that are cut already.
pub fn read_part(
    bytes: &[u8],
    format: Format,
    naming: Naming,
    repairing: Repairing,
) -> Result<Part, HealError> {
    let solids = match naming {
        Naming::Region(_) => Solids::Whole,
        Naming::File(_) => Solids::Groups,
    };
    let soup = match parse(bytes, format)? {
        Parsed::Soup(soup) => soup,
        other => return surface_of(heal(other, format, repairing)?, format, naming, solids),
    };
    Ok(Part {
        mended: mend(soup, solids, repairing)?,
        naming,
        wishes: Vec::new(),
        format,
        history: Vec::new(),
    })
}

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
        region.max_volume = wish;
    }
    imported.document.history = history;
    Ok(imported)
}
