//! What is said of a rotation that nearly holds.

use serde::Serialize;
use tmesh::Axis;

/// A rotation under which all of the surface but some places goes to the surface.
#[derive(Clone, Debug, Serialize)]
pub struct Nearly {
    /// Its order; none if any rotation does so.
    pub order: Option<u32>,
    /// Its axis, in world coordinates.
    pub axis: Axis,
    /// Share of the surface that is in the way.
    pub share: f64,
    /// A place in the midst of that, in world coordinates.
    pub place: [f64; 3],
    /// How far images of that are from the surface at most, relative to the radius about the axis.
    pub residual: f64,
}

impl Nearly {
    /// Of several that leave about as little in the way, the one of the highest order.
    pub fn best(of: Vec<Self>) -> Option<Self> {
        let least = of.iter().map(|n| n.share).fold(f64::INFINITY, f64::min);
        let few = of.into_iter().filter(|n| n.share <= 2.0 * least);
        few.max_by_key(|n| n.order.unwrap_or(u32::MAX))
    }
}

impl std::fmt::Display for Nearly {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.order {
            Some(order) => write!(f, "order {order}")?,
            None => write!(f, "any rotation")?,
        }
        write!(
            f,
            " about {} through {} holds but for {:.2} % of the surface near {}, which is off by up to {:.1e} of the radius",
            kit::point(self.axis.direction),
            kit::point(self.axis.point),
            100.0 * self.share,
            kit::point(self.place),
            self.residual,
        )
    }
}
