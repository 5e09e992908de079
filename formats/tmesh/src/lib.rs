//! The document that travels through the pipe, and its binary form `.tmesh`.
//!
//! A [`Document`] holds *templates* (a piece of surface or volume mesh stored once), the *gluings* at
//! which templates meet their images, and *instances* (isometries that place the templates).
//! A plain surface or a whole mesh is the same document with one template and the identity
//! instance. `SPEC.md` beside this crate is the normative description of the bytes.

mod codec;
mod document;
mod error;
mod faces;
mod gluing;
mod isometries;
mod region_map;
mod size_field;
mod symmetry;
mod validate;
mod violation;
mod wishes;

pub use codec::{
    ChunkInfo, ChunkWriter, MAGIC, TETS, TRIANGLES, VERSION_MAJOR, VERSION_MINOR, VERTICES, read,
    read_with_chunks, write, write_instances, write_metadata,
};
pub use document::{
    Document, HistoryEntry, Instance, Marker, OUTSIDE, Region, Source, Template, Tet, Triangle,
};
pub use error::DecodeError;
pub use gluing::{Gluing, Plane};
pub use isometries::{
    FixedSet, Frame, Group, Isometry, Kind, MAX_TURN_DENOMINATOR, NotAGroup, Placed, ROUNDING,
};
pub use region_map::RegionMap;
pub use size_field::{SizeField, SizePoint};
pub use symmetry::{Axis, OtherAxis, Outside, Promise, RejectedOrder, Search, Symmetry};
pub use validate::validate;
pub use violation::Violation;
pub use wishes::{Deviation, Size, Wishes};
