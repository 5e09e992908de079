//! What can be cut, and where.

use crate::graph::Graph;
use std::sync::Arc;
use tmesh::{Frame, Group, Isometry};

/// What can be cut: the wedge of a subgroup of the group found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The subgroup.
    pub group: Group,
    /// Inscribed radius of the hub, model units.
    pub hub: Option<f64>,
}

/// Where the first side of a wedge lies.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The canonical frame: z along the axis, x in the first side.
    pub frame: Frame,
    /// By how much the frame is turned from that of the symmetry, where it has to fit mirror planes or half turns.
    pub start: Isometry,
    /// How much the cut faces of each turn of the rotation harm the faces they slice, see
    /// [`estimate::harm::sliced`]; zero for mirror planes, whose section the body has anyway.
    pub harm: f64,
    /// The seam, where it is no plane.
    pub graph: Option<Arc<Graph>>,
}
