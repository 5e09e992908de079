//! From bytes, or from parsed data, to a document.

use crate::document::Imported;
use crate::{HealError, Healing, mesh, plc, shells, soup};
use interchange::{Format, Parsed, parse};

/// Reads a whole file of the given format into a document: one template in world coordinates, with
/// regions and markers, repaired where that needs no guess. [`tmesh::Source`] is filled in for surfaces.
///
/// # Errors
/// Malformed bytes, and surfaces that do not bound a body.
pub fn read(bytes: &[u8], format: Format) -> Result<Imported, HealError> {
    read_with(bytes, format, Healing::default())
}

/// The same, where the caller says what is made of surfaces.
///
/// # Errors
/// Malformed bytes, and surfaces that do not bound a body.
pub fn read_with(
    bytes: &[u8],
    format: Format,
    healing: impl Into<Healing>,
) -> Result<Imported, HealError> {
    heal(parse(bytes, format)?, format, healing.into())
}

/// Makes a document of what a file of the given format lists.
///
/// # Errors
/// Surfaces that do not bound a body.
pub fn heal(parsed: Parsed, format: Format, healing: Healing) -> Result<Imported, HealError> {
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
        Parsed::Soup(soup) => soup::build(soup, format, healing),
        Parsed::Plc(plc) => plc::build(plc, format),
        Parsed::Shells(shells) => shells::build(shells, format, healing.repairing),
        Parsed::Mesh(mesh) => mesh::build(mesh, format),
    }
}
