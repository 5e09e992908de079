//! A change of a few triangles.

use glam::DVec3;

/// Triangles and feature edges that are replaced by others.
#[derive(Clone, Debug, Default)]
pub struct Change {
    /// Triangles that go.
    pub gone: Vec<u32>,
    /// Triangles that come, with their patches.
    pub new: Vec<([u32; 3], u32)>,
    /// Feature edges that go.
    pub chords_gone: Vec<[u32; 2]>,
    /// Feature edges that come, with their curves.
    pub chords: Vec<([u32; 2], u32)>,
    /// Whether corners or curves are joined: then curves may be as far from theirs as the deviation.
    pub joins: bool,
    /// A vertex that was moved, and where it was: everything around it is as new.
    pub moved: Option<(u32, DVec3)>,
}

/// A point of the input.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Where it is.
    pub point: DVec3,
    /// How far the surface may be.
    pub reach: f64,
}

/// Where the input's points went.
pub struct Fitted {
    /// Samples of each new triangle.
    pub samples: Vec<Vec<Sample>>,
    /// Samples of each new feature edge.
    pub on_chords: Vec<Vec<Sample>>,
}
