//! What counts as equal, in one place.

/// The promise of assembled meshes: coordinates agree to this share of the size, which is the diagonal of the bounding
/// box. A vertex has to fall on its image to this; vertices nearer than this coincide; the frame of a
/// promise has to be a rotation to this, and a radius is known to this. Copies of a vertex that were not
/// welded are some 1e-16 of the size apart, and edges as short as this would have no direction left to
/// compute with.
pub const PROMISE: f64 = 1e-12;

/// Relative difference of volumes and areas that is allowed where the input is exact and exactly
/// symmetric: a choice. The volume of a layer a millionth as thick as wide, of coordinates with 16
/// digits, is good to 1e-10; the smallest part of a body that could be lost unnoticed is a millionth.
pub const VOLUME: f64 = 1e-6;
