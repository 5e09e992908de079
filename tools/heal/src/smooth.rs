//! What counts as smooth.

/// Angle between facets up to which they may stand for one smooth surface, radians: 30 degrees. A choice: CAD programs
/// turn by up to 0.5 radians, 28.6 degrees, from facet to facet unless told otherwise. With a larger angle the edges of
/// prisms count as arcs, and with a smaller one coarse exports as prisms.
pub const SMOOTH: f64 = std::f64::consts::PI / 6.0;
