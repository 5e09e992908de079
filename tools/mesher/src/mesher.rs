//! What a mesher is: it is given a complex and a task, and gives tetrahedra or says why there are none.

use crate::failure::Failure;
use crate::{Log, Plc};
use std::time::Duration;

/// Makes tetrahedra of a complex.
pub trait Mesher: Sync {
    /// Meshes a complex once, within the limits.
    ///
    /// # Errors
    /// Whatever happens to the mesher; it must not take this process with it.
    fn mesh(&self, plc: &Plc, task: &Task, limits: Limits, log: Log<'_>) -> Result<Mesh, Failure>;

    /// Pairs of triangles of the complex that intersect, for a failure's message.
    fn intersections(&self, plc: &Plc, limits: Limits) -> Vec<[usize; 2]>;
}

/// What is asked of one run of the mesher.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// Largest radius-edge ratio and smallest dihedral angle in degrees; `None` for a plain constrained
    /// tetrahedralization.
    pub bounds: Option<[f64; 2]>,
    /// Whether all triangles of the complex must come back as they are.
    pub preserve: bool,
    /// Points that may be added, at most.
    pub most_points: Option<f64>,
    /// Points from which on they are inserted in random rounds, where that is not the mesher's own choice.
    pub rounds_from: Option<u32>,
    /// Switches of the mesher's own, appended.
    pub switches: String,
}

/// Bounds on a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits {
    /// Wall-clock time after which the mesher is stopped.
    pub timeout: Option<Duration>,
    /// Memory that the mesher may take, bytes.
    pub memory: Option<u64>,
}

/// A tetrahedral mesh of a complex.
pub type Mesh = Box<dyn Elements>;

/// The arrays of a mesh. Numbers count from 0; the complex's points come first, in their order.
pub trait Elements: Send + Sync {
    /// Positions.
    fn points(&self) -> &[[f64; 3]];
    /// Four points each, positively oriented: `(b - a) x (c - a) . (d - a) > 0`.
    fn tetrahedra(&self) -> &[[i32; 4]];
    /// Four neighbours each, opposite to the four corners, -1 for none.
    fn neighbors(&self) -> &[[i32; 4]];
    /// Triangles of the refined facets, three points each, in no particular orientation.
    fn triangles(&self) -> &[[i32; 3]];
    /// One marker per triangle: that of its facet.
    fn triangle_markers(&self) -> &[i32];
    /// The tetrahedra beside a triangle.
    fn sides(&self, triangle: usize) -> [Option<usize>; 2];
    /// What the mesher was told, for people.
    fn told(&self) -> &str;
}
