//! What is known of the symmetry of a body. Serialized as JSON, in the file and in reports alike.

use serde::{Deserialize, Serialize};

/// A line in space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// A point on the axis, model units.
    pub point: [f64; 3],
    /// Unit direction.
    pub direction: [f64; 3],
}

/// A symmetry axis beside the main one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OtherAxis {
    /// Unit direction; the axis passes through the centre of the body.
    pub direction: [f64; 3],
    /// Highest order verified about it.
    pub order: u32,
    /// Largest deviation found, relative to the radius about the main axis.
    pub residual: f64,
}

/// An order that was tried and does not hold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RejectedOrder {
    /// The order.
    pub order: u32,
    /// Deviation found, relative to the radius about the axis. A lower bound: the test stops at
    /// the first sample that is clearly off.
    pub residual: f64,
}

/// The symmetry a mesh promises to have exactly: that of the instances it is made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Promise {
    /// Order of the rotation, at least 1.
    pub order: u32,
    /// Whether the mesh is symmetric under the mirror plane through axis and mirror direction.
    pub mirror: bool,
    /// Whether the mesh is symmetric under the mirror plane through the origin across the axis.
    pub horizontal_mirror: bool,
    /// Rows of the rotation matrix of the canonical frame (world = origin + rotation * canonical).
    pub rotation: [[f64; 3]; 3],
    /// Origin of the canonical frame in the world.
    pub origin: [f64; 3],
    /// The higher symmetry that holds away from the axis, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outside: Option<Outside>,
}

/// The symmetry of the tetrahedra that reach beyond a cylinder about the axis: those with at least one
/// vertex farther from the axis than its radius, each as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outside {
    /// Order of the rotation, a multiple of that of the whole.
    pub order: u32,
    /// Whether the mirror plane through axis and mirror direction maps them onto themselves.
    pub mirror: bool,
    /// Radius of the cylinder, model units.
    pub radius: f64,
}

/// The symmetry found in a body, in the frame of the input.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Symmetry {
    /// Schoenflies symbol with the order written out, such as `C16v`.
    pub group: String,
    /// Order of the rotation about the main axis, at least 1.
    pub order: u32,
    /// Whether mirror planes contain the axis.
    pub mirror: bool,
    /// Whether a mirror plane is orthogonal to the axis.
    pub horizontal_mirror: bool,
    /// The main axis; its point is the centre of the body.
    pub axis: Axis,
    /// Unit vector orthogonal to the axis that lies in a mirror plane; without mirrors, a reference
    /// direction for angles.
    pub mirror_direction: [f64; 3],
    /// Largest deviation found over all verified operations, relative to the radius about the axis.
    pub residual: f64,
    /// Tolerance the verification used, relative to the radius about the axis.
    pub tolerance: f64,
    /// Whether every order holds within the tolerance: a body of revolution. `order` is then the
    /// facet count.
    pub axisymmetric: bool,
    /// Largest distance of a surface point from the axis, model units.
    #[serde(default)]
    pub radius: f64,
    /// Further symmetry axes, strongest first.
    #[serde(default)]
    pub other_axes: Vec<OtherAxis>,
    /// Orders that were tried and do not hold.
    #[serde(default)]
    pub rejected: Vec<RejectedOrder>,
    /// How the rotation by one step of `order` permutes region ids, as (from, to) pairs; empty when
    /// it leaves every region where it is.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rotation_regions: Vec<[u32; 2]>,
    /// How the mirror at the mirror direction permutes region ids; empty for none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mirror_regions: Vec<[u32; 2]>,
    /// How the horizontal mirror permutes region ids; empty for none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub horizontal_regions: Vec<[u32; 2]>,
    /// Set on an assembled mesh: the symmetry it has exactly.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub promise: Option<Promise>,
}
