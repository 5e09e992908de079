//! What to cut.

use crate::graph::Graph;
use std::sync::Arc;

/// Which walls the wedge gets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Domain {
    /// Mirror walls where the body has mirror planes, unless they leave an angle on the axis below --min-dihedral that others do not,
    /// a seam elsewhere; half turns and rotary reflections where it has these
    #[default]
    Auto,
    /// A wedge between two mirror planes
    Mirror,
    /// A wedge of angle 2 pi/n whose sides are images of each other by the rotation
    Rotation,
}

/// Whether the column around the axis is made a template of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hub {
    /// Where it pays.
    #[default]
    Auto,
    /// No.
    None,
    /// Yes, with this inscribed radius, model units.
    Radius(f64),
}

/// Which surface the sides of a rotation wedge lie in.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Seam {
    /// A half plane.
    #[default]
    Plane,
    /// A half plane, or what passes between the blades where that is better.
    Auto,
    /// The graph of an angle from the reference direction.
    Graph(Arc<Graph>),
}

/// What to cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// Walls.
    pub domain: Domain,
    /// Order used for meshing, a divisor of the order found; `None` chooses.
    pub order: Option<u32>,
    /// Angle of the first side from the reference direction, radians; `None` chooses.
    pub start_angle: Option<f64>,
    /// Distance up to which points are moved onto a cutting face or the axis, relative to the radius
    /// about the axis; `None` derives it from the precision of the input and the residual of the
    /// symmetry.
    pub snap: Option<f64>,
    /// The seam.
    pub seam: Seam,
    /// The hub.
    pub hub: Hub,
    /// Whether a mirror plane across the axis halves the wedge where it pays; false for never.
    pub level: bool,
    /// Edges shorter than this, relative to the radius about the axis, are collapsed; 0 for none.
    pub clean: f64,
    /// Threads used at most; the result does not depend on it.
    pub threads: usize,
}

impl Params {
    /// Whether anything is left to choose once the order found is known.
    pub fn chooses(&self) -> bool {
        self.order.is_none() || self.hub == Hub::Auto || self.level
    }
}
