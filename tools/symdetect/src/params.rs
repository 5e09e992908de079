//! The options of a run.

use glam::DVec3;

/// Checked options.
#[derive(Clone, Debug)]
pub struct Params {
    /// Largest deviation from symmetry, relative to the radius about the axis.
    pub tolerance: f64,
    /// Whether what the facets of curved surfaces hide at a place is allowed on top there.
    pub facets: bool,
    /// Whether operations may exchange regions of one shape; else each region is mapped to itself.
    pub exchange: bool,
    /// Unit direction of the axis, if given.
    pub axis: Option<DVec3>,
    /// A point on the axis, world coordinates, if given.
    pub center: Option<DVec3>,
    /// The order to verify, if given.
    pub order: Option<u32>,
    /// Highest order tried.
    pub max_order: u32,
    /// Whether a body without symmetry is passed on.
    pub allow_asymmetric: bool,
    /// Whether residuals are measured order by order for a table or a plot.
    pub profile: bool,
    /// Threads used at most; the result does not depend on it.
    pub threads: usize,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            facets: true,
            exchange: true,
            axis: None,
            center: None,
            order: None,
            max_order: 1024,
            allow_asymmetric: false,
            profile: false,
            threads: kit::available_threads(),
        }
    }
}
