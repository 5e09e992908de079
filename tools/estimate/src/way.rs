//! What could be cut, and what it would cost.

/// A kind of wedge that could be cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// Order of the rotation used.
    pub order: u32,
    /// Angle about the axis, radians.
    pub angle: f64,
    /// Copies of the wedge that make the body.
    pub copies: f64,
    /// Copies of a hub that fill the column around the axis.
    pub hub_copies: f64,
    /// Largest distance of a point on the hub's wall from the axis, over the least.
    pub reach: f64,
    /// Whether the cut faces are mirror planes, whose triangles may be divided.
    pub free: bool,
    /// Whether the wedge ends at a mirror plane across the axis.
    pub across: bool,
    /// How much all cut faces of all copies harm the faces of the body, see [`crate::harm::sliced::Harm::sliced`].
    pub harm: f64,
    /// Whether it may have a hub.
    pub hub: bool,
}

/// A way to mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Index of the kind of wedge.
    pub cut: usize,
    /// Inscribed radius of the hub.
    pub hub: Option<f64>,
    /// Estimated elements over those of the whole body.
    pub elements: f64,
    /// Time to mesh it, as estimated elements over those of the whole body.
    pub meshed: f64,
}
