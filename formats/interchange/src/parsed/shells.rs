//! Labelled triangles of which several volumes may share some.

use glam::DVec3;
use std::collections::BTreeSet;

/// Triangles with markers, and what the file says of the volumes between them.
#[derive(Clone, Debug, Default)]
pub struct Shells {
    /// Points; any may be there several times. All finite.
    pub points: Vec<DVec3>,
    /// Three points of each triangle, its marker, and the piece of surface it is on.
    pub triangles: Vec<([u32; 3], u32, i64)>,
    /// Names of the markers, increasing in id.
    pub markers: Vec<(u32, String)>,
    /// What the file says of volumes.
    pub volumes: Vec<Volume>,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
    /// What the user should know about the file.
    pub notices: Vec<String>,
}

/// A named volume.
#[derive(Clone, Debug)]
pub struct Volume {
    /// Region id.
    pub id: u32,
    /// Name.
    pub name: String,
    /// The pieces of surface around it; empty when the file does not say.
    pub around: BTreeSet<i64>,
}
