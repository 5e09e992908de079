//! What counts as equal, in one place.

pub use geom::tolerance::PROMISE;

/// Relative difference of volumes and areas that is allowed where the input is exact and exactly
/// symmetric: a choice. The volume of a layer a millionth as thick as wide, of coordinates with 16
/// digits, is good to 1e-10; the smallest part of a body that could be lost unnoticed is a millionth.
pub const VOLUME: f64 = 1e-6;
