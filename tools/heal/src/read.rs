//! From bytes, or from parsed data, to a document.

use crate::document::Imported;
use crate::{HealError, Repairing, mesh, plc, shells, soup};
use interchange::{Format, Parsed, parse};

/// Reads a whole file of the given format into a document: one template in world coordinates, with
/// regions and markers, repaired where that needs no guess. [`tmesh::Source`] is filled in for surfaces.
///
/// # Errors
/// Malformed bytes, and surfaces that do not bound a body.
pub fn read(bytes: &[u8], format: Format) -> Result<Imported, HealError> {
    read_with(bytes, format, Repairing::default())
}

/// The same, where the caller says whether the surface may be repaired.
///
/// # Errors
/// Malformed bytes, and surfaces that do not bound a body.
pub fn read_with(
    bytes: &[u8],
    format: Format,
    repairing: Repairing,
) -> Result<Imported, HealError> {
    heal(parse(bytes, format)?, format, repairing)
}

/// Makes a document of what a file of the given format lists.
///
/// # Errors
/// Surfaces that do not bound a body.
pub fn heal(parsed: Parsed, format: Format, repairing: Repairing) -> Result<Imported, HealError> {
    let format = format.name();
    match parsed {
        Parsed::Document(document) => Ok(Imported {
            document: *document,
            notices: Vec::new(),
            repairs: Vec::new(),
            joined: None,
            undrawn: None,
            is_apart: false,
        }),
        Parsed::Soup(soup) => soup::build(soup, format, repairing),
        Parsed::Plc(plc) => plc::build(plc, format),
        Parsed::Shells(shells) => shells::build(shells, format, repairing),
        Parsed::Mesh(mesh) => mesh::build(mesh, format),
    }
}
