//! A file is read as one among several.

use super::part::{Naming, Part};
use super::surface_of::surface_of;
use crate::read::heal;
use crate::soup::mend;
use crate::{HealError, Healing, Solids};
use interchange::{Format, Parsed, parse};

/// Reads a whole file of the given format as one among several. Of a mesh, a complex or a document, the surfaces of
/// regions are read.
///
/// # Errors
/// Malformed bytes, surfaces that are not closed, and documents that are cut already.
pub fn read_part(
    bytes: &[u8],
    format: Format,
    naming: Naming,
    healing: Healing,
) -> Result<Part, HealError> {
    let solids = match naming {
        Naming::Region(_) => Solids::Whole,
        Naming::File(_) => healing.solids,
    };
    let soup = match parse(bytes, format)? {
        Parsed::Soup(soup) => soup,
        other => return surface_of(heal(other, format, healing)?, format, naming, solids),
    };
    Ok(Part {
        mended: mend(soup, solids, healing.repairing)?,
        naming,
        wishes: Vec::new(),
        format,
        history: Vec::new(),
    })
}
