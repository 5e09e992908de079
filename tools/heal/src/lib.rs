//! From what a file lists to a document: triangle soup to closed labelled surface, piecewise linear
//! complex to regions, mesh to labelled mesh.
//!
//! Points are welded, gaps of the size of rounding closed, triangles without area removed, inside and
//! outside told apart. What cannot be repaired without guessing is an error that says where it is.

mod assembly;
mod contacts;
mod document;
mod error;
mod facet;
mod healing;
mod imprint;
mod interface;
mod leak;
mod meeting;
mod mesh;
mod plc;
mod read;
mod repair;
mod shells;
mod sides;
mod soup;
mod welded;
mod words;

pub use assembly::{Gap, Naming, Part, assemble, gaps, read_part};
pub use contacts::{Changed, Claimed, Contacts, Joined, Overlap};
pub use document::{Imported, check_scale};
pub use error::{HealError, OddEdges};
pub use healing::{Healing, Solids};
pub use read::{read, read_with};
pub use repair::{Repair, RepairKind, Repairing};
pub use soup::Undrawn;
