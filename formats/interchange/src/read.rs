//! Reading a whole file, and telling its format from its first bytes.

use crate::{Format, ReadError, grid, msh, obj, off, plc, ply, poly, stl, surface, vtk, vtu};
use std::path::Path;
use tmesh::Document;

/// What a file holds.
#[derive(Clone, Debug)]
pub struct Imported {
    /// One template in world coordinates, unless the file is a document already.
    pub document: Document,
    /// What the user should know about the file, a sentence each.
    pub notices: Vec<String>,
}

/// The format that the first bytes of a file show, if they show one.
///
/// `head` should be at least 1 KiB unless the file is shorter. `path` breaks ties only.
pub fn sniff(head: &[u8], path: Option<&Path>) -> Option<Format> {
    if head.starts_with(&tmesh::MAGIC) {
        return Some(Format::Tmesh);
    }
    if vtk::looks_like(head) {
        return Some(Format::Vtk);
    }
    if vtu::looks_like(head) {
        return Some(Format::Vtu);
    }
    if msh::looks_like(head) {
        return Some(Format::Msh);
    }
    if stl::looks_ascii(head) || stl::looks_binary(head) {
        return Some(Format::Stl);
    }
    if ply::looks_like(head) {
        return Some(Format::Ply);
    }
    if off::looks_like(head) {
        return Some(Format::Off);
    }
    if obj::looks_like(head) {
        return Some(Format::Obj);
    }
    let named = path.and_then(Format::from_path);
    if poly::looks_like(head) {
        // The two look alike at first.
        return named.filter(|f| *f == Format::Smesh).or(Some(Format::Poly));
    }
    named
}

/// Reads a whole file of the given format into a document: one template in world coordinates, with
/// regions and markers. [`tmesh::Source`] is filled in for surfaces.
///
/// # Errors
/// Malformed bytes, and surfaces that do not bound a body.
pub fn read(bytes: &[u8], format: Format) -> Result<Imported, ReadError> {
    match format {
        Format::Tmesh => Ok(Imported {
            document: tmesh::read(bytes)?,
            notices: Vec::new(),
        }),
        Format::Stl => surface::build(stl::read(bytes)?, "stl"),
        Format::Obj => surface::build(obj::read(bytes)?, "obj"),
        Format::Ply => surface::build(ply::read(bytes)?, "ply"),
        Format::Poly => plc::build(poly::read(bytes, false)?, "poly"),
        Format::Smesh => plc::build(poly::read(bytes, true)?, "smesh"),
        Format::Off => surface::build(off::read(bytes)?, "off"),
        Format::Vtk => grid::build(vtk::read(bytes)?, "vtk"),
        Format::Vtu => grid::build(vtu::read(bytes)?, "vtu"),
        Format::Msh | Format::Msh2 => msh::read(bytes),
        Format::Pvtu | Format::Medit | Format::Inp | Format::Node | Format::Text => {
            Err(ReadError::NotAnInput(format.name()))
        }
    }
}
