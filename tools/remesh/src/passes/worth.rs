//! What a step is worth.

pub use crate::shape::LONG;
use geom::measure::double_area_vector;
use glam::DVec3;

/// Shortest edge relative to the length wanted (Botsch and Kobbelt): two edges that meet at a vertex in between, of which
/// one is shorter, are together nearer to it.
pub const SHORT: f64 = 4.0 / 5.0;
/// Quality of a triangle that is good enough to be given up for another one: between 30 and 150 degrees, those with
/// equal sides are.
pub const GOOD: f64 = 0.5;
/// What a step has to gain.
pub const GAIN: f64 = 1e-3;
/// Edges shorter than this, relative to the length wanted, go even where a patch is not remeshed: what a cut leaves of
/// a facet.
pub const DETAIL: f64 = 0.25;
/// Sharpest corner of a facet, degrees, below which a patch is remeshed: what the mesher keeps of a corner between segments is
/// an angle of elements, and below 20 degrees that is less than what they get elsewhere.
pub const SHARP: f64 = 20.0;

/// Whether a triangle has a corner that is too sharp.
pub fn is_needle([a, b, c]: [DVec3; 3]) -> bool {
    let mut sides = [a.distance(b), b.distance(c), c.distance(a)];
    sides.sort_by(f64::total_cmp);
    double_area_vector(a, b, c).length() < libm::sin(SHARP.to_radians()) * sides[1] * sides[2]
}
