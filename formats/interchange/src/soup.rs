//! What a surface reader delivers: polygons broken into triangles, in groups, not yet welded.

use glam::DVec3;

/// Triangles as a file lists them, in groups.
#[derive(Debug, Default)]
pub struct Soup {
    /// Positions; the same point may be listed many times. All finite.
    pub points: Vec<DVec3>,
    /// Three indices into `points` each.
    pub triangles: Vec<[u32; 3]>,
    /// Index into `groups` of each triangle.
    pub group_of: Vec<u32>,
    /// Solids, groups or objects, in order of appearance.
    pub groups: Vec<Group>,
    /// What to call a group in messages: `solid`, `group`.
    pub group_word: &'static str,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
    /// What the user should know about the file.
    pub notices: Vec<String>,
}

/// A named part of a [`Soup`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// Name as the file gives it; empty when it gives none.
    pub name: String,
}

/// Relative error of a number held in single precision.
pub const SINGLE: f64 = 1.0 / (1u64 << 24) as f64;

/// Relative error of a number held in double precision.
pub const DOUBLE: f64 = 1.0 / (1u64 << 53) as f64;
