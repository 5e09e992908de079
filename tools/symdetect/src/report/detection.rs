//! What was found.

use crate::nearly::Nearly;
use crate::report::deviations::Deviations;
use tmesh::{Search, Symmetry};

/// What was found, and remarks for the user.
pub struct Detection {
    /// The symmetry, in world coordinates.
    pub symmetry: Symmetry,
    /// What facets explain of the residual, and what remains.
    pub deviations: Deviations,
    /// What else the search came across.
    pub search: Search,
    /// How many other axes there are, of which [`Search`] lists some.
    pub axes: usize,
    /// Remarks, a sentence each.
    pub notes: Vec<String>,
    /// A rotation that nearly holds beside what was found, and what breaks it.
    pub nearly: Option<Nearly>,
    /// Residuals of all orders up to some, if [`crate::Params::profile`] asked for them.
    pub profile: Vec<OrderResidual>,
    /// Why the body counts as asymmetric, when [`crate::Params::allow_asymmetric`] let it pass.
    pub asymmetric: Option<String>,
}

/// How far a body is off under one order about its axis.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct OrderResidual {
    /// The order.
    pub order: u32,
    /// Largest deviation under some powers of the rotation, relative to the radius; at most 1.
    pub residual: f64,
    /// Whether the rotation belongs to the group found.
    pub holds: bool,
}
