//! From bytes, or from parsed data, to a document.

use crate::document::Imported;
use crate::{HealError, mesh, plc, shells, soup};
use interchange::{Format, Parsed, parse};

/// Reads a whole file of the given format into a document: one template in world coordinates, with
/// regions and markers. [`tmesh::Source`] is filled in for surfaces.
///
/// # Errors
/// Malformed bytes, and surfaces that do not bound a body.
pub fn read(bytes: &[u8], format: Format) -> Result<Imported, HealError> {
    heal(parse(bytes, format)?, format)
}

/// Makes a document of what a file of the given format lists.
///
/// # Errors
/// Surfaces that do not bound a body.
pub fn heal(parsed: Parsed, format: Format) -> Result<Imported, HealError> {
    let format = format.name();
    match parsed {
        Parsed::Document(document) => Ok(Imported {
            document: *document,
            notices: Vec::new(),
        }),
        Parsed::Soup(soup) => soup::build(soup, format),
        Parsed::Plc(plc) => plc::build(plc, format),
        Parsed::Shells(shells) => shells::build(shells, format),
        Parsed::Mesh(mesh) => mesh::build(mesh, format),
    }
}
